//! `EXT_mesh_gpu_instancing`: one node, many places.

use glam::{DAffine3, Vec3, Vec4};

use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::numbers::Integers;
use crate::transform::from_parts;

/// The instances of one node: as many of each attribute as there are instances, or none.
pub(crate) struct Instances {
    count: usize,
    translations: Option<Vec<[f32; 3]>>,
    rotations: Option<Vec<[f32; 4]>>,
    scales: Option<Vec<[f32; 3]>>,
}

/// The instances of the mesh of node `node`; `None` for a node that stands once.
pub(crate) fn read(document: &Document<'_>, node: usize) -> Result<Option<Instances>, Problem> {
    let Some(attributes) = document.placements[node].instancing() else {
        return Ok(None);
    };
    let accessor = |name: &str| attributes.get(name).copied();
    let vectors = |index| document.vectors(index, Integers::Refused);
    let quaternions = |index| document.vectors(index, Integers::Normalized);
    let translations = accessor("TRANSLATION").map(vectors).transpose()?;
    let rotations = accessor("ROTATION").map(quaternions).transpose()?;
    let scales = accessor("SCALE").map(vectors).transpose()?;
    let lengths =
        [translations.as_ref().map(Vec::len), rotations.as_ref().map(Vec::len), scales.as_ref().map(Vec::len)];
    let count = common(&lengths).ok_or_else(|| {
        let place = format!("node {:?}", document.node_name(node));
        malformed(place, "has instances whose translations, rotations and scales differ in number")
    })?;
    Ok(Some(Instances { count, translations, rotations, scales }))
}

/// The length that all have that are there; zero where none is, nothing where they differ.
fn common(lengths: &[Option<usize>]) -> Option<usize> {
    let mut given = lengths.iter().flatten();
    let first = *given.next().unwrap_or(&0);
    given.all(|&length| length == first).then_some(first)
}

impl Instances {
    /// The number of instances.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The transform from the mesh of instance `i` to its node, which is called `name`.
    pub fn transform(&self, i: usize, name: &str) -> Result<DAffine3, Problem> {
        let translation = self.translations.as_ref().map_or(Vec3::ZERO, |t| t[i].into());
        let rotation = self.rotations.as_ref().map_or(Vec4::W, |r| r[i].into());
        let scale = self.scales.as_ref().map_or(Vec3::ONE, |s| s[i].into());
        from_parts(translation.as_dvec3(), rotation.as_dvec4(), scale.as_dvec3())
            .map_err(|fault| malformed(format!("instance {i} of {name:?}"), fault))
    }
}
