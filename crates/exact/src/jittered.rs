//! The variance of jittered sampling over the lights' area.

use glam::DVec3;

use crate::error::Error;
use crate::facing::{Facing, Light};
use crate::sight::Sight;
use crate::value::Value;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;

/// Variance of the mean of N = n × n samples of `area/uniform`, one in each cell of an n × n grid over (u, v).
///
/// u picks the target by its share of the area, in the order of the list, and is rescaled to [0, 1]. On a parallelogram
/// y = c₀ + u (c₁ − c₀) + v (c₃ − c₀), on a triangle y = a + √u ((b − a) + v (c − b)), so that strata are parallelograms, triangles
/// and trapezoids: what x sees of each is again a set of polygons. The samples being independent, V_N = Σ_k V_k, where V_k is the
/// variance of one sample, uniform over the stratum's area, of the light that comes from there.
///
/// Every target must be listed, also those that do not face x.
///
/// # Errors
/// As [`Sight::new`] and [`Sight::variance`]; [`Error::Unlisted`] when the targets' areas do not add up to those of the lights.
pub fn variance_of_jittered(facing: &[Facing], lights: &[Light], n: u32) -> Result<Value, Error> {
    let listed: f64 = facing.iter().map(|target| target.area).sum();
    let total: f64 = lights.iter().map(|light| light.area).sum();
    if (listed - total).abs() > 1e-9 * total {
        return Err(Error::Unlisted { listed, total });
    }
    let mut sum = Value::default();
    for i in 0..n {
        let columns = columns(facing, listed, n, i);
        for j in 0..n {
            let v = [share(j, n), share(j + 1, n)];
            sum.add(&variance_of_stratum(&columns, v)?);
        }
    }
    Ok(sum)
}

/// A target and the part of its own u that belongs to one column of strata.
struct Column<'a> {
    target: &'a Facing,
    u: [f64; 2],
}

fn share(k: u32, n: u32) -> f64 {
    f64::from(k) / f64::from(n)
}

/// The targets met by u in [i/n, (i + 1)/n].
fn columns(facing: &[Facing], total: f64, n: u32, i: u32) -> Vec<Column<'_>> {
    let mut before = 0.0;
    let mut columns = Vec::new();
    for target in facing.iter().filter(|target| target.area > 0.0) {
        let rescaled = |u: f64| ((u * total - before) / target.area).clamp(0.0, 1.0);
        let u = [rescaled(share(i, n)), rescaled(share(i + 1, n))];
        if u[0] < u[1] {
            columns.push(Column { target, u });
        }
        before += target.area;
    }
    columns
}

fn variance_of_stratum(columns: &[Column], v: [f64; 2]) -> Result<Value, Error> {
    let parts: Vec<Facing> = columns.iter().map(|column| column.part(v)).collect();
    let area = parts.iter().map(|part| part.area).sum();
    let sight = Sight::new(&parts, &[Light { area, power: area }])?;
    sight.variance(Strategy::from(Kind::AreaUniform))
}

impl Column<'_> {
    /// The part of the target with v in the given range.
    fn part(&self, v: [f64; 2]) -> Facing {
        let target = self.target;
        Facing {
            light: 0,
            corners: outline(&target.corners, self.u, v),
            area: target.area * (self.u[1] - self.u[0]) * (v[1] - v[0]),
            ..target.clone()
        }
    }
}

fn outline(corners: &[DVec3], [u0, u1]: [f64; 2], [v0, v1]: [f64; 2]) -> Vec<DVec3> {
    let at = |u: f64, v: f64| match *corners {
        [a, b, c, d] => a.lerp(b, u).lerp(d.lerp(c, u), v),
        [a, b, c, ..] => a + u.sqrt() * ((b - a) + v * (c - b)),
        _ => DVec3::NAN,
    };
    let quad = [at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1)];
    // The first row of a triangle's strata touches its corner a, where u = 0 is one point.
    if corners.len() == 3 && u0 == 0.0 { quad[..3].to_vec() } else { quad.to_vec() }
}

impl Value {
    fn add(&mut self, other: &Self) {
        let sums = self.rgb.iter_mut().zip(other.rgb);
        sums.for_each(|(sum, term)| *sum += term);
        self.luminance += other.luminance;
        self.error_bound += other.error_bound;
    }
}
