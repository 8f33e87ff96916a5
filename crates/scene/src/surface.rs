//! Surfaces: what the triangles of a scene belong to.

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use crate::attributes::Attributes;

/// One instance of one primitive: a run of triangles with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name of the node, else of its mesh; with the number of the primitive and of the instance where there are several.
    pub name: String,
    /// Its triangles in the scene's mesh, never empty.
    pub triangles: Range<u32>,
    /// Its vertices in the scene's mesh.
    pub vertices: Range<u32>,
    /// Unit shading normals in world space, one per vertex in order; `None` where the surface is to be shaded flat.
    /// Visibility and emission follow the geometric normal in any case.
    pub normals: Option<Vec<Vec3>>,
    /// What its vertices carry for its material; `None` where that is the same all over. Instances share it.
    pub attributes: Option<Arc<Attributes>>,
    /// Index of its material.
    pub material: usize,
    /// Index of the light that it is, where its material emits.
    pub light: Option<usize>,
}
