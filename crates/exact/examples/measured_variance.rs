//! Holds the measured mean and variance of techniques that draw points on the lights against exact ones:
//! `measured_variance SCENE.gltf [SAMPLES]`.

use std::path::Path;
use std::time::Instant;

use twoforms_estimator::density::{
    AreaOnLights, Density, ProjectedSolidAngleOnLights, Ready, SolidAngleOnLights, TowardLightsMarginally,
};
use twoforms_estimator::estimator::Single;
use twoforms_estimator::formulation::{Area, Formulation, Hemisphere};
use twoforms_estimator::lights::Lights;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::secondary::secondary;
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::{Kind, Technique};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_exact::receiver::look;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::view::{Effort, View};
use twoforms_scene::Scene;

struct At<'a> {
    name: &'a str,
    view: &'a View<'a>,
    query: &'a Query<'a>,
    sight: &'a twoforms_exact::sight::Sight,
    samples: u32,
}

fn main() {
    let path = std::env::args().nth(1).expect("a scene");
    let samples = std::env::args().nth(2).and_then(|n| n.parse().ok()).unwrap_or(1 << 20);
    let scene = Scene::load(Path::new(&path)).expect("a scene that can be read");
    let geometry = Geometry::new(scene.mesh.clone(), scene.targets.clone());
    let lights = Lights::new(&scene);
    let query = Query::irradiance(&lights);
    for receiver in &scene.receivers {
        let frame = Frame::new(receiver.position, receiver.normal);
        let view = View::new(&geometry, frame, Effort::Gather);
        let Ok(sight) = look(&geometry, &lights, &frame, [1.0; 3]) else { continue };
        let at = At { name: &receiver.name, view: &view, query: &query, sight: &sight, samples };
        for selection in Selection::ALL {
            at.row::<Area, AreaOnLights>(&lights, Technique { kind: Kind::AreaUniform, selection });
            at.row::<Area, SolidAngleOnLights>(&lights, Technique { kind: Kind::AreaSolidAngle, selection });
            let kind = Kind::HemisphereTowardLightsMarginal;
            at.row::<Hemisphere, TowardLightsMarginally>(&lights, Technique { kind, selection });
            let kind = Kind::AreaProjectedSolidAngle;
            at.row::<Area, ProjectedSolidAngleOnLights>(&lights, Technique { kind, selection });
        }
    }
}

impl At<'_> {
    fn row<F: Formulation, D>(&self, lights: &Lights, technique: Technique)
    where
        D: Ready<Measure = F::Measure>,
        for<'a> D::At<'a>: Density<F::Measure>,
    {
        let begin = Instant::now();
        let ready = D::prepare(lights, technique.selection);
        let density = ready.at(self.view, self.query);
        let set_up = begin.elapsed().as_secs_f64();
        let estimator = Single::<F, _>::new(self.view, self.query, density);
        let draws = Draws { key: Key::new([7]), stream: [self.samples, 0] };
        let stream = Stream { sampler: Sampler::Independent, draws, n: self.samples };
        let begin = Instant::now();
        let estimate = secondary(&estimator, stream).expect("finite samples");
        let seconds = begin.elapsed().as_secs_f64();
        let (mean, variance) = (estimate.luminance.mean, estimate.luminance.m2 / f64::from(self.samples - 1));
        let truth = self.sight.irradiance().luminance;
        let exact = self.sight.variance(Strategy::Single(technique));
        let z = (mean - truth) / (variance / f64::from(self.samples)).sqrt();
        println!(
            "{:24} {:36} z {z:7.2} bias/E {:9.1e} V/E² {:.4e} exact {:?} {:.2} ns/sample, set-up {:.2} µs",
            self.name,
            technique.to_string(),
            mean / truth - 1.0,
            variance / truth / truth,
            exact.map(|v| format!("{:.4e}", v.luminance / truth / truth)),
            seconds / f64::from(self.samples) * 1e9,
            set_up * 1e6,
        );
    }
}
