//! Vertex attributes that surfaces are coloured by: texture coordinates and colours.

use glam::DVec2;
use gltf::json::accessor::Type;
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::texture::Info;
use gltf::json::validation::Checked::Valid;
use gltf::json::{self, Material};

use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::mapping::set;
use crate::material::is_unlit;
use crate::numbers::Integers;
use crate::warnings::Warnings;

/// What the vertices of a surface carry for its material, each in the order of the surface's vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    /// The sets that textures ask for, with the n of `TEXCOORD_n`.
    sets: Vec<(u32, Vec<[f32; 2]>)>,
    /// `COLOR_0`: linear red, green, blue and alpha, in [0, 1].
    colors: Option<Vec<[f32; 4]>>,
}

impl Attributes {
    /// The texture coordinates of `vertices` of the surface, by set `set`; `None` where the surface has no such set.
    pub(crate) fn coordinates<const N: usize>(&self, set: u32, vertices: [usize; N]) -> Option<[DVec2; N]> {
        let coordinates = self.set(set)?;
        Some(vertices.map(|vertex| coordinates[vertex].map(f64::from).into()))
    }

    /// The texture coordinates of all vertices, by set `set`.
    pub(crate) fn set(&self, set: u32) -> Option<&[[f32; 2]]> {
        self.sets.iter().find(|(n, _)| *n == set).map(|(_, coordinates)| coordinates.as_slice())
    }

    /// The colours of three vertices of the surface, where it has colours.
    pub(crate) fn colors(&self, vertices: [usize; 3]) -> Option<[[f32; 4]; 3]> {
        self.colors.as_ref().map(|colors| vertices.map(|vertex| colors[vertex]))
    }

    /// The least alpha of its vertices' colours; 1 without any.
    pub(crate) fn least_alpha(&self) -> f32 {
        self.colors.iter().flatten().map(|[.., alpha]| *alpha).fold(1.0, f32::min)
    }

    /// Whether its vertices have colours that are not all white.
    pub(crate) fn is_coloured(&self) -> bool {
        self.colors.is_some()
    }
}

/// Where a primitive stands in the file, what it is called, and how many vertices it has.
#[derive(Clone, Copy)]
pub(crate) struct Subject<'a> {
    pub place: &'a str,
    pub name: &'a str,
    pub count: usize,
}

/// What the vertices of `primitive` carry for its material; `None` where that is nothing. A fault is an error where the
/// primitive emits by it, else a warning.
pub(crate) fn read(
    document: &Document<'_>,
    primitive: &Primitive,
    subject: Subject<'_>,
    warnings: &mut Warnings,
) -> Result<Option<Attributes>, Problem> {
    let mut attributes = Attributes::default();
    let material = primitive.material.and_then(|material| document.root.materials.get(material.value()));
    for (n, emits) in material.map(sets).unwrap_or_default() {
        match coordinates(document, primitive, n, subject) {
            Ok(set) => attributes.sets.push((n, set)),
            Err(problem) if emits => return Err(problem),
            Err(problem) => {
                let text = format!("texture coordinates cannot be used, factors alone count ({problem})");
                warnings.at(&text, subject.name);
            }
        }
    }
    attributes.colors = colors(document, primitive, subject).unwrap_or_else(|problem| {
        warnings.at(&format!("vertex colours cannot be used ({problem})"), subject.name);
        None
    });
    let any = !attributes.sets.is_empty() || attributes.is_coloured();
    Ok(any.then_some(attributes))
}

/// The sets of coordinates that a material asks for, each once, and whether it emits by them.
fn sets(material: &Material) -> Vec<(u32, bool)> {
    let emits = !is_unlit(material) && material.emissive_factor.0.iter().any(|&factor| factor > 0.0);
    let emission = material.emissive_texture.as_ref().filter(|_| emits).map(set);
    let pbr = &material.pbr_metallic_roughness;
    let others = [&pbr.base_color_texture, &pbr.metallic_roughness_texture];
    let others = others.into_iter().flatten().map(|info: &Info| set(info));
    let mut sets: Vec<u32> = emission.into_iter().chain(others).collect();
    sets.sort_unstable();
    sets.dedup();
    sets.into_iter().map(|n| (n, emission == Some(n))).collect()
}

fn coordinates(
    document: &Document<'_>,
    primitive: &Primitive,
    n: u32,
    subject: Subject<'_>,
) -> Result<Vec<[f32; 2]>, Problem> {
    let accessor = primitive.attributes.get(&Valid(Semantic::TexCoords(n)));
    let missing = || malformed(subject.place, format!("has no TEXCOORD_{n}, which a texture of its material asks for"));
    let integers = if document.quantized { Integers::Small } else { Integers::Unsigned };
    let accessor = accessor.ok_or_else(missing)?.value();
    let coordinates = document.vectors(accessor, integers)?;
    one_each(accessor, coordinates.len(), subject)?;
    Ok(coordinates)
}

/// The colours, unless all are white.
fn colors(
    document: &Document<'_>,
    primitive: &Primitive,
    subject: Subject<'_>,
) -> Result<Option<Vec<[f32; 4]>>, Problem> {
    let Some(accessor) = primitive.attributes.get(&Valid(Semantic::Colors(0))).map(json::Index::value) else {
        return Ok(None);
    };
    let three = document.root.accessors.get(accessor).is_some_and(|accessor| accessor.type_ == Valid(Type::Vec3));
    let colors: Vec<[f32; 4]> = if three {
        let colors = document.vectors(accessor, Integers::Unsigned)?;
        colors.into_iter().map(|[red, green, blue]| [red, green, blue, 1.0]).collect()
    } else {
        document.vectors(accessor, Integers::Unsigned)?
    };
    one_each(accessor, colors.len(), subject)?;
    if !colors.iter().flatten().all(|channel| (0.0..=1.0).contains(channel)) {
        return Err(malformed(format!("accessors[{accessor}]"), "has a colour outside [0, 1]"));
    }
    Ok(colors.iter().any(|color| *color != [1.0; 4]).then_some(colors))
}

fn one_each(accessor: usize, found: usize, subject: Subject<'_>) -> Result<(), Problem> {
    if found == subject.count {
        return Ok(());
    }
    let fault = format!("has {found} elements for {} positions", subject.count);
    Err(malformed(format!("accessors[{accessor}]"), fault))
}
