//! Scenes for the tests, and their conversion to what one receiver meets.

use glam::DVec3;
use rand::RngExt;
use rand_philox::Philox;
use twoforms_estimator::strategy::Strategy;
use twoforms_exact::{Error, Facing, Light, Sight, with_formula};

pub type Triangle = [DVec3; 3];

/// All strategies with a variance where lights are listed one by one: without the tree over them.
pub fn formulas() -> Vec<Strategy> {
    with_formula().into_iter().filter(|strategy| !strategy.to_string().contains("@tree")).collect()
}

/// A light of the test scenes.
#[derive(Clone, Debug)]
pub struct Lamp {
    pub triangles: Vec<Triangle>,
    pub radiance: [f64; 3],
    pub two_sided: bool,
}

/// Lights and blockers in world space.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    pub lamps: Vec<Lamp>,
    pub blockers: Vec<Triangle>,
}

pub fn lamp(triangles: Vec<Triangle>, radiance: f64) -> Lamp {
    Lamp { triangles, radiance: [radiance; 3], two_sided: false }
}

/// A parallelogram from its corner and two edges, as two triangles with the front along u × v.
pub fn parallelogram(corner: DVec3, u: DVec3, v: DVec3) -> Vec<Triangle> {
    vec![[corner, corner + u, corner + u + v], [corner, corner + u + v, corner + v]]
}

/// A horizontal rectangle about `centre` that shines downward.
pub fn ceiling(centre: DVec3, width: f64, depth: f64) -> Vec<Triangle> {
    let (u, v) = (DVec3::Y * depth, DVec3::X * width);
    parallelogram(centre - 0.5 * (u + v), u, v)
}

/// Seeded random numbers (split mix of 64 bits; Steele, Lea and Flood 2014).
pub struct Random(Philox);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(Philox::from_u64_seed(seed))
    }

    pub fn next(&mut self) -> u64 {
        self.0.random()
    }

    pub fn unit(&mut self) -> f64 {
        self.0.random()
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn point(&mut self, half: f64) -> DVec3 {
        DVec3::new(self.between(-half, half), self.between(-half, half), self.between(-half, half))
    }
}

impl Scene {
    pub fn of(lamps: Vec<Lamp>) -> Self {
        Self { lamps, blockers: Vec::new() }
    }

    /// What x meets: every other triangle may stand between, except those whose plane holds x and
    /// those in the light's plane.
    pub fn facing(&self, x: DVec3, normal: DVec3, merge: bool) -> (Vec<Facing>, Vec<Light>) {
        let frame = Frame::new(x, normal);
        let all: Vec<Triangle> =
            self.lamps.iter().flat_map(|l| l.triangles.clone()).chain(self.blockers.clone()).collect();
        let mut facing = Vec::new();
        for (light, lamp) in self.lamps.iter().enumerate() {
            for outline in outlines(&lamp.triangles, merge) {
                let first = [outline[0], outline[1], outline[2]];
                let blockers = all.iter().filter(|t| !holds(t, x) && !coplanar(t, &first));
                let side = cross(&first).dot(x - first[0]);
                facing.push(Facing {
                    target: facing.len() as u32,
                    light: light as u32,
                    corners: outline.iter().map(|&v| frame.local(v)).collect(),
                    faces: lamp.two_sided || side > 0.0,
                    area: outline.windows(2).skip(1).map(|e| area(&[outline[0], e[0], e[1]])).sum(),
                    radiance: lamp.radiance,
                    emitted: twoforms_estimator::rgb::luminance(lamp.radiance),
                    glow: None,
                    blockers: blockers.map(|t| t.map(|v| frame.local(v))).collect(),
                });
            }
        }
        (facing, self.lamps.iter().map(Lamp::light).collect())
    }

    pub fn try_sight(&self, x: DVec3, normal: DVec3) -> Result<Sight, Error> {
        let (facing, lights) = self.facing(x, normal, true);
        Sight::new(&facing, &lights)
    }

    pub fn sight(&self, x: DVec3, normal: DVec3) -> Sight {
        self.try_sight(x, normal).unwrap()
    }
}

impl Lamp {
    fn light(&self) -> Light {
        let area = self.triangles.iter().map(area).sum();
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        Light { area, power: area * sides * twoforms_estimator::rgb::luminance(self.radiance) }
    }
}

/// Triangles, or where two neighbours share a diagonal and make a parallelogram, its corners.
fn outlines(triangles: &[Triangle], merge: bool) -> Vec<Vec<DVec3>> {
    let mut outlines = Vec::new();
    let mut rest = triangles;
    while let Some((first, others)) = rest.split_first() {
        rest = others;
        if let Some(quad) = others.first().filter(|_| merge).and_then(|second| quad(first, second)) {
            outlines.push(quad);
            rest = &others[1..];
        } else {
            outlines.push(first.to_vec());
        }
    }
    outlines
}

fn quad(one: &Triangle, two: &Triangle) -> Option<Vec<DVec3>> {
    for i in 0..3 {
        let (a, b, c) = (one[i], one[(i + 1) % 3], one[(i + 2) % 3]);
        for j in 0..3 {
            let (d, e, f) = (two[j], two[(j + 1) % 3], two[(j + 2) % 3]);
            if a == d && c == e && (a - b + c - f).length() <= 1e-6 * (c - a).length() && coplanar(two, one) {
                return Some(vec![a, b, c, f]);
            }
        }
    }
    None
}

pub fn cross([a, b, c]: &Triangle) -> DVec3 {
    (*b - *a).cross(*c - *a)
}

pub fn area(t: &Triangle) -> f64 {
    0.5 * cross(t).length()
}

fn magnitude(t: &Triangle) -> f64 {
    t.iter().map(|v| v.abs().max_element()).fold(0.0, f64::max)
}

const TOLERANCE: f64 = 4.0 / 16_777_216.0;

fn within(t: &Triangle, p: DVec3, scale: f64) -> bool {
    let normal = cross(t);
    normal.dot(p - t[0]).abs() <= TOLERANCE * scale * normal.length()
}

pub fn holds(t: &Triangle, x: DVec3) -> bool {
    within(t, x, magnitude(t).max(x.abs().max_element()))
}

pub fn coplanar(one: &Triangle, two: &Triangle) -> bool {
    let scale = magnitude(one).max(magnitude(two));
    one.iter().all(|&v| within(two, v, scale)) || two.iter().all(|&v| within(one, v, scale))
}

/// The receiver's frame: x at the origin, its normal along +Z.
pub struct Frame {
    x: DVec3,
    axes: [DVec3; 3],
}

impl Frame {
    pub fn new(x: DVec3, normal: DVec3) -> Self {
        let n = normal.normalize();
        let other = if n.x.abs() < 0.5 { DVec3::X } else { DVec3::Y };
        let t = other.cross(n).normalize();
        Self { x, axes: [t, n.cross(t), n] }
    }

    pub fn local(&self, v: DVec3) -> DVec3 {
        let d = v - self.x;
        DVec3::from_array(self.axes.map(|axis| axis.dot(d)))
    }

    pub fn world(&self, d: DVec3) -> DVec3 {
        self.axes[0] * d.x + self.axes[1] * d.y + self.axes[2] * d.z
    }
}
