//! Accessors: typed runs of numbers in buffers.

use std::borrow::Cow;

use gltf::json::Accessor;
use gltf::json::accessor::sparse::Sparse;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked::Valid;

use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::extensions;
use crate::limit::{LIMIT, too_large};
use crate::numbers::{Integers, integer, number};
use crate::view::Run;

/// The elements of one accessor without gaps, after sparse substitution.
struct Packed<'a> {
    bytes: Cow<'a, [u8]>,
    component: ComponentType,
    normalized: bool,
}

impl Document<'_> {
    /// Reads accessor `index` as vectors of `N` finite numbers: binary32, or the `integers` that may stand for them.
    pub fn vectors<const N: usize>(&self, index: usize, integers: Integers) -> Result<Vec<[f32; N]>, Problem> {
        let kind = match N {
            2 => Type::Vec2,
            3 => Type::Vec3,
            _ => Type::Vec4,
        };
        let packed = self.packed(index, kind)?;
        if !integers.allow(packed.component, packed.normalized) {
            return Err(malformed(place(index), format!("does not hold {integers}")));
        }
        let vectors: Vec<[f32; N]> = packed.vectors().collect();
        match vectors.iter().flatten().position(|number| !number.is_finite()) {
            Some(at) => Err(malformed(place(index), format!("is NaN or infinite at element {}", at / N))),
            None => Ok(vectors),
        }
    }

    /// Reads accessor `index` as indices of vertices, each below `count`. The largest value of the type is none: it
    /// asks some hardware to begin a new strip, and glTF forbids it.
    pub fn indices(&self, index: usize, count: usize) -> Result<Vec<u32>, Problem> {
        let packed = self.packed(index, Type::Scalar)?;
        let restart = match packed.component {
            ComponentType::U8 => u32::from(u8::MAX),
            ComponentType::U16 => u32::from(u16::MAX),
            ComponentType::U32 => u32::MAX,
            _ => return Err(malformed(place(index), "does not hold unsigned integers, as indices are")),
        };
        let indices: Vec<u32> = packed.integers().collect();
        match indices.iter().find(|&&i| i as usize >= count || i == restart) {
            Some(i) => Err(malformed(place(index), format!("has index {i} for {count} vertices"))),
            None => Ok(indices),
        }
    }

    fn packed(&self, index: usize, kind: Type) -> Result<Packed<'_>, Problem> {
        let accessor = self.root.accessors.get(index);
        let accessor = accessor.ok_or_else(|| malformed(place(index), "does not exist"))?;
        let Valid(component) = accessor.component_type else {
            return Err(malformed(place(index), "has a component type that glTF does not know"));
        };
        if accessor.type_ != Valid(kind) {
            return Err(malformed(place(index), format!("is not a {}", name(kind))));
        }
        let size = component.0.size() * kind.multiplicity();
        let mut bytes = self.dense(index, accessor, size)?;
        if let Some(sparse) = &accessor.sparse {
            self.substitute(index, sparse, size, bytes.to_mut())?;
        }
        Ok(Packed { bytes, component: component.0, normalized: accessor.normalized })
    }

    /// The elements before sparse substitution: from the buffer, or zeros where there is none.
    fn dense(&self, index: usize, accessor: &Accessor, size: usize) -> Result<Cow<'_, [u8]>, Problem> {
        let count = count(index, accessor.count.0)?;
        let run = Run { offset: accessor.byte_offset.unwrap_or_default().0, size, count };
        match (accessor.buffer_view, &accessor.sparse) {
            (Some(view), _) => self.elements(&place(index), view.value(), run),
            (None, None) if extensions::compressed(&self.root) => Err(Problem::Unsupported {
                what: format!("{} has no data but compressed", place(index)),
                remedy: extensions::UNPACK.into(),
            }),
            (None, _) => Ok(vec![0; size * count].into()),
        }
    }

    fn substitute(
        &self,
        index: usize,
        Sparse { count: many, indices, values, .. }: &Sparse,
        size: usize,
        bytes: &mut [u8],
    ) -> Result<(), Problem> {
        let Valid(component) = indices.component_type else {
            return Err(malformed(place(index), "has sparse indices of an unknown type"));
        };
        let (place, count, width) = (place(index), count(index, many.0)?, component.0.size());
        let positions = Run { offset: indices.byte_offset.0, size: width, count };
        let positions = self.elements(&place, indices.buffer_view.value(), positions)?;
        let elements = Run { offset: values.byte_offset.0, size, count };
        let elements = self.elements(&place, values.buffer_view.value(), elements)?;
        for (position, value) in positions.chunks_exact(width).zip(elements.chunks_exact(size)) {
            let element = bytes.chunks_exact_mut(size).nth(integer(position) as usize);
            let beyond = || malformed(&place, "has a sparse index beyond its end");
            element.ok_or_else(beyond)?.copy_from_slice(value);
        }
        Ok(())
    }
}

impl Packed<'_> {
    fn vectors<const N: usize>(&self) -> impl Iterator<Item = [f32; N]> {
        let size = self.component.size();
        let at = move |element: &[u8], i: usize| number(&element[i * size..][..size], self.component, self.normalized);
        let elements = self.bytes.chunks_exact(size * N);
        elements.map(move |element| std::array::from_fn(|i| at(element, i)))
    }

    fn integers(&self) -> impl Iterator<Item = u32> {
        self.bytes.chunks_exact(self.component.size()).map(integer)
    }
}

fn count(index: usize, count: u64) -> Result<usize, Problem> {
    let held = usize::try_from(count).ok().filter(|&count| count <= LIMIT);
    held.ok_or_else(|| too_large(&place(index)))
}

fn place(index: usize) -> String {
    format!("accessors[{index}]")
}

fn name(kind: Type) -> &'static str {
    match kind {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        _ => "VEC4",
    }
}
