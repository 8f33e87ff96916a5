//! What a receiver sees of all lights, and the integrals over it.

use glam::DVec3;

use super::cubature::over_polygon;
use super::moments::SphericalPolygon;
use super::sight::Sight;
use super::{Part, Receiver};

/// What a receiver sees of one emitting triangle, integrated.
pub struct Seen<'a> {
    light: &'a Part,
    sight: Sight,
    /// ∫ cosθ_x dω.
    pub m10: f64,
    /// ∫ cos²θ_x dω.
    pub m20: f64,
    /// `M_23` / s² = ∫ (a b / r²)² dA.
    squared_kernel: f64,
    by_cubature: bool,
}

impl<'a> Seen<'a> {
    fn new(light: &'a Part, sight: Sight, n: DVec3) -> Self {
        let mut seen = Self { light, m10: 0.0, m20: 0.0, squared_kernel: 0.0, by_cubature: false, sight };
        let (m, s) = (seen.sight.m, seen.sight.s);
        for piece in &seen.sight.pieces {
            let polygon = SphericalPolygon::new(piece, n, m);
            let cancels = polygon.cancels();
            seen.by_cubature |= cancels;
            let [m10, m20, squared_kernel] = if cancels { cubature(piece, n, m) } else { closed_form(&polygon, s) };
            seen.m10 += m10;
            seen.m20 += m20;
            seen.squared_kernel += squared_kernel;
        }
        seen
    }

    fn radiance(&self, channel: usize) -> f64 {
        f64::from(self.light.material.radiance[channel])
    }
}

/// `M_10`, `M_20` and `M_23` / s² by edge sums.
pub fn closed_form(polygon: &SphericalPolygon, s: f64) -> [f64; 3] {
    [polygon.moment(1, 0), polygon.moment(2, 0), polygon.moment(2, 3) / (s * s)]
}

/// The same over the flat piece, in area measure.
pub fn cubature(piece: &[DVec3], n: DVec3, m: DVec3) -> [f64; 3] {
    let cos_x = |y: DVec3| n.dot(y.normalize());
    [
        over_polygon(piece, |y| kernel(n, m, y)),
        over_polygon(piece, |y| kernel(n, m, y) * cos_x(y)),
        over_polygon(piece, |y| kernel(n, m, y) * kernel(n, m, y)),
    ]
}

/// cosθ_x cosθ_y / r² for x at the origin.
fn kernel(n: DVec3, m: DVec3, y: DVec3) -> f64 {
    let r2 = y.length_squared();
    n.dot(y) * m.dot(y) / (r2 * r2)
}

/// All that a receiver sees.
pub struct View<'a> {
    n: DVec3,
    seen: Vec<Seen<'a>>,
}

impl<'a> View<'a> {
    /// Everything in sight among opaque parts.
    pub fn new(parts: &'a [Part], receiver: &Receiver) -> Self {
        let (x, n) = (receiver.x(), receiver.n_x());
        let mut seen = Vec::new();
        for light in parts.iter().filter(|part| part.material.emits()) {
            let sights = light.triangles().filter_map(|t| Sight::new(x, n, t, light, parts));
            seen.extend(sights.map(|sight| Seen::new(light, sight, n)));
        }
        Self { n, seen }
    }

    /// E in one channel.
    pub fn irradiance(&self, channel: usize) -> f64 {
        self.seen.iter().map(|seen| seen.radiance(channel) * seen.m10).sum()
    }

    /// V = Σ L² E[w²] - E² for a density of directions; `second` is E[w²] for unit radiance.
    pub fn over_directions(&self, channel: usize, second: impl Fn(&Seen) -> f64) -> f64 {
        let e = self.irradiance(channel);
        let terms = self.seen.iter().map(|seen| seen.radiance(channel).powi(2) * second(seen));
        terms.sum::<f64>() - e * e
    }

    /// V when a light is picked with probability q and a point on it uniformly: p_A = q / area.
    pub fn over_lights(&self, q: impl Fn(&Part) -> f64) -> [f64; 3] {
        let p_a = |light: &Part| q(light) / light.area();
        rgb(|channel| {
            let e = self.irradiance(channel);
            let v = self.over_directions(channel, |seen| seen.squared_kernel / p_a(seen.light));
            if v < 1e-4 * e * e { self.centred(channel, p_a) } else { v }
        })
    }

    /// V = ∫ (w - E)² p + E² (1 - ∫ p), by cubature: every term is positive.
    fn centred(&self, channel: usize, p_a: impl Fn(&Part) -> f64) -> f64 {
        let e = self.irradiance(channel);
        let (mut inside, mut probability) = (0.0, 0.0);
        for seen in &self.seen {
            let (m, p, l) = (seen.sight.m, p_a(seen.light), seen.radiance(channel));
            let deviation = |y| (l * kernel(self.n, m, y) / p - e).powi(2);
            let pieces = seen.sight.pieces.iter().map(|piece| over_polygon(piece, deviation));
            inside += p * pieces.sum::<f64>();
            probability += p * seen.sight.area();
        }
        inside + e * e * beyond_rounding(1.0 - probability)
    }
}

/// Zero for a probability that rounding alone explains.
fn beyond_rounding(probability: f64) -> f64 {
    if probability < 1e-12 { 0.0 } else { probability }
}

/// Words for where the numbers come from.
impl View<'_> {
    /// The formulas in use, their sources, and how much is hidden.
    pub fn derivation(&self) -> String {
        let pieces: usize = self.seen.iter().map(|seen| seen.sight.pieces.len()).sum();
        match pieces {
            0 => "No point of a light is in sight: every sample is zero.".to_string(),
            _ => format!("{} {}. {VARIANCES}", self.rule(), self.region()),
        }
    }

    fn rule(&self) -> &'static str {
        if self.seen.iter().any(|seen| seen.by_cubature) { CUBATURE } else { LAMBERT }
    }

    fn region(&self) -> String {
        let whole: f64 = self.seen.iter().map(|seen| seen.sight.unoccluded_area).sum();
        let visible: f64 = self.seen.iter().map(|seen| seen.sight.area()).sum();
        if whole - visible <= 1e-12 * whole {
            return "over the lights' edges, nothing standing in between".to_string();
        }
        let hidden = 100.0 * (1.0 - visible / whole);
        format!(
            "over the edges of what is left of the lights when every other triangle's shadow is cut away ({hidden:.2} % of their area is hidden)"
        )
    }
}

const LAMBERT: &str = "E = 1/2 sum L Theta (G.n) (Lambert 1760; Baum, Rushmeier and Winget 1989)";
const CUBATURE: &str =
    "E = integral of L cos(theta_x) cos(theta_y) / r^2 dA by Gauss-Legendre cubature, as Lambert's sum cancels here,";
const VARIANCES: &str = "Variance of one sample = E[w^2] - E^2, where E[w^2] is the sum of 2 pi L^2 M20 (hemisphere/uniform), pi L^2 M10 (hemisphere/cosine), L^2 M23 / (s^2 p_A) (on the lights); M_ij = integral of cos^i(theta_x) cos^j(theta_y) over solid angle (Arvo 1995), s = distance to the light's plane.";

/// By channel; + 0 turns -0, the sum of nothing, into 0.
pub fn rgb(value: impl Fn(usize) -> f64) -> [f64; 3] {
    [0, 1, 2].map(|channel| value(channel) + 0.0)
}
