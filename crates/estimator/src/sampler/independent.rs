//! Independent samples.

use twoforms_geometry::real::Real;

use super::{Place, Spread};
use crate::philox::philox2x32_10;

/// Each sample by itself: Philox 2×32-10 of its index, with what is left of counter and key from the stream.
#[derive(Clone, Copy, Debug)]
pub struct Independent;

impl Spread for Independent {
    #[inline(always)]
    fn pair<R: Real>(place: &Place<R>) -> [R::Word; 2] {
        let [key, high, ..] = place.seed;
        let [pair] = philox2x32_10([[place.index, high]], key);
        pair
    }

    #[inline(always)]
    fn two<R: Real>([one, other]: [Place<R>; 2]) -> [[R::Word; 2]; 2] {
        let [key, high, ..] = one.seed;
        philox2x32_10([[one.index, high], [other.index, high]], key)
    }
}
