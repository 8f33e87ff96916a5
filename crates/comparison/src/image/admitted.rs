//! Which numbers of samples of a pixel a sampler can spread.

use twoforms_estimator::sampler::Sampler;

use super::{PixelFilter, Rendering, Shown};
use crate::error::ComparisonError;
use crate::world::World;

/// How far from the number asked for another one is looked for.
const FARTHEST: u32 = 1 << 16;

impl Rendering {
    /// Makes sure that the sampler can spread the camera samples of a pixel, which are one set of points, and its light
    /// samples, which are another.
    pub(super) fn admit(&self, world: &World) -> Result<(), ComparisonError> {
        if self.quantity == Shown::Radiance && self.strategy.needs_unoccluded() && world.has_highlights() {
            return Err(ComparisonError::Impossible(format!(
                "\"{}\" needs the unhidden light, which an image does not know where surfaces have highlights: \
                 take another strategy, or leave highlights out with --lambert",
                self.strategy
            )));
        }
        self.admit_samples()
    }

    fn admit_samples(&self) -> Result<(), ComparisonError> {
        let Self { strategy, sampler, spp, light_samples, .. } = *self;
        if let Some(why) = strategy.impossible_in_images() {
            return Err(ComparisonError::Impossible(why));
        }
        if !sampler.is_random() {
            return Err(ComparisonError::Impossible(format!(
                "{sampler} is a rule for one pair of numbers, and a sample of an image has more: take a sampler that is random"
            )));
        }
        if self.is_admitted(spp) {
            return Ok(());
        }
        let instead = match self.nearest() {
            Some(nearest) => format!("the nearest that it can is {nearest}"),
            None => format!("with {light_samples} it can spread none: ask for another number of light samples"),
        };
        Err(ComparisonError::Impossible(format!(
            "{sampler} cannot spread {spp} camera samples of a pixel, {light_samples} light samples each: {instead}"
        )))
    }

    fn is_admitted(&self, spp: u32) -> bool {
        let exactly = |sampler: Sampler, n: u32| sampler.rounded(n) == n;
        let light = spp.checked_mul(self.light_samples).is_some_and(|n| exactly(self.sampler, n));
        light && (self.filter == PixelFilter::Point || exactly(self.sampler, spp))
    }

    /// The number of camera samples nearest to the one asked for, the larger of two.
    fn nearest(&self) -> Option<u32> {
        let around = |away: u32| [self.spp.checked_add(away), self.spp.checked_sub(away).filter(|&spp| spp > 0)];
        (1..FARTHEST).flat_map(around).flatten().find(|&spp| self.is_admitted(spp))
    }
}

#[cfg(test)]
mod tests {
    use twoforms_estimator::sampler::Sampler;
    use twoforms_estimator::strategy::Strategy;

    use crate::image::{Crop, PixelFilter, Rendering, Shown};

    fn rendering(sampler: &str, spp: u32, light_samples: u32) -> Rendering {
        Rendering {
            strategy: Strategy::defaults()[0],
            sampler: sampler.parse().expect("a sampler"),
            width: 1,
            height: 1,
            crop: Crop { x0: 0, x1: 1, y0: 0, y1: 1 },
            spp,
            light_samples,
            filter: PixelFilter::Box,
            cull: false,
            quantity: Shown::Radiance,
            seed: 0,
        }
    }

    #[test]
    fn what_a_sampler_can_spread_is_admitted() {
        for (sampler, spp, light) in [("independent", 5, 3), ("halton", 5, 3), ("jittered", 9, 4), ("sobol", 8, 2)] {
            assert_eq!(rendering(sampler, spp, light).admit_samples(), Ok(()), "{sampler}, {spp} × {light}");
        }
        assert_eq!(Rendering { filter: PixelFilter::Point, ..rendering("jittered", 2, 8) }.admit_samples(), Ok(()));
    }

    #[test]
    fn what_it_cannot_is_refused_with_what_it_can() {
        let refused =
            |sampler, spp, light| rendering(sampler, spp, light).admit_samples().map_err(|e| e.to_string()).err();
        let says = |sampler, spp, light, what| {
            let message = refused(sampler, spp, light).unwrap_or_default();
            assert!(message.contains(what), "{message}");
        };
        says("jittered", 5, 1, "nearest that it can is 4");
        says("jittered", 4, 2, "ask for another number of light samples");
        says("sobol", 100, 1, "nearest that it can is 128");
        says("quadrature", 4, 1, "random");
        assert!(Sampler::ALL.iter().all(|sampler| sampler.rounded(16) == 16));
    }
}
