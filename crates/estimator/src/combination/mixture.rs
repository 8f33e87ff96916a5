//! One sample from one of two techniques, by chance: p = A p_1 + (1 − A) p_2.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::view::{Vantage, View};

use crate::estimator::{Primary, Worth, count};
use crate::numbers::Drawn;
use crate::query::Query;
use crate::rgb::Rgb;
use crate::technique::Local;
use crate::xi::Xi;

/// A mixture of two techniques. A technique that cannot come upon a point has density zero there.
pub(crate) struct Mixture<'a> {
    pub(crate) view: &'a View<'a>,
    pub(crate) query: &'a Query<'a>,
    pub(crate) pair: [Local<'a>; 2],
    pub(crate) split: Split,
}

/// Random words split in two: those below a bound, and the rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split {
    bound: u64,
}

const WORDS: f64 = 4_294_967_296.0;

impl Split {
    /// A share of all words, 0 to 1: the nearest multiple of 2⁻³².
    pub(crate) fn new(share: f64) -> Self {
        Self { bound: (share * WORDS).round() as u64 }
    }

    /// The probability of each side: exactly its share of the words.
    fn shares(self) -> [f32; 2] {
        let first = self.bound as f64 / WORDS;
        [first as f32, (1.0 - first) as f32]
    }

    /// Which samples are on the first side.
    #[inline(always)]
    fn first<R: Real>(self, word: R::Word) -> R::Mask {
        match u32::try_from(self.bound) {
            Ok(bound) => R::below(word, R::Word::splat(bound)),
            Err(_) => R::Mask::splat(true),
        }
    }

    /// ξ as each side sees it: the first word stretched to all words, which keeps their order.
    #[inline(always)]
    fn stretched<R: Real>(self, xi: Xi<R>, side: usize) -> Xi<R> {
        let [word, v] = xi.words();
        let width = if side == 0 { self.bound } else { (1 << 32) - self.bound };
        if width == 0 {
            return xi;
        }
        let from_start = if side == 0 { word } else { word.wrapping_sub(R::Word::splat(self.bound as u32)) };
        let factor = u128::from(u64::MAX) / u128::from(width);
        let (whole, part) = ((factor >> 32) as u32, factor as u32);
        let high = from_start.multiply_high(part);
        Xi::new([from_start.wrapping_mul(R::Word::splat(whole)).wrapping_add(high), v])
    }
}

impl Primary for Mixture<'_> {
    fn view(&self) -> &View<'_> {
        self.view
    }

    fn query(&self) -> &Query<'_> {
        self.query
    }

    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let xi = drawn.xi::<R>(0);
        let (shares, first) = (self.split.shares(), self.split.first::<R>(xi.pick()));
        let (mut value, mut rays) = (Rgb::splat([0.0; 3]), R::Word::splat(0));
        for side in 0..2 {
            let here = from.only(if side == 0 { first } else { !first });
            if !here.wanted().any() {
                continue;
            }
            let found = self.pair[side].find(&here, self.split.stretched(xi, side));
            rays = rays.wrapping_add(count::<R>(found.asked));
            if found.seen.any() {
                let other = self.pair[1 - side].pdf_of(&here.only(found.seen), &found.y, &found.xy);
                let p = found.pdf * R::splat(shares[side]) + other * R::splat(shares[1 - side]);
                let f = self.query.received(&here, Masked::new(found.y, found.seen), &found.xy);
                value = value + (f * (R::one() / p)).or_black(found.seen);
            }
        }
        Worth { value, rays }
    }
}

#[cfg(test)]
mod tests {
    use super::Split;
    use crate::xi::Xi;

    /// Each side's words reach from the first to nearly the last, in order.
    #[test]
    fn a_side_is_stretched_over_all_words() {
        for share in [0.1, 0.5, 0.75, 1.0] {
            let split = Split::new(share);
            let last = (split.bound - 1) as u32;
            let of = |word: u32, side: usize| split.stretched::<f32>(Xi::new([word, 7]), side).words()[0];
            assert!(split.first::<f32>(last) && of(0, 0) == 0 && of(last, 0) > u32::MAX - 16, "{share}");
            if share < 1.0 {
                assert!(!split.first::<f32>(last + 1) && of(last + 1, 1) == 0 && of(u32::MAX, 1) > u32::MAX - 16);
            }
            let words: Vec<u32> = (0..100).map(|k| of((f64::from(last) * f64::from(k) / 99.0) as u32, 0)).collect();
            assert!(words.is_sorted(), "{share}: {words:?}");
        }
    }
}
