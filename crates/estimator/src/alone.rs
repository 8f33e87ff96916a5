//! Samples that are computed one by one, because what they ask for is looked up one by one: the numbers of a scalar
//! [`Real`] as themselves.

use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::vector::Vector;

/// The coordinates of a vector of scalar numbers.
#[inline(always)]
pub(crate) fn coordinates<R: Real>(vector: Vector<R>) -> [f32; 3] {
    let mut coordinates = [0.0; 3];
    for (own, coordinate) in coordinates.iter_mut().zip(vector.to_array()) {
        let mut one = [0.0];
        coordinate.store(&mut one);
        *own = one[0];
    }
    coordinates
}

/// The word of a scalar number.
#[inline(always)]
pub(crate) fn word<R: Real>(word: R::Word) -> u32 {
    let mut one = [0];
    word.store(&mut one);
    one[0]
}
