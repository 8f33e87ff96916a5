//! The size of a scene: bounds what a small file can ask for.

use crate::error::Problem;

/// The most vertices, and the most triangles, that a scene may have.
pub(crate) const LIMIT: usize = 1 << 25;

/// What has been read and made so far, in vertices or triangles, whichever are more.
#[derive(Default)]
pub(crate) struct Budget(usize);

impl Budget {
    /// Takes account of `each` vertices or triangles, `count` times, before they are made for the surface called `name`.
    pub fn spend(&mut self, each: usize, count: usize, name: &str) -> Result<(), Problem> {
        let total = each.checked_mul(count).and_then(|cost| self.0.checked_add(cost));
        self.0 = total.filter(|&total| total <= LIMIT).ok_or_else(|| too_large(&format!("{name:?}")))?;
        Ok(())
    }
}

/// Says that `place` needs more than the limit.
pub(crate) fn too_large(place: &str) -> Problem {
    Problem::TooLarge { place: place.to_owned(), limit: LIMIT }
}
