//! `EXT_mesh_gpu_instancing`: one node, many places.

use glam::{DAffine3, Vec3, Vec4};

use crate::document::Document;
use crate::error::Problem;
use crate::numbers::Integers;
use crate::transform::from_parts;

/// The instances of one node.
pub(crate) struct Instances {
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
    Ok(Some(Instances {
        translations: accessor("TRANSLATION").map(vectors).transpose()?,
        rotations: accessor("ROTATION").map(quaternions).transpose()?,
        scales: accessor("SCALE").map(vectors).transpose()?,
    }))
}

impl Instances {
    /// The number of instances, where all parts agree on it.
    pub fn count(&self) -> Option<usize> {
        let lengths = [
            self.translations.as_ref().map(Vec::len),
            self.rotations.as_ref().map(Vec::len),
            self.scales.as_ref().map(Vec::len),
        ];
        let mut given = lengths.into_iter().flatten();
        let first = given.next().unwrap_or(0);
        given.all(|length| length == first).then_some(first)
    }

    /// The transform from the mesh of instance `i` to the node, or what is wrong with it.
    pub fn transform(&self, i: usize) -> Result<DAffine3, String> {
        let translation = self.translations.as_ref().map_or(Vec3::ZERO, |t| t[i].into());
        let rotation = self.rotations.as_ref().map_or(Vec4::W, |r| r[i].into());
        let scale = self.scales.as_ref().map_or(Vec3::ONE, |s| s[i].into());
        from_parts(translation.as_dvec3(), rotation.as_dvec4(), scale.as_dvec3())
    }
}
