//! V and vp worked out another way, and how near a direction passes to where answers change.

use glam::DVec3;
use twoforms_geometry::blocking::plane_holds;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Triangle;
use twoforms_geometry::ray::Ray;
use twoforms_geometry::target::Target;

/// Six times the signed volume of the tetrahedron abcd.
fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    (a - d).dot((b - d).cross(c - d))
}

/// Whether the open segment from x to y passes through the triangle, by signs of volumes.
fn crosses(x: DVec3, y: DVec3, triangle: &Triangle) -> bool {
    let [a, b, c] = triangle.vertices();
    let sides = [volume(x, y, a, b), volume(x, y, b, c), volume(x, y, c, a)];
    let through = sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0);
    through && volume(a, b, c, x) * volume(a, b, c, y) < 0.0
}

/// Where the line from x to y meets the plane of a target: y itself, but for its rounding to binary32.
fn in_plane(geometry: &Geometry, x: DVec3, y: DVec3, target: u32) -> DVec3 {
    let corners = geometry.targets()[target as usize].corners(geometry.mesh());
    let corner = |k: usize| corners.as_slice()[k].as_dvec3() - x;
    let normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    x + (y - x) * (normal.dot(corner(0)) / normal.dot(y - x))
}

/// V(x, y) of a point on a target: no triangle that may block it is crossed.
pub fn visible(geometry: &Geometry, x: DVec3, y: DVec3, target: u32) -> bool {
    let y = in_plane(geometry, x, y, target);
    let blocks = |index: u32| {
        let triangle = geometry.mesh().triangle(index);
        geometry.may_block(index, target) && !plane_holds(&triangle, x) && crosses(x, y, &triangle)
    };
    !(0..geometry.mesh().len() as u32).any(blocks)
}

/// The target that a ray from x meets first of all surfaces.
pub fn reached(geometry: &Geometry, x: DVec3, direction: DVec3) -> Option<u32> {
    geometry.vp(&Ray::new(x, direction)).and_then(|hit| geometry.target_of(hit.triangle))
}

/// The least angle in radians between a direction and a plane through x where an answer changes: the plane of an edge,
/// or of the line in which a triangle meets the plane of a target.
pub fn nearest_change(geometry: &Geometry, x: DVec3, direction: DVec3) -> f64 {
    let direction = direction.normalize();
    let mesh = geometry.mesh();
    let seen: Vec<[DVec3; 3]> = (0..mesh.len() as u32).map(|t| mesh.triangle(t).vertices().map(|v| v - x)).collect();
    let edges = seen.iter().flat_map(|&[a, b, c]| [a.cross(b), b.cross(c), c.cross(a)]);
    let planes: Vec<(DVec3, f64)> = seen
        .iter()
        .map(|&[a, b, c]| {
            let n = (b - a).cross(c - a).normalize_or_zero();
            (n, n.dot(a))
        })
        .collect();
    let of_targets = geometry.targets().iter().flat_map(Target::triangles).map(|t| planes[t as usize]);
    let meetings = of_targets.flat_map(|(m, d)| planes.iter().map(move |&(n, s)| d * n - s * m));
    let angle = |plane: DVec3| plane.normalize_or(direction).dot(direction).abs();
    edges.chain(meetings).map(angle).fold(f64::INFINITY, f64::min)
}
