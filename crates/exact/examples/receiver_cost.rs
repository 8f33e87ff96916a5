//! Measures what one receiver costs: `cargo run --release -p twoforms-exact --example receiver_cost`.
//!
//! A room 1 m wide with a square light in the ceiling and two blocks between (20 triangles, all of them candidates), over a grid of receivers on the floor; then a light above scattered triangles, from
//! one to 4096 of them.

use std::hint::black_box;
use std::time::Instant;

use glam::{DQuat, DVec3};
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::{Strategy, Team, Weighting};
use twoforms_estimator::technique::{Kind, Technique};
use twoforms_exact::{Facing, Light, Sight};

const CLOSED: &[Strategy] = &[
    Strategy::Single(Technique::of(Kind::HemisphereUniform)),
    Strategy::Single(Technique::of(Kind::HemisphereCosine)),
    Strategy::Single(Technique::of(Kind::HemisphereTowardLights)),
    Strategy::Single(Technique::of(Kind::AreaUniform)),
    Strategy::Single(Technique { kind: Kind::AreaUniform, selection: Selection::Uniform }),
    Strategy::Single(Technique { kind: Kind::AreaUniform, selection: Selection::Power }),
    Strategy::Single(Technique { kind: Kind::AreaUniform, selection: Selection::Contribution }),
];

fn main() {
    room();
    scattered();
}

fn room() {
    let blocks =
        [block(DVec3::new(0.34, 0.30, 0.0), 0.3, 0.6, 0.3), block(DVec3::new(0.66, 0.65, 0.0), 0.3, 0.3, -0.3)];
    let blockers: Vec<_> = blocks.concat();
    let receivers: Vec<_> = (0..400)
        .map(|k| DVec3::new(f64::from(k % 20) + 0.5, f64::from(k / 20) + 0.5, 0.0) / 20.0)
        .map(|x| facing(x, &square(DVec3::new(0.5, 0.5, 1.0), 0.25), &blockers))
        .collect();
    println!("room, {} blockers, {} receivers, one core:", blockers.len(), receivers.len());
    let lights = [Light { area: 0.0625, power: 1.0 }];
    let per = |what: &str, f: &dyn Fn(&Sight)| {
        let seconds =
            (0..20).map(|_| time(|| receivers.iter().for_each(|r| f(&sight(r, &lights))))).fold(f64::MAX, f64::min);
        println!("  {what:<44}{:8.2} µs", 1e6 * seconds / receivers.len() as f64);
    };
    per("visible polygons, moments, irradiance", &|sight| {
        black_box(sight.irradiance());
    });
    per("  and ten closed variances", &|sight| {
        black_box(sight.variances(CLOSED));
    });
    for weighting in [Weighting::Balance, Weighting::Power, Weighting::Optimal] {
        let strategy = Strategy::Mis(weighting, Team::default());
        per(&format!("irradiance and {strategy}"), &|sight| {
            black_box(sight.variance(strategy).ok());
        });
    }
    per("irradiance and mixture/0.5", &|sight| {
        black_box(sight.variance(Strategy::Mixture(0.5, Strategy::PAIR)).ok());
    });
}

fn scattered() {
    println!("scattered triangles in the pyramid:\n  triangles     pieces         µs");
    for power in 0..=12 {
        let n = 1 << power;
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let size = 0.7 / f64::from(n).sqrt();
        let blockers: Vec<[DVec3; 3]> = (0..n)
            .map(|_| {
                let z = 0.3 + 0.6 * random();
                let centre = DVec3::new((random() - 0.5) * z, (random() - 0.5) * z, z);
                [0, 1, 2].map(|_| centre + size * DVec3::new(random() - 0.5, random() - 0.5, random() - 0.5))
            })
            .collect();
        let receiver = facing(DVec3::ZERO, &square(DVec3::Z, 1.0), &blockers);
        let lights = [Light { area: 1.0, power: 1.0 }];
        let pieces: usize = sight(&receiver, &lights).seen.iter().map(|seen| seen.pieces.len()).sum();
        let seconds =
            (0..3).map(|_| time(|| black_box(sight(&receiver, &lights).irradiance()))).fold(f64::MAX, f64::min);
        println!("  {n:9} {pieces:10} {:10.1}", 1e6 * seconds);
    }
}

fn sight(facing: &Facing, lights: &[Light]) -> Sight {
    Sight::new(std::slice::from_ref(facing), lights).expect("the receiver stands on the floor")
}

fn time<T>(f: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(f());
    start.elapsed().as_secs_f64()
}

/// The corners of a horizontal square that shines downward.
fn square(centre: DVec3, side: f64) -> Vec<DVec3> {
    [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
        .map(|(x, y)| centre + 0.5 * side * DVec3::new(x, y, 0.0))
        .to_vec()
}

fn facing(x: DVec3, corners: &[DVec3], blockers: &[[DVec3; 3]]) -> Facing {
    let area = (corners[1] - corners[0]).length() * (corners[2] - corners[1]).length();
    let away = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).dot(x - t[0]).abs() > 1e-12;
    Facing {
        target: 0,
        light: 0,
        corners: corners.iter().map(|&v| v - x).collect(),
        faces: true,
        area,
        radiance: [15.6; 3],
        emitted: 15.6,
        glow: None,
        blockers: blockers.iter().filter(|t| away(t)).map(|t| t.map(|v| v - x)).collect(),
    }
}

/// Top and four sides of a block on the floor: ten triangles, of which those turned to x and those
/// turned away both count.
fn block(centre: DVec3, width: f64, height: f64, turn: f64) -> Vec<[DVec3; 3]> {
    let corner = |x: f64, y: f64, z: f64| {
        centre + DQuat::from_rotation_z(turn) * DVec3::new(0.5 * width * x, 0.5 * width * y, height * z)
    };
    let ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let mut triangles = Vec::new();
    for k in 0..4 {
        let ((a, b), (c, d)) = (ring[k], ring[(k + 1) % 4]);
        triangles.push([corner(a, b, 0.0), corner(c, d, 0.0), corner(c, d, 1.0)]);
        triangles.push([corner(a, b, 0.0), corner(c, d, 1.0), corner(a, b, 1.0)]);
    }
    triangles.push([corner(-1.0, -1.0, 1.0), corner(1.0, -1.0, 1.0), corner(1.0, 1.0, 1.0)]);
    triangles.push([corner(-1.0, -1.0, 1.0), corner(1.0, 1.0, 1.0), corner(-1.0, 1.0, 1.0)]);
    triangles
}
