//! Viewpoints: the rays of a camera, and cameras that a scene does not carry.

use glam::DVec3;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::ray::Ray;
use twoforms_scene::Camera;

/// The ray through the point (x, y) of an image, in pixels from its top left corner; its direction is as long as the
/// distance along the camera's axis is one metre. The vertical field of view is the camera's; pixels are square.
pub fn ray(camera: &Camera, [x, y]: [f64; 2], [width, height]: [u32; 2]) -> Ray {
    let (w, h) = (f64::from(width), f64::from(height));
    let half = libm::tan(0.5 * camera.yfov);
    let right = (2.0 * x - w) / h * half;
    let up = (h - 2.0 * y) / h * half;
    Ray::new(camera.position, camera.forward + camera.right * right + camera.up * up)
}

/// The vertical field of view of [`auto`], in radians: 45 degrees.
const AUTO_FOV: f64 = std::f64::consts::FRAC_PI_4;

/// A camera that looks at the whole scene from outside its bounding box: mainly along the thinnest extent, so that a sign
/// or a wall is seen from its face, else from the front (+z); a little from above and from the right. `None` for a scene
/// without triangles.
pub fn auto(mesh: &Mesh) -> Option<Camera> {
    let (low, high) = mesh.bounds()?;
    let (low, high) = (low.as_dvec3(), high.as_dvec3());
    let (centre, extent) = (0.5 * (low + high), high - low);
    let distance = (0.5 * extent.length()).max(f64::MIN_POSITIVE) / (0.5 * AUTO_FOV).sin();
    look_at("auto", centre + face_on(extent) * distance, centre, AUTO_FOV)
}

/// Unit vector outward along the thinnest extent if it is less than half of that along z, else along z; turned aside.
fn face_on(extent: DVec3) -> DVec3 {
    let thinnest = if extent.min_element() < 0.5 * extent.z { extent.min_position() } else { 2 };
    let mut outward = DVec3::new(0.5, 0.4, 0.5);
    outward[thinnest] = 1.0;
    outward.normalize()
}

/// A camera at `eye` that looks at `target` (metres) with a vertical field of view in radians; up is +y, or −z where it
/// looks straight up or down. `None` if the two points coincide.
pub fn look_at(name: &str, eye: DVec3, target: DVec3, yfov: f64) -> Option<Camera> {
    let forward = (target - eye).try_normalize()?;
    let sideways = |up: DVec3| forward.cross(up).try_normalize();
    let right = sideways(DVec3::Y).or_else(|| sideways(DVec3::NEG_Z))?;
    let up = right.cross(forward);
    Some(Camera { name: name.to_owned(), position: eye, right, up, forward, yfov, aspect: None })
}

#[cfg(test)]
mod tests {
    use super::{look_at, ray};
    use glam::DVec3;

    #[test]
    fn the_centre_of_the_image_is_ahead_and_its_corners_are_where_the_field_of_view_says() {
        let camera = look_at("c", DVec3::ZERO, DVec3::NEG_Z, std::f64::consts::FRAC_PI_2).expect("distinct points");
        assert!(ray(&camera, [8.0, 4.0], [16, 8]).direction.abs_diff_eq(DVec3::NEG_Z, 1e-15));
        assert!(ray(&camera, [0.0, 0.0], [16, 8]).direction.abs_diff_eq(DVec3::new(-2.0, 1.0, -1.0), 1e-15));
    }

    #[test]
    fn a_sign_is_seen_from_its_face_and_a_room_from_the_front() {
        for (extent, axis) in [(DVec3::new(0.05, 0.5, 2.0), 0), (DVec3::new(5.0, 0.0, 5.0), 1), (DVec3::ONE, 2)] {
            assert_eq!(super::face_on(extent).max_position(), axis, "{extent}");
        }
    }

    #[test]
    fn looking_straight_down_has_a_frame() {
        let camera = look_at("c", DVec3::Y, DVec3::ZERO, 1.0).expect("distinct points");
        assert!(camera.up.abs_diff_eq(DVec3::NEG_Z, 1e-15) && camera.right.abs_diff_eq(DVec3::X, 1e-15));
    }
}
