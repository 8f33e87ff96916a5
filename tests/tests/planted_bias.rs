//! The tests are tested: estimators that are wrong in the ways that estimators go wrong are found out by the very tests
//! that the right ones pass.

use std::borrow::Cow;
use std::f32::consts::TAU;

use twoforms_estimator::density::{ByArea, CosineHemisphere, Density, OnLights, Picking, TowardLights};
use twoforms_estimator::estimator::Single;
use twoforms_estimator::formulation::{Area, Formulation, Hemisphere};
use twoforms_estimator::measure::{Aim, Integrand, Measure, Pdf, Sample, SolidAngle, SurfaceArea};
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::selection::{Picked, Picker, Selection};
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_estimator::xi::Xi;
use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::{Effort, Vantage, View};
use twoforms_tests::domain::{HemisphereCells, LightCells, chi_square};
use twoforms_tests::samples::{Samples, moments};
use twoforms_tests::statistics::{Family, Outcome, ZTest};
use twoforms_tests::worlds::{self, Case};

const SEED: u64 = 20_260_806;
const LEVEL: f64 = 1e-3;
const N: u32 = 100_000;
/// Tests in the largest family that the right estimators pass: a wrong one must be found among as many.
const AMONG: usize = 10_000;

/// The area formulation without cosθ_y.
struct WithoutCosineAtLight;

impl Formulation for WithoutCosineAtLight {
    type Measure = SurfaceArea;
    const NAME: &'static str = "area without cosθ_y";

    fn integrand<R: Real>(view: &Vantage<R>, query: &Query, y: &SurfacePoint<R>) -> Integrand<SurfaceArea, R> {
        let xy = Segment::to(y);
        let v = view.visible(y, xy.facing());
        Integrand::new(query.l_e(view, Masked::new(*y, v)) * query.f_r(view, xy.psi) * (xy.cos_x / (xy.r * xy.r)))
    }

    fn seen<R: Real>(view: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<SurfacePoint<R>, R> {
        Area::seen(view, y)
    }

    fn asks<R: Real>(y: &SurfacePoint<R>) -> R::Mask {
        Area::asks(y)
    }
}

/// The area formulation without V.
struct WithoutVisibility;

impl Formulation for WithoutVisibility {
    type Measure = SurfaceArea;
    const NAME: &'static str = "area without V";

    fn integrand<R: Real>(view: &Vantage<R>, query: &Query, y: &SurfacePoint<R>) -> Integrand<SurfaceArea, R> {
        let xy = Segment::to(y);
        Integrand::new(query.l_e(view, Masked::new(*y, xy.facing())) * query.f_r(view, xy.psi) * xy.g())
    }

    fn seen<R: Real>(view: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<SurfacePoint<R>, R> {
        Area::seen(view, y)
    }

    fn asks<R: Real>(y: &SurfacePoint<R>) -> R::Mask {
        Area::asks(y)
    }
}

/// Draws by `right`, and tells `factor` times its density.
struct Scaled<D> {
    right: D,
    factor: f32,
}

impl<M: Measure, D: Density<M>> Density<M> for Scaled<D> {
    fn sample<R: Real>(&self, view: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<M, R>, R> {
        let scaled =
            |Sample { at, pdf }: Sample<M, R>| Sample { at, pdf: Pdf::new(pdf.value() * R::splat(self.factor)) };
        self.right.sample(view, xi).map(scaled)
    }

    fn pdf<R: Real>(&self, view: &Vantage<R>, at: &M::Point<R>) -> Masked<Pdf<M, R>, R> {
        self.right.pdf(view, at).map(|pdf| Pdf::new(pdf.value() * R::splat(self.factor)))
    }
}

/// Draws directions by the cosine, and tells the uniform density.
struct CosineToldUniform;

impl Density<SolidAngle> for CosineToldUniform {
    fn sample<R: Real>(&self, view: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        CosineHemisphere.sample(view, xi).map(|Sample { at, .. }| Sample { at, pdf: Pdf::new(R::splat(1.0 / TAU)) })
    }

    fn pdf<R: Real>(&self, view: &Vantage<R>, at: &Aim<R>) -> Masked<Pdf<SolidAngle, R>, R> {
        CosineHemisphere.pdf(view, at).map(|_| Pdf::new(R::splat(1.0 / TAU)))
    }
}

/// Draws directions toward points on lights, and tells the density of the points as if it were that of the directions.
struct AreaToldSolidAngle<'p>(OnLights<'p, ByArea>);

impl Density<SolidAngle> for AreaToldSolidAngle<'_> {
    fn sample<R: Real>(&self, view: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        let told = |Sample { at, .. }: Sample<SolidAngle, R>| {
            let density = self.0.picking.density::<R>(at.target);
            Sample { at, pdf: Pdf::new(density) }
        };
        TowardLights { lights: self.0.clone() }.sample(view, xi).map(told)
    }

    fn pdf<R: Real>(&self, view: &Vantage<R>, at: &Aim<R>) -> Masked<Pdf<SolidAngle, R>, R> {
        TowardLights { lights: self.0.clone() }.pdf(view, at).map(|_| Pdf::new(self.0.picking.density::<R>(at.target)))
    }
}

/// Picks lights one way, and tells the density of another.
struct PickedToldOther<'p> {
    picked: OnLights<'p, ByArea>,
    told: OnLights<'p, ByArea>,
}

impl Density<SurfaceArea> for PickedToldOther<'_> {
    fn sample<R: Real>(&self, view: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SurfaceArea, R>, R> {
        let told = |Sample { at, .. }: Sample<SurfaceArea, R>| {
            let (pdf, _) = self.told.pdf(view, &at).parts();
            Sample { at, pdf }
        };
        self.picked.sample(view, xi).map(told)
    }

    fn pdf<R: Real>(&self, view: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<Pdf<SurfaceArea, R>, R> {
        self.told.pdf(view, y)
    }
}

/// Points on triangles without the square root: denser toward the first corner.
struct WithoutSquareRoot<'p>(OnLights<'p, ByArea>);

impl Density<SurfaceArea> for WithoutSquareRoot<'_> {
    fn sample<R: Real>(&self, view: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SurfaceArea, R>, R> {
        let Picked { piece: target, u, .. } = self.0.picking.pick::<R>(xi.pick());
        let at = view.facet(target).point([u * u, xi.v()], target);
        self.pdf(view, &at).map(|pdf| Sample { at, pdf })
    }

    fn pdf<R: Real>(&self, view: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<Pdf<SurfaceArea, R>, R> {
        self.0.pdf(view, y)
    }
}

/// Points uniform over the area of targets picked so.
fn on(picker: &Picker) -> OnLights<'_, ByArea> {
    OnLights { picking: Picking::Listed(Cow::Borrowed(picker)), spread: ByArea }
}

/// What a wrong estimator is tried on.
struct Trial<'a> {
    case: Case<'a>,
    view: View<'a>,
    query: Query<'a>,
    draws: Samples,
}

impl<'a> Trial<'a> {
    fn new(case: Case<'a>) -> Self {
        let world = &case.stage.world;
        let view = View::new(&world.geometry, case.place.frame(), Effort::Gather);
        let strategy = Strategy::from(Kind::HemisphereUniform);
        let draws = Samples::new(SEED, &case.place, strategy, Sampler::Independent, N);
        Self { view, query: Query::irradiance(&world.lights), draws, case }
    }

    fn picker(&self, selection: Selection) -> Picker {
        Picker::of_area(selection, &self.case.stage.world.lights).expect("a selection that is the same for every x")
    }

    fn samples<F: Formulation, D: Density<F::Measure>>(&self, density: D) -> Vec<[f32; 3]> {
        self.draws.of(&Single::<F, D>::new(&self.view, &self.query, density))
    }

    /// The test of a mean against the known answer, by the measured variance.
    fn mean(&self, name: &str, samples: &[[f32; 3]]) -> Outcome {
        let found = moments(samples, 0);
        let expected = self.case.known.irradiance[0];
        let sigma = (found.m2 / (found.n - 1.0) / found.n).sqrt();
        let test = ZTest { found: found.mean, expected, sigma, budget: 3e-6 * expected };
        Outcome::Tested { p: test.p(), evidence: format!("{name}, {}: {test}", self.case) }
    }

    fn estimate<F: Formulation, D: Density<F::Measure>>(&self, name: &str, density: D) -> Outcome {
        self.mean(name, &self.samples::<F, D>(density))
    }
}

/// All these must be rejected, and would be among so many other tests.
fn assert_found_out(name: &'static str, wrong: Vec<Outcome>) {
    let tests = wrong.len();
    let others = vec![Outcome::Tested { p: 1.0, evidence: String::new() }; AMONG];
    let family = Family::new(name, LEVEL, SEED, [wrong, others].concat());
    let rejected = family.rejected();
    println!("{}\n{}", family.summary(), rejected.join("\n"));
    assert_eq!(rejected.len(), tests, "{}\nonly these were rejected:\n{}", family.summary(), rejected.join("\n"));
}

#[test]
fn wrong_means_are_rejected() {
    let [square, cornell, two] = ["square-light", "cornell-box", "two-lights"].map(worlds::stage);
    let near = Trial::new(square.case("half-side-below"));
    let aside = Trial::new(square.case("tilted"));
    let penumbra = Trial::new(cornell.case("floor-penumbra"));
    let both = Trial::new(two.case("both"));
    let by_area = |trial: &Trial| trial.picker(Selection::Together);

    let picker = &by_area(&near);
    let area = || on(picker);
    let all = near.samples::<Hemisphere, _>(CosineHemisphere);
    let hits: Vec<[f32; 3]> = all.into_iter().filter(|worth| worth[0] != 0.0).collect();
    let (picked, told) = (&by_area(&both), &both.picker(Selection::Power));
    let other = PickedToldOther { picked: on(picked), told: on(told) };
    let wrong = vec![
        near.estimate::<WithoutCosineAtLight, _>("no cosine at the light", area()),
        aside.estimate::<WithoutCosineAtLight, _>("no cosine at the light", on(&by_area(&aside))),
        penumbra.estimate::<WithoutVisibility, _>("no visibility", on(&by_area(&penumbra))),
        near.estimate::<Hemisphere, _>("density per area told per solid angle", AreaToldSolidAngle(area())),
        near.estimate::<Hemisphere, _>("cosine-weighted directions told uniform", CosineToldUniform),
        near.estimate::<Hemisphere, _>("2 % too dense", Scaled { right: CosineHemisphere, factor: 1.02 }),
        aside.estimate::<Area, _>("1 % too dense", Scaled { right: on(&by_area(&aside)), factor: 1.01 }),
        near.mean("samples that are zero left out", &hits),
        both.estimate::<Area, _>("lights picked by area told by power", other),
    ];
    assert_found_out("means with a planted bias", wrong);
}

/// The same trials with nothing planted.
#[test]
fn right_means_are_not() {
    let [square, cornell, two] = ["square-light", "cornell-box", "two-lights"].map(worlds::stage);
    let cases =
        [square.case("half-side-below"), square.case("tilted"), cornell.case("floor-penumbra"), two.case("both")];
    let right = cases.map(|case| {
        let trial = Trial::new(case);
        let picker = trial.picker(Selection::Together);
        [
            trial.estimate::<Area, _>("area/uniform", on(&picker)),
            trial.estimate::<Hemisphere, _>("hemisphere/toward-lights", TowardLights { lights: on(&picker) }),
            trial.estimate::<Hemisphere, _>("hemisphere/cosine", CosineHemisphere),
        ]
    });
    Family::new("means without one", LEVEL, SEED, right.concat()).assert_holds(0.0);
}

#[test]
fn wrong_densities_are_rejected() {
    let [square, nori] = ["square-light", "nori-light-1"].map(worlds::stage);
    let near = Trial::new(square.case("half-side-below"));
    let triangle = Trial::new(nori.case("origin"));
    let outcome = |name: &str, found: twoforms_tests::statistics::ChiSquare| Outcome::Tested {
        p: found.p(),
        evidence: format!("{name}: {found}"),
    };
    let directions = |density: &CosineToldUniform| chi_square(&near.view, density, &HemisphereCells::EVEN, &near.draws);
    let picker = triangle.picker(Selection::Together);
    let picking = Picking::Listed(Cow::Borrowed(&picker));
    let cells = LightCells::new(&triangle.view, &picking);
    let points = chi_square(&triangle.view, &WithoutSquareRoot(on(&picker)), &cells, &triangle.draws);
    let wrong = vec![
        outcome("cosine-weighted directions told uniform", directions(&CosineToldUniform)),
        outcome("triangle without the square root", points),
    ];
    assert_found_out("densities that are not what they say", wrong);
}
