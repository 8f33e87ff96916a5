//! Random scenes against brute-force Monte Carlo: rays against every triangle.
//!
//! Level: |z| < 5.5 for each of some 10³ comparisons, a false alarm in 10⁵ runs were the seed not
//! fixed.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::strategy::Strategy;

use crate::support::{Frame, Lamp, Random, Scene, Triangle, area, cross, holds};

const SAMPLES: usize = 40_000;

/// A scene with what its samplers need.
struct Trace<'a> {
    scene: &'a Scene,
    x: DVec3,
    frame: Frame,
    /// Every triangle, with the lamp it belongs to.
    all: Vec<(Triangle, Option<usize>)>,
    total: f64,
}

impl<'a> Trace<'a> {
    fn new(scene: &'a Scene, x: DVec3, n: DVec3) -> Self {
        let lamps =
            scene.lamps.iter().enumerate().flat_map(|(k, lamp)| lamp.triangles.iter().map(move |t| (*t, Some(k))));
        let all: Vec<_> = lamps.chain(scene.blockers.iter().map(|t| (*t, None))).collect();
        let total = all.iter().filter(|(_, lamp)| lamp.is_some()).map(|(t, _)| area(t)).sum();
        Self { scene, x, frame: Frame::new(x, n), all, total }
    }

    /// y = vp(x, Ψ): the nearest triangle along a world direction, and its distance.
    fn vp(&self, psi: DVec3) -> Option<(usize, f64)> {
        let hits = self.all.iter().enumerate().filter(|(_, (t, _))| !holds(t, self.x));
        let hits = hits.filter_map(|(k, (t, _))| hit(t, self.x, psi).map(|r| (k, r)));
        hits.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// L_e toward x, and p_a of the direction, of the triangle met at distance r.
    fn light(&self, index: usize, r: f64, psi: DVec3) -> Option<([f64; 3], f64)> {
        let (triangle, lamp) = &self.all[index];
        let lamp: &Lamp = &self.scene.lamps[(*lamp)?];
        let cos_y = -cross(triangle).normalize().dot(psi);
        let p_a = r * r / (self.total * cos_y.abs());
        (cos_y > 0.0 || lamp.two_sided).then_some((lamp.radiance, p_a))
    }

    /// Direction by p = cosθ/π, or 1/2π: world direction and cosθ.
    fn direction(&self, random: &mut Random, cosine: bool) -> (DVec3, f64) {
        let u = random.unit();
        let (z, phi) = (if cosine { u.sqrt() } else { u }, TAU * random.unit());
        let r = (1.0 - z * z).sqrt();
        (self.frame.world(DVec3::new(r * phi.cos(), r * phi.sin(), z)), z)
    }

    /// L_e, cosθ_x and p_a toward a point uniform over all lamps, if x sees it.
    fn point(&self, random: &mut Random) -> Option<([f64; 3], f64, f64)> {
        let mut u = random.unit() * self.total;
        let mut chosen = None;
        for (k, (t, lamp)) in self.all.iter().enumerate() {
            if lamp.is_some() && chosen.is_none() {
                chosen = (u < area(t)).then_some(k);
                u -= area(t);
            }
        }
        let index = chosen?;
        let [a, b, c] = self.all[index].0;
        let (s, v) = (random.unit().sqrt(), random.unit());
        let d = a + s * ((b - a) + v * (c - b)) - self.x;
        let psi = d.normalize();
        let cos_x = self.frame.local(self.x + psi).z;
        let (met, _) = self.vp(psi)?;
        let (radiance, p_a) = self.light(index, d.length(), psi)?;
        (met == index && cos_x > 0.0).then_some((radiance, cos_x, p_a))
    }

    fn hemisphere(&self, random: &mut Random, cosine: bool) -> Option<([f64; 3], f64, f64)> {
        let (psi, cos_x) = self.direction(random, cosine);
        let (index, r) = self.vp(psi)?;
        let (radiance, p_a) = self.light(index, r, psi)?;
        Some((radiance, cos_x, p_a))
    }

    /// One value of an estimator.
    fn sample(&self, name: &str, random: &mut Random) -> [f64; 3] {
        let worth = |drawn: Option<([f64; 3], f64, f64)>, weight: &dyn Fn(f64, f64) -> f64| {
            drawn.map_or([0.0; 3], |(l, cos_x, p_a)| l.map(|l| l * cos_x * weight(p_a, cos_x / PI)))
        };
        let pair = |random: &mut Random, area: &dyn Fn(f64, f64) -> f64, hemisphere: &dyn Fn(f64, f64) -> f64| {
            let (a, h) = (worth(self.point(random), area), worth(self.hemisphere(random, true), hemisphere));
            [a[0] + h[0], a[1] + h[1], a[2] + h[2]]
        };
        match name {
            "hemisphere/uniform" => worth(self.hemisphere(random, false), &|_, _| TAU),
            "hemisphere/cosine" => worth(self.hemisphere(random, true), &|_, h| 1.0 / h),
            "area/uniform" => worth(self.point(random), &|a, _| 1.0 / a),
            "mixture/0.5" => {
                let drawn = if random.unit() < 0.5 { self.point(random) } else { self.hemisphere(random, true) };
                worth(drawn, &|a, h| 2.0 / (a + h))
            }
            "mis/balance" => pair(random, &|a, h| 1.0 / (a + h), &|a, h| 1.0 / (a + h)),
            _ => pair(random, &|a, h| a / (a * a + h * h), &|a, h| h / (a * a + h * h)),
        }
    }
}

fn hit(t: &Triangle, x: DVec3, psi: DVec3) -> Option<f64> {
    let (ab, ac, o) = (t[1] - t[0], t[2] - t[0], x - t[0]);
    let p = psi.cross(ac);
    let inverse = 1.0 / ab.dot(p);
    let q = o.cross(ab);
    let (u, v, r) = (o.dot(p) * inverse, psi.dot(q) * inverse, ac.dot(q) * inverse);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && r > 0.0).then_some(r)
}

fn scene(random: &mut Random) -> Scene {
    let lights = 1 + random.next() % 3;
    let lamps = (0..lights).map(|_| {
        let centre = DVec3::new(0.0, 0.0, 0.9) + random.point(0.7);
        let triangles = (0..=random.next() % 2).map(|_| [0, 1, 2].map(|_| centre + random.point(0.6))).collect();
        let radiance = [random.between(0.0, 5.0), random.between(0.0, 5.0), random.between(0.0, 5.0)];
        Lamp { triangles, radiance, two_sided: random.unit() < 0.6 }
    });
    let lamps = lamps.collect();
    let blockers = (0..random.next() % 8).map(|_| {
        let centre = DVec3::new(0.0, 0.0, 0.5) + random.point(0.4);
        [0, 1, 2].map(|_| centre + random.point(0.4))
    });
    Scene { lamps, blockers: blockers.collect() }
}

/// Mean, variance and fourth central moment of the samples, red channel or luminance.
fn moments(samples: &[[f64; 3]], channel: impl Fn([f64; 3]) -> f64) -> (f64, f64, f64) {
    let n = samples.len() as f64;
    let mean = samples.iter().map(|&s| channel(s)).sum::<f64>() / n;
    let power = |k: i32| samples.iter().map(|&s| (channel(s) - mean).powi(k)).sum::<f64>() / n;
    (mean, power(2), power(4))
}

#[test]
fn random_scenes_agree_with_monte_carlo() {
    let mut random = Random::new(2024);
    let (mut wrong, mut compared) = (Vec::new(), 0);
    for k in 0..30 {
        let scene = scene(&mut random);
        let n = DVec3::Z + random.point(0.4);
        let (sight, trace) = (scene.sight(DVec3::ZERO, n), Trace::new(&scene, DVec3::ZERO, n));
        let e = sight.irradiance();
        for name in
            ["hemisphere/uniform", "hemisphere/cosine", "area/uniform", "mixture/0.5", "mis/balance", "mis/power"]
        {
            let v = sight.variance(name.parse::<Strategy>().unwrap()).unwrap();
            let samples: Vec<_> = (0..SAMPLES).map(|_| trace.sample(name, &mut random)).collect();
            for (what, channel, mean, variance) in [
                ("luminance", &luminance as &dyn Fn([f64; 3]) -> f64, e.luminance, v.luminance),
                ("red", &|s: [f64; 3]| s[0], e.rgb[0], v.rgb[0]),
            ] {
                let (m, second, fourth) = moments(&samples, channel);
                let nonzero = samples.iter().filter(|&&s| channel(s) != 0.0).count();
                if nonzero < 300 {
                    continue;
                }
                compared += 2;
                let z_mean = (m - mean) / (variance / SAMPLES as f64).sqrt().max(1e-12 * mean);
                let z_variance =
                    (second - variance) / ((fourth - second * second) / SAMPLES as f64).sqrt().max(1e-9 * variance);
                if z_mean.abs() > 5.5 || z_variance.abs() > 5.5 {
                    wrong.push(format!("scene {k}, {name}, {what}: mean {m} of {mean} (z {z_mean:.1}), variance {second} of {variance} (z {z_variance:.1})"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(compared > 400, "only {compared} comparisons were possible");
}
