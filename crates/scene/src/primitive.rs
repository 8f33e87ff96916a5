//! Primitives: one mesh's triangles with one material, in local space.

use std::sync::Arc;

use glam::Vec3;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked::Valid;

use crate::attributes::{self, Attributes, Subject};
use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::numbers::Integers;
use crate::warnings::Warnings;

/// The triangles of a primitive as the file gives them.
pub(crate) struct Local {
    pub positions: Vec<Vec3>,
    /// One per position, where the file gives them.
    pub normals: Option<Vec<Vec3>>,
    pub attributes: Option<Arc<Attributes>>,
    pub triangles: Vec<[u32; 3]>,
    /// Vertices left over after the last whole triangle.
    pub rest: usize,
}

/// Reads the triangles of `primitive`, which stands at `place` and is called `name`; `None` for points and lines.
pub(crate) fn read(
    document: &Document<'_>,
    primitive: &Primitive,
    (place, name): (&str, &str),
    warnings: &mut Warnings,
) -> Result<Option<Local>, Problem> {
    let Valid(mode) = primitive.mode else {
        return Err(malformed(place, "has a mode that glTF does not know"));
    };
    if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        return Ok(None);
    }
    let accessor = primitive.attributes.get(&Valid(Semantic::Positions));
    let accessor = accessor.ok_or_else(|| malformed(place, "has no POSITION"))?.value();
    let positions = positions(document, accessor)?;
    let normals = normals(document, primitive, positions.len())?;
    let subject = Subject { place, name, count: positions.len() };
    let attributes = attributes::read(document, primitive, subject, warnings)?.map(Arc::new);
    let order = order(document, primitive, positions.len())?;
    let rest = if mode == Mode::Triangles { order.len() % 3 } else { 0 };
    Ok(Some(Local { positions, normals, attributes, triangles: triangles(mode, &order), rest }))
}

fn positions(document: &Document<'_>, accessor: usize) -> Result<Vec<Vec3>, Problem> {
    let integers = if document.quantized { Integers::Small } else { Integers::Refused };
    let positions = document.vectors(accessor, integers)?;
    Ok(positions.into_iter().map(Vec3::from_array).collect())
}

fn normals(document: &Document<'_>, primitive: &Primitive, count: usize) -> Result<Option<Vec<Vec3>>, Problem> {
    let Some(accessor) = primitive.attributes.get(&Valid(Semantic::Normals)) else {
        return Ok(None);
    };
    let integers = if document.quantized { Integers::Normalized } else { Integers::Refused };
    let normals = document.vectors(accessor.value(), integers)?;
    if normals.len() != count {
        let fault = format!("has {} normals for {count} positions", normals.len());
        return Err(malformed(format!("accessors[{accessor}]"), fault));
    }
    Ok(Some(normals.into_iter().map(Vec3::from_array).collect()))
}

/// The vertices in the order in which triangles take them.
fn order(document: &Document<'_>, primitive: &Primitive, count: usize) -> Result<Vec<u32>, Problem> {
    match primitive.indices {
        Some(accessor) => document.indices(accessor.value(), count),
        None => Ok((0..count as u32).collect()),
    }
}

/// Triangles of a list, a strip or a fan, as glTF 2.0 orders them (section 3.7.2.1).
fn triangles(mode: Mode, order: &[u32]) -> Vec<[u32; 3]> {
    let corners = |window: &[u32]| [window[0], window[1], window[2]];
    match mode {
        Mode::TriangleStrip => order.windows(3).enumerate().map(|(i, w)| strip(i, corners(w))).collect(),
        Mode::TriangleFan => fan(order),
        _ => order.chunks_exact(3).map(corners).collect(),
    }
}

/// Triangle i of a strip: every second one is turned, so that all show one side.
fn strip(i: usize, [a, b, c]: [u32; 3]) -> [u32; 3] {
    if i.is_multiple_of(2) { [a, b, c] } else { [a, c, b] }
}

/// Triangle i of a fan: (i + 1, i + 2, 0).
fn fan(order: &[u32]) -> Vec<[u32; 3]> {
    match order {
        [hub, rim @ ..] => rim.windows(2).map(|w| [w[0], w[1], *hub]).collect(),
        [] => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use gltf::json::mesh::Mode;

    use super::triangles;

    #[test]
    fn lists_strips_and_fans() {
        let order = [5, 6, 7, 8, 9];
        assert_eq!(triangles(Mode::Triangles, &order), [[5, 6, 7]]);
        assert_eq!(triangles(Mode::TriangleStrip, &order), [[5, 6, 7], [6, 8, 7], [7, 8, 9]]);
        assert_eq!(triangles(Mode::TriangleFan, &order), [[6, 7, 5], [7, 8, 5], [8, 9, 5]]);
        for mode in [Mode::Triangles, Mode::TriangleStrip, Mode::TriangleFan] {
            assert_eq!(triangles(mode, &order[..2]), [[0; 3]; 0]);
            assert_eq!(triangles(mode, &[]), [[0; 3]; 0]);
        }
    }
}
