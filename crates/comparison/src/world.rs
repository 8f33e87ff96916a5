//! A scene made ready: its geometry and its lights.

use std::ops::ControlFlow;

use glam::DVec3;
use twoforms_estimator::glossy::{Makeup, MetallicRoughness};
use twoforms_estimator::lights::Lights;
use twoforms_geometry::blocking;
use twoforms_geometry::geometry::{Geometry, Layer};
use twoforms_geometry::ray::{Hit, Ray};
use twoforms_geometry::tracer::Region;
use twoforms_scene::{Appearance, SMOOTHEST, Scene, SceneError};

/// What a scene is made of, and where, with the hierarchy built.
pub struct World {
    /// Surfaces, cameras, receivers, warnings.
    pub scene: Scene,
    /// vp and V.
    pub geometry: Geometry,
    /// L_e and areas of the targets.
    pub lights: Lights,
}

/// A point of a surface that a camera sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// World position in metres.
    pub position: DVec3,
    /// Geometric unit normal on the side that is seen.
    pub normal: DVec3,
    /// Distance along the ray, in units of its direction.
    pub distance: f64,
    /// Which triangle.
    pub triangle: u32,
    /// Whether the front is seen.
    pub front: bool,
}

impl World {
    /// Builds the hierarchy.
    ///
    /// # Errors
    /// When the scene has no light: there is nothing to estimate.
    pub fn new(scene: Scene) -> Result<Self, SceneError> {
        scene.require_emitters()?;
        let geometry = Geometry::new(scene.mesh.clone(), scene.targets.clone()).with_veil(scene.veil());
        let lights = Lights::new(&scene);
        Ok(Self { scene, geometry, lights })
    }

    /// How much there is of it: `36 triangles, 1 light, 1 target`.
    pub fn summary(&self) -> String {
        let triangles = counted(self.geometry.mesh().len(), "triangle");
        let lights = counted(self.scene.lights.len(), "light");
        format!("{triangles}, {lights}, {}", counted(self.lights.targets(), "target"))
    }

    /// The first surface along a ray, blended or not.
    pub fn see(&self, ray: &Ray) -> Option<Seen> {
        let hit =
            if self.geometry.is_veiled() { self.geometry.layers(ray).first()?.hit } else { self.geometry.vp(ray)? };
        Some(self.seen(ray, hit))
    }

    /// The surfaces along a ray up to the first that is opaque, and how much each adds to what is seen: α_i Π_{j < i} (1 − α_j).
    pub fn see_through(&self, ray: &Ray) -> Vec<(Seen, f64)> {
        let mut left = 1.0;
        let layers = self.geometry.layers(ray).into_iter();
        layers
            .map(|Layer { hit, share }| {
                let weight = left * f64::from(share);
                left -= weight;
                (self.seen(ray, hit), weight)
            })
            .collect()
    }

    fn seen(&self, ray: &Ray, hit: Hit) -> Seen {
        let cross = self.geometry.mesh().triangle(hit.triangle).cross().normalize();
        let front = cross.dot(ray.direction) < 0.0;
        let normal = if front { cross } else { -cross };
        Seen { position: ray.at(hit.t), normal, distance: hit.t, triangle: hit.triangle, front }
    }

    /// The surface that holds `position` and faces along `normal`, as seen from that side: one whose plane holds the
    /// position by the blocking rule, and whose triangle lies under it.
    pub fn surface_at(&self, position: DVec3, normal: DVec3) -> Option<Seen> {
        let mesh = self.geometry.mesh();
        let half = blocking::TOLERANCE * position.abs().max_element().max(f64::MIN_POSITIVE);
        let region = cube(position, half);
        let above = Ray::new(position + normal, -normal);
        let mut found = None;
        self.geometry.within(&region, |index| {
            let triangle = mesh.triangle(index);
            if blocking::plane_holds(&triangle, position) && above.distance(&triangle).is_some() {
                let cross = triangle.cross().normalize();
                let front = cross.dot(normal) > 0.0;
                found = Some(Seen { position, normal, distance: 0.0, triangle: index, front });
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        found
    }

    /// What the surface is at a point that is seen: textures and vertex colours too.
    pub fn appearance(&self, seen: &Seen) -> Appearance {
        let triangle = self.geometry.mesh().triangle(seen.triangle);
        self.scene.appearance_at(seen.triangle, triangle.barycentrics(seen.position))
    }

    /// ρ at a point that is seen, RGB.
    pub fn albedo(&self, seen: &Seen) -> [f32; 3] {
        if self.scene.is_uniform(seen.triangle) {
            return self.scene.albedo(seen.triangle);
        }
        self.appearance(seen).albedo()
    }

    /// The surface that is seen, if it has a highlight.
    pub fn highlight(&self, seen: &Seen) -> Option<MetallicRoughness> {
        if !self.scene.material_of(seen.triangle).may_be_glossy() {
            return None;
        }
        let appearance = self.appearance(seen);
        let Appearance { base_color, metallic, roughness, specular, f_0, .. } = appearance;
        let roughness = roughness.max(SMOOTHEST);
        let makeup = Makeup { base: base_color, metallic, roughness, specular, f_0 };
        appearance.is_glossy().then(|| MetallicRoughness::new(&makeup))
    }

    /// Whether some surface of the scene may have a highlight.
    pub fn has_highlights(&self) -> bool {
        self.scene.surfaces.iter().any(|surface| self.scene.materials[surface.material].may_be_glossy())
    }

    /// L_e toward the eye from what is seen, RGB: black unless it is a light on a side that emits.
    pub fn emission(&self, seen: &Seen) -> [f32; 3] {
        let material = self.scene.material_of(seen.triangle);
        let lit = self.geometry.target_of(seen.triangle).is_some() && (seen.front || material.double_sided);
        match lit {
            false => [0.0; 3],
            true if material.emissive_texture.is_none() => material.emission,
            true => self.appearance(seen).emission,
        }
    }
}

/// `1 light`, `2 lights`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// The cube around a point, `half` its edge's half in metres.
pub(crate) fn cube(centre: DVec3, half: f64) -> Region {
    let sides = DVec3::AXES.into_iter().flat_map(|axis| [(axis, half), (-axis, half)]);
    Region { origin: centre, half_spaces: sides.collect() }
}

#[cfg(test)]
mod tests {
    use super::counted;

    #[test]
    fn one_is_singular() {
        assert_eq!([counted(0, "light"), counted(1, "light")], ["0 lights", "1 light"]);
    }
}
