//! From placed nodes to surfaces: every primitive of every mesh, wherever it stands.

use std::collections::BTreeSet;

use gltf::json::mesh::Primitive;

use crate::assembly::{Assembly, Instance};
use crate::document::Document;
use crate::error::Problem;
use crate::hierarchy::Placed;
use crate::instances::{self, Instances};
use crate::limit::Budget;
use crate::primitive::{self, Local};
use crate::warnings::Warnings;

/// Puts the meshes of all placed nodes together.
pub(crate) fn assemble(
    document: &Document<'_>,
    placed: &[Placed],
    warnings: &mut Warnings,
) -> Result<Assembly, Problem> {
    warn_of_unplaced(document, placed, warnings);
    let mut walk = Walk { document, warnings, assembly: Assembly::default(), budget: Budget::default() };
    for placed in placed {
        walk.visit(placed)?;
    }
    Ok(walk.assembly)
}

fn warn_of_unplaced(document: &Document<'_>, placed: &[Placed], warnings: &mut Warnings) {
    let meshes = placed.iter().filter_map(|placed| document.root.nodes[placed.node].mesh);
    let meshes: BTreeSet<usize> = meshes.map(|mesh| mesh.value()).collect();
    for (index, mesh) in document.root.meshes.iter().enumerate().filter(|(index, _)| !meshes.contains(index)) {
        let name = mesh.name.clone().unwrap_or_else(|| format!("meshes[{index}]"));
        warnings.at("a mesh stands nowhere in the scene and is left out", &name);
    }
}

struct Walk<'a> {
    document: &'a Document<'a>,
    warnings: &'a mut Warnings,
    assembly: Assembly,
    budget: Budget,
}

/// A mesh on a node: where it stands and what it is called.
struct Standing<'a> {
    placed: &'a Placed,
    name: String,
    copies: Option<&'a Instances>,
}

impl Walk<'_> {
    fn visit(&mut self, placed: &Placed) -> Result<(), Problem> {
        let node = &self.document.root.nodes[placed.node];
        let Some(index) = node.mesh.map(|mesh| mesh.value()) else {
            return Ok(());
        };
        let mesh = &self.document.root.meshes[index];
        let name = node.name.clone().or_else(|| mesh.name.clone());
        let name = name.unwrap_or_else(|| self.document.node_name(placed.node));
        if node.skin.is_some() {
            self.warnings.at("a skinned mesh stands in its bind pose", &name);
        }
        let copies = instances::read(self.document, placed.node)?;
        self.budget.spend(1, copies.as_ref().map_or(0, Instances::count), &name)?;
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let name = if mesh.primitives.len() > 1 { format!("{name}/{p}") } else { name.clone() };
            let place = format!("meshes[{index}].primitives[{p}]");
            let Some(local) = self.read(primitive, &place, &name)? else { continue };
            self.stand(&local, primitive, &Standing { placed, name, copies: copies.as_ref() })?;
        }
        Ok(())
    }

    /// Reads a primitive that has triangles; warns about what is left out of it.
    fn read(&mut self, primitive: &Primitive, place: &str, name: &str) -> Result<Option<Local>, Problem> {
        self.budget.spend(1, 1, name)?;
        let Some(local) = primitive::read(self.document, primitive, (place, name), self.warnings)? else {
            self.warnings.at("points and lines have no area and are skipped", name);
            return Ok(None);
        };
        let morphs = primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty());
        let losses = [
            (local.attributes.as_ref().is_some_and(|a| a.is_coloured()), "vertex colours are ignored"),
            (morphs, "morph targets are ignored"),
            (local.rest > 0, "vertices that make no whole triangle are left over"),
        ];
        for (_, text) in losses.iter().filter(|(lost, _)| *lost) {
            self.warnings.at(text, name);
        }
        Ok(Some(local))
    }

    /// Adds a primitive wherever its node stands.
    fn stand(&mut self, local: &Local, primitive: &Primitive, standing: &Standing<'_>) -> Result<(), Problem> {
        let Standing { placed, name, copies } = standing;
        let material = primitive.material.map_or(self.document.root.materials.len(), |m| m.value());
        let count = copies.map_or(1, Instances::count);
        self.budget.spend(local.positions.len().max(local.triangles.len()), count, name)?;
        for i in 0..count {
            let (name, world) = match copies {
                None => (name.clone(), placed.world),
                Some(copies) => (format!("{name}[{i}]"), placed.world * copies.transform(i, name)?),
            };
            self.assembly.add(local, Instance { name, world, material }, self.warnings)?;
        }
        Ok(())
    }
}
