//! One mesh in world space, made of instances of primitives.

use glam::{DAffine3, Vec3};
use twoforms_geometry::mesh::Mesh;

use crate::error::{Problem, malformed};
use crate::primitive::Local;
use crate::surface::Surface;
use crate::transform::carry_normal;
use crate::warnings::Warnings;

/// All triangles of a scene and the surfaces that they belong to.
#[derive(Default)]
pub(crate) struct Assembly {
    pub mesh: Mesh,
    pub surfaces: Vec<Surface>,
}

/// Where an instance of a primitive goes, what it is called and made of.
pub(crate) struct Instance {
    pub name: String,
    pub world: DAffine3,
    pub material: usize,
}

impl Assembly {
    /// Adds one instance of a primitive; nothing where that has no triangle.
    pub fn add(
        &mut self,
        local: &Local,
        Instance { name, world, material }: Instance,
        warnings: &mut Warnings,
    ) -> Result<(), Problem> {
        if local.triangles.is_empty() {
            return Ok(());
        }
        let (vertices, triangles) = (self.mesh.vertices.len(), self.mesh.triangles.len());
        self.add_vertices(local, &world, &name)?;
        self.add_triangles(local, world.matrix3.determinant() < 0.0, vertices as u32);
        let normals = local.normals.as_ref().map(|normals| carry_normals(normals, &world));
        if normals == Some(None) {
            warnings.at("a surface is shaded flat, since it has normals without direction", &name);
        }
        self.surfaces.push(Surface {
            name,
            vertices: vertices as u32..self.mesh.vertices.len() as u32,
            triangles: triangles as u32..self.mesh.triangles.len() as u32,
            normals: normals.flatten(),
            attributes: local.attributes.clone(),
            material,
            light: None,
        });
        Ok(())
    }

    /// world = node transform (binary64) × local (binary32), rounded once to binary32.
    fn add_vertices(&mut self, local: &Local, world: &DAffine3, name: &str) -> Result<(), Problem> {
        for (i, vertex) in local.positions.iter().enumerate() {
            let vertex = world.transform_point3(vertex.as_dvec3()).as_vec3();
            if !vertex.is_finite() {
                let fault = format!("has vertex {i} at a place that is not finite in binary32");
                return Err(malformed(format!("{name:?}"), fault));
            }
            self.mesh.vertices.push(vertex);
        }
        Ok(())
    }

    /// Turns the winding under a mirroring transform, so that the front stays the front.
    fn add_triangles(&mut self, local: &Local, mirrored: bool, first: u32) {
        let turned = |[a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        let triangles = local.triangles.iter().map(|&t| turned(t).map(|vertex| first + vertex));
        self.mesh.triangles.extend(triangles);
    }
}

/// Unit normals in the world; `None` where one has no direction.
fn carry_normals(normals: &[Vec3], world: &DAffine3) -> Option<Vec<Vec3>> {
    let carry = |normal: &Vec3| carry_normal(&world.matrix3, normal.as_dvec3());
    normals.iter().map(|normal| Some(carry(normal)?.as_vec3())).collect()
}
