//! Emitting triangles that lie upon one another.

use std::collections::HashSet;

use glam::Vec3;
use twoforms_geometry::mesh::Triangle;

/// A place in space by its bits, with one zero.
pub(crate) type Place = [u32; 3];

/// The place of `vertex`.
pub(crate) fn place(vertex: Vec3) -> Place {
    vertex.to_array().map(|coordinate| (coordinate + 0.0).to_bits())
}

/// The triangles met so far, by their three places in any order.
#[derive(Default)]
pub(crate) struct Seen(HashSet<[Place; 3]>);

impl Seen {
    /// Whether no triangle with the same three vertices came before; remembers this one.
    pub fn is_first(&mut self, triangle: &Triangle) -> bool {
        let mut places = [triangle.a, triangle.b, triangle.c].map(place);
        places.sort_unstable();
        self.0.insert(places)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use twoforms_geometry::mesh::Triangle;

    use super::Seen;

    #[test]
    fn order_and_the_sign_of_zero_do_not_count() {
        let (a, b, c) = (Vec3::ZERO, Vec3::X, Vec3::Y);
        let mut seen = Seen::default();
        assert!(seen.is_first(&Triangle { a, b, c }));
        assert!(!seen.is_first(&Triangle { a: c, b, c: -a }));
        assert!(seen.is_first(&Triangle { a, b, c: Vec3::Z }));
    }
}
