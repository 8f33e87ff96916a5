//! From placed nodes to one mesh in world space.

use std::collections::BTreeSet;

use glam::{DAffine3, Vec3};
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked::Valid;
use twoforms_geometry::mesh::Mesh;

use crate::accessor::LIMIT;
use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::hierarchy::Placed;
use crate::instances::{self, Instances};
use crate::primitive::{self, Local};
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
struct Instance {
    name: String,
    world: DAffine3,
    material: usize,
}

/// Puts the meshes of all placed nodes together.
pub(crate) fn assemble(
    document: &Document<'_>,
    placed: &[Placed],
    warnings: &mut Warnings,
) -> Result<Assembly, Problem> {
    let mut assembly = Assembly::default();
    for placed in placed {
        assembly.add_node(document, placed, warnings)?;
    }
    warn_of_unplaced(document, placed, warnings);
    Ok(assembly)
}

fn warn_of_unplaced(document: &Document<'_>, placed: &[Placed], warnings: &mut Warnings) {
    let meshes = placed.iter().filter_map(|placed| document.root.nodes[placed.node].mesh);
    let meshes: BTreeSet<usize> = meshes.map(|mesh| mesh.value()).collect();
    for (index, mesh) in document.root.meshes.iter().enumerate().filter(|(index, _)| !meshes.contains(index)) {
        let name = mesh.name.clone().unwrap_or_else(|| format!("meshes[{index}]"));
        warnings.at("a mesh stands nowhere in the scene and is left out", &name);
    }
}

impl Assembly {
    fn add_node(&mut self, document: &Document<'_>, placed: &Placed, warnings: &mut Warnings) -> Result<(), Problem> {
        let node = &document.root.nodes[placed.node];
        let Some(index) = node.mesh.map(|mesh| mesh.value()) else {
            return Ok(());
        };
        let mesh = &document.root.meshes[index];
        let name = node.name.clone().or_else(|| mesh.name.clone());
        let name = name.unwrap_or_else(|| document.node_name(placed.node));
        if node.skin.is_some() {
            warnings.at("a skinned mesh stands in its bind pose", &name);
        }
        let copies = instances::read(document, placed.node)?;
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let name = if mesh.primitives.len() > 1 { format!("{name}/{p}") } else { name.clone() };
            let place = format!("meshes[{index}].primitives[{p}]");
            let material = primitive.material.map_or(document.root.materials.len(), |m| m.value());
            let original = Instance { name, world: placed.world, material };
            if let Some(local) = read(document, primitive, &place, &original.name, warnings)? {
                self.add_instances(&local, original, copies.as_ref(), warnings)?;
            }
        }
        Ok(())
    }

    fn add_instances(
        &mut self,
        local: &Local,
        original: Instance,
        copies: Option<&Instances>,
        warnings: &mut Warnings,
    ) -> Result<(), Problem> {
        let Some(copies) = copies else {
            self.check_room(local, 1, &original.name)?;
            return self.add(local, original, warnings);
        };
        let place = format!("{:?}", original.name);
        let differ = || malformed(&place, "has translations, rotations and scales that differ in number");
        let count = copies.count().ok_or_else(differ)?;
        self.check_room(local, count, &original.name)?;
        for i in 0..count {
            let name = format!("{}[{i}]", original.name);
            let copy = copies.transform(i).map_err(|fault| malformed(format!("{name:?}"), fault))?;
            self.add(local, Instance { name, world: original.world * copy, ..original }, warnings)?;
        }
        Ok(())
    }

    /// Checks that `count` instances more keep the scene within the limit.
    fn check_room(&self, local: &Local, count: usize, name: &str) -> Result<(), Problem> {
        let fits = |held: usize, more: usize| more.checked_mul(count).is_some_and(|more| held + more <= LIMIT);
        let mesh = &self.mesh;
        if fits(mesh.vertices.len(), local.positions.len()) && fits(mesh.triangles.len(), local.triangles.len()) {
            return Ok(());
        }
        Err(Problem::TooLarge { place: format!("{name:?}"), limit: LIMIT })
    }

    fn add(
        &mut self,
        local: &Local,
        Instance { name, world, material }: Instance,
        warnings: &mut Warnings,
    ) -> Result<(), Problem> {
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

/// Reads a primitive that has triangles; warns about what is left out of it.
fn read(
    document: &Document<'_>,
    primitive: &Primitive,
    place: &str,
    name: &str,
    warnings: &mut Warnings,
) -> Result<Option<Local>, Problem> {
    let Some(local) = primitive::read(document, primitive, place)? else {
        warnings.at("points and lines have no area and are skipped", name);
        return Ok(None);
    };
    if primitive.attributes.contains_key(&Valid(Semantic::Colors(0))) {
        warnings.at("vertex colours are ignored", name);
    }
    if primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty()) {
        warnings.at("morph targets are ignored", name);
    }
    if local.rest > 0 {
        warnings.at("vertices that make no whole triangle are left over", name);
    }
    Ok(Some(local).filter(|local| !local.triangles.is_empty()))
}

/// Unit normals in the world; `None` where one has no direction.
fn carry_normals(normals: &[Vec3], world: &DAffine3) -> Option<Vec<Vec3>> {
    let carry = |normal: &Vec3| carry_normal(&world.matrix3, normal.as_dvec3());
    normals.iter().map(|normal| Some(carry(normal)?.as_vec3())).collect()
}
