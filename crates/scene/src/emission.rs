//! The radiance that leaves a target, point by point.

use glam::{DVec2, DVec3};
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::target::{Shape, Target};

use crate::footprint;
use crate::glow::Glow;
use crate::scene::Scene;
use crate::texture::Texture;

/// What leaves a target on its emitting sides: radiance `L_e` in linear RGB.
#[derive(Clone, Debug, PartialEq)]
pub enum Emission {
    /// The same everywhere.
    Constant([f32; 3]),
    /// By a texture.
    Textured(Box<Pattern>),
}

/// A texture on a target: uv(s, t) = origin + s e + t f + st g, as the target's own map y(s, t) goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    texture: Texture,
    scale: [f32; 3],
    mean: [f64; 3],
    origin: DVec2,
    e: DVec2,
    f: DVec2,
    g: DVec2,
    plane: Plane,
}

/// A target's plane in space: coordinates of y along two of its sides from a corner.
#[derive(Clone, Debug, PartialEq)]
struct Plane {
    corner: DVec3,
    /// Dual to the sides: duals[i]·side\[j\] = δ_ij.
    duals: [DVec3; 2],
    /// Change of (u, v) along the sides.
    slopes: [DVec2; 2],
}

impl Emission {
    /// `L_e` at y(s, t) = a + s e + t f + st g of a target with the corners a, b, c and for a parallelogram d: there e =
    /// b − a, f = d − a and g = a − b + c − d, and for a triangle e = b − a, f = 0 and g = c − b. So s is a uniform number
    /// on a parallelogram, and on a triangle the square root of one.
    pub fn at(&self, [s, t]: [f64; 2]) -> [f32; 3] {
        match self {
            Self::Constant(radiance) => *radiance,
            Self::Textured(pattern) => pattern.at(pattern.origin + s * pattern.e + t * pattern.f + s * t * pattern.g),
        }
    }

    /// `L_e` at the point `y` of the target, in metres.
    pub fn at_point(&self, y: DVec3) -> [f32; 3] {
        match self {
            Self::Constant(radiance) => *radiance,
            Self::Textured(pattern) => pattern.at(pattern.origin + pattern.plane.offset(y)),
        }
    }

    /// Mean of `L_e` over the target's area: exact but for rounding, but where the target shows more than 2²⁴ texels, or
    /// a line of its texture only; there to about a thousandth of the texture's contrast.
    pub fn mean(&self) -> [f64; 3] {
        match self {
            Self::Constant(radiance) => radiance.map(f64::from),
            Self::Textured(pattern) => pattern.mean,
        }
    }
}

impl Pattern {
    /// The coordinates (b, d) of a point of the target's plane: y = corner + b e + d f, with e the side from the first
    /// corner to the next and f the one from the first corner to the last.
    pub fn coordinates(&self, y: DVec3) -> [f64; 2] {
        self.plane.duals.map(|dual| dual.dot(y - self.plane.corner))
    }

    /// Where the first corner, the next and the last lie in the texture's grid: between whole numbers of both coordinates
    /// the texture is one bilinear map.
    pub fn corners_in_grid(&self) -> [DVec2; 3] {
        let [e, f] = self.plane.slopes;
        [self.origin, self.origin + e, self.origin + f].map(|uv| self.texture.grid(uv))
    }

    /// `L_e` in binary64 at a place of the texture's grid.
    pub fn at_grid(&self, place: DVec2) -> [f64; 3] {
        let corner = place.floor();
        let texel = self.texture.cell(corner).exactly(place - corner);
        std::array::from_fn(|channel| f64::from(self.scale[channel]) * texel[channel])
    }

    /// Mean of `L_e` over a triangle on the target, given by the coordinates of its corners.
    pub fn mean_over(&self, corners: [[f64; 2]; 3]) -> [f64; 3] {
        let [e, f] = self.plane.slopes;
        let mean = footprint::mean(&self.texture, corners.map(|[b, d]| self.origin + b * e + d * f));
        std::array::from_fn(|channel| f64::from(self.scale[channel]) * mean[channel])
    }

    fn new(glow: &Glow<'_>, mesh: &Mesh, target: &Target, mean: [f64; 3]) -> Self {
        let ([a, b, c, d], triangle) = match target.shape {
            Shape::Triangle(t) => {
                let [a, b, c] = mesh.triangles[t as usize];
                ([a, b, c, c], true)
            }
            Shape::Parallelogram { corners, .. } => (corners, false),
        };
        let plane = Plane::new(mesh, [a, b, d], glow.uv([a, b, d]));
        let [a, b, c, d] = glow.uv([a, b, c, d]);
        let (f, g) = if triangle { (DVec2::ZERO, c - b) } else { (d - a, a - b + c - d) };
        Self { texture: glow.texture.clone(), scale: glow.scale, mean, origin: a, e: b - a, f, g, plane }
    }

    fn at(&self, uv: DVec2) -> [f32; 3] {
        let texel = self.texture.at(uv);
        std::array::from_fn(|channel| self.scale[channel] * texel[channel])
    }
}

impl Plane {
    /// Of three corners, the first one between the other two.
    fn new(mesh: &Mesh, vertices: [u32; 3], uv: [DVec2; 3]) -> Self {
        let [corner, b, d] = vertices.map(|vertex| mesh.vertices[vertex as usize].as_dvec3());
        let sides = [b - corner, d - corner];
        let normal = sides[0].cross(sides[1]);
        let duals = [sides[1].cross(normal), normal.cross(sides[0])].map(|dual| dual / normal.length_squared());
        Self { corner, duals, slopes: [uv[1] - uv[0], uv[2] - uv[0]] }
    }

    /// From (u, v) of the corner to (u, v) of y.
    fn offset(&self, y: DVec3) -> DVec2 {
        let [b, d] = self.duals.map(|dual| dual.dot(y - self.corner));
        b * self.slopes[0] + d * self.slopes[1]
    }
}

impl Scene {
    /// What leaves `target` on its emitting sides.
    pub fn target_emission(&self, target: u32) -> Emission {
        let light = self.target_light(target);
        let piece = &self.targets[target as usize];
        let surface = self.surface_of(piece.first());
        let glow = Glow::of(surface, &self.materials[surface.material], &self.textures).ok().flatten();
        let mean = light.means.get((target - light.targets.start) as usize);
        match (glow, mean) {
            (Some(glow), Some(&mean)) => Emission::Textured(Box::new(Pattern::new(&glow, &self.mesh, piece, mean))),
            _ => Emission::Constant(light.radiance),
        }
    }
}
