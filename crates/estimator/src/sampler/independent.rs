//! Independent samples.

use twoforms_geometry::real::Real;

use super::{Place, Spread};

/// Each sample by itself: Philox 2×32-10 of its index, with what is left of counter and key from the stream.
#[derive(Clone, Copy, Debug)]
pub struct Independent;

impl Spread for Independent {
    type Plan = ();

    fn plan(_: u32, _: u32) {}

    #[inline(always)]
    fn pair<R: Real>((): &(), place: &Place<R>) -> [R::Word; 2] {
        place.noise()
    }
}
