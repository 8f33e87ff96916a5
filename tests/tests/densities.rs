//! Every density integrates to one, draws what it says, and says what it draws.

use rayon::prelude::*;
use twoforms_estimator::density::Density;
use twoforms_estimator::measure::{Measure, Sample};
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::{Kind, Technique};
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
    /// Largest difference of the others, over what rounding explains.
    worst: f64,
}

/// Roundings of its coordinates, and of the density, by which the point that a density is told for may lie beside the one drawn: where
/// a direction is made of the point, and the point of the direction again, some twenty follow each other, and 21 at most are seen.
const FOUND: f32 = 24.0;
/// The same where a map by solid angle is undone: with its undoing it is some sixty operations long, and 44 at most are seen, beside a
/// wall that fills a quarter of the view and is drawn in parts.
const UNDONE: f32 = 48.0;

struct Telling(Samples, f32);

impl Visitor for Telling {
    type Output = Told;

    fn visit<M: Measure, D: Density<M>>(self, view: &View, density: &D, domain: &impl Domain<M>) -> Told {
        let mut told = Told::default();
        for index in 0..self.0.n {
            let (Sample { at, pdf }, some) = density.sample::<f32>(&view.from_x(), self.0.xi(index)).parts();
            let (again, pdf) = (value(density, view, &at), f64::from(pdf.value()));
            told.drawn += u32::from(some);
            told.lost += u32::from(some && again == 0.0);
            if some && again != 0.0 && again != pdf {
                let apart = |near: M::Point<f32>| (value(density, view, &near) - again).abs();
                let moved = domain.around(&at, self.1).into_iter().map(apart).fold(0.0, f64::max);
                let rounded = f64::from(self.1) * 2.0_f64.powi(-24) * pdf;
                told.worst = told.worst.max((again - pdf).abs() / (moved + rounded));
            }
        }
        told
    }
}

/// What is told with a sample is the density at its point, but for what the density differs by between points that lie as near to
/// each other as its coordinates are rounded: toward lights the point is found again from its direction, seen edgeways if need be,
/// and where a warp is undone the two numbers are found again from the point, across a sliver perhaps. A point on the very edge of
/// a light may be found beside it, one in a thousand at most.
#[test]
fn the_density_told_with_a_sample_is_that_of_its_point() {
    let told = everywhere(|case, strategy, sampler| {
        let is_undone = strategy.techniques().iter().any(|technique| technique.kind == Kind::AreaBilinearCosine);
        Telling(draws(case, strategy, sampler), if is_undone { UNDONE } else { FOUND })
    });
    for (name, told) in told {
        assert!(told.worst <= 1.0 && told.lost <= told.drawn / 1000, "{name}: {told:?}");
    }
}
