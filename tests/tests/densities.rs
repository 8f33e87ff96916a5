//! Every density integrates to one, draws what it says, and says what it draws.

use rayon::prelude::*;
use twoforms_estimator::density::Density;
use twoforms_estimator::measure::{Measure, Sample};
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Technique;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::densities::{Visitor, visit};
use twoforms_tests::domain::{Domain, chi_square, value};
use twoforms_tests::samples::Samples;
use twoforms_tests::statistics::{ChiSquare, Family, Outcome};
use twoforms_tests::worlds::{self, Case};

const SEED: u64 = 20_260_801;
const LEVEL: f64 = 1e-3;
/// Samples of each χ² test.
const N: u32 = 50_000;

/// Visits the densities of all techniques at all receivers, each with what `visitor` makes of them; with all samplers where
/// a scene's first receiver is and no light is picked.
fn everywhere<V, T>(visitor: impl Fn(&Case, Strategy, Sampler) -> V + Sync) -> Vec<(String, T)>
where
    V: Visitor<Output = T>,
    T: Send,
{
    let stages = worlds::all();
    let at = |case: &Case| {
        let world = &case.stage.world;
        let view = View::new(&world.geometry, case.place.frame(), Effort::Gather);
        let mut found = Vec::new();
        for technique in Technique::all() {
            let all = case.place.name == case.stage.cases()[0].place.name && technique.selection == Selection::Together;
            let random = Sampler::ALL.iter().copied().filter(|sampler| sampler.is_random());
            for sampler in random.filter(|sampler| all || *sampler == Sampler::Independent) {
                let name = format!("{case} {technique} {sampler}");
                found.push((
                    name,
                    visit(
                        technique,
                        &Query::irradiance(&world.lights),
                        &view,
                        visitor(case, technique.into(), sampler),
                    ),
                ));
            }
        }
        found
    };
    worlds::cases(&stages).par_iter().flat_map(at).collect()
}

fn draws(case: &Case, strategy: Strategy, sampler: Sampler) -> Samples {
    Samples::new(SEED, &case.place, strategy, sampler, N)
}

/// What a density comes to over its domain.
#[derive(Debug)]
struct Sum {
    /// ∫p.
    integral: f64,
    /// What it should be.
    mass: f64,
    /// How far apart the two may lie.
    resolution: f64,
    /// Points beyond the domain where the density is not zero.
    beyond: usize,
}

struct Integral;

impl Visitor for Integral {
    type Output = Sum;

    fn visit<M: Measure, D: Density<M>>(self, view: &View, density: &D, domain: &impl Domain<M>) -> Sum {
        let p = |at: &M::Point<f32>| value(density, view, at);
        let patches = domain.patches();
        let integral = patches.iter().map(|patch| p(&patch.at) * patch.measure).sum();
        let beyond = domain.beyond().iter().filter(|at| p(at) != 0.0).count();
        Sum { integral, mass: domain.mass(), resolution: domain.resolution(), beyond }
    }
}

/// ∫ p = 1 over hemispheres and lights; toward lights, the probability that the point drawn faces x. Zero elsewhere.
#[test]
fn densities_integrate_to_one() {
    for (name, sum) in everywhere(|_, _, _| Integral) {
        let apart = (sum.integral - sum.mass).abs();
        assert!(apart <= sum.resolution && sum.beyond == 0, "{name}: {sum:?}");
    }
}

struct Counts(Samples);

impl Visitor for Counts {
    type Output = ChiSquare;

    fn visit<M: Measure, D: Density<M>>(self, view: &View, density: &D, domain: &impl Domain<M>) -> Self::Output {
        chi_square(view, density, domain, &self.0)
    }
}

#[test]
fn samples_follow_their_density() {
    let counts = everywhere(|case, strategy, sampler| Counts(draws(case, strategy, sampler)));
    let outcome = |(name, found): (String, ChiSquare)| match found.freedom {
        0 => Outcome::Skipped { why: format!("{name}: all samples are alike") },
        _ => Outcome::Tested { p: found.p(), evidence: format!("{name}: {found}") },
    };
    let outcomes = counts.into_iter().map(outcome).collect();
    Family::new("χ² of samples against their density", LEVEL, SEED, outcomes).assert_holds(0.05);
}

/// How samples and the density at their points agree.
#[derive(Debug, Default)]
struct Told {
    drawn: u32,
    /// Samples at whose points there is no density.
    lost: u32,
    /// Largest relative difference of the others.
    worst: f64,
}

struct Telling(Samples);

impl Visitor for Telling {
    type Output = Told;

    fn visit<M: Measure, D: Density<M>>(self, view: &View, density: &D, _: &impl Domain<M>) -> Told {
        let mut told = Told::default();
        for index in 0..self.0.n {
            let (Sample { at, pdf }, some) = density.sample::<f32>(&view.from_x(), self.0.xi(index)).parts();
            let again = value(density, view, &at);
            told.drawn += u32::from(some);
            told.lost += u32::from(some && again == 0.0);
            if some && again != 0.0 {
                told.worst = told.worst.max((again / f64::from(pdf.value()) - 1.0).abs());
            }
        }
        told
    }
}

/// Toward lights the point is found again from its direction, whose rounding counts for more the more the light is
/// seen edgeways; and a point on the very edge of a light may be found beside it, one in a thousand at most.
#[test]
fn the_density_told_with_a_sample_is_that_of_its_point() {
    for (name, told) in everywhere(|case, strategy, sampler| Telling(draws(case, strategy, sampler))) {
        let least = if name.contains("bilinear") { 1e-3 } else { 1e-5 };
        assert!(told.worst <= least && told.lost <= told.drawn / 1000, "{name}: {told:?}");
    }
}
