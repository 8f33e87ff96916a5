//! Irradiance and the variance of one sample, with no randomness at all.
//!
//! With a = cosθ_x, b = cosθ_y, the visible part W of each light's triangle (radiance L, plane at
//! distance s) and the moments M_ij = ∫_W a^i b^j dω, an estimator with density p has
//! V = E[w²] - E² with
//!
//! | quantity | value, summed over the triangles |
//! |---|---|
//! | E | L `M_10` |
//! | E[w²], p(Ψ) = 1/2π | 2π L² `M_20` |
//! | E[w²], p(Ψ) = cosθ_x/π | π L² `M_10` |
//! | E[w²], p(y) = p_A on the light | L² `M_23` / (s² p_A), as dA = s² dω / b³ |
//!
//! Where these sums cancel they give way to cubature over W in area measure: `M_ij` for a piece that
//! looks small or thin, and V = ∫ (w - E)² p + E² (1 - ∫ p) when V is less than E² / 10⁴.

use std::f64::consts::PI;

use super::view::{View, rgb};
use super::{Part, Receiver};

/// What is known at a receiver, per RGB channel.
#[derive(Clone, Debug)]
pub struct Answer {
    /// E = ∫ `L_e` cosθ dω.
    pub irradiance: [f64; 3],
    /// The variance of one sample of E by each strategy.
    pub variance: Vec<(&'static str, [f64; 3])>,
    /// Where the numbers come from.
    pub derivation: String,
}

impl Answer {
    /// The variance by one strategy.
    pub fn variance(&self, strategy: &str) -> Option<[f64; 3]> {
        self.variance.iter().find(|(name, _)| *name == strategy).map(|&(_, variance)| variance)
    }
}

/// The answer at a receiver among opaque parts, by edge sums over what it sees of each light.
pub fn answer(parts: &[Part], receiver: &Receiver) -> Answer {
    let view = View::new(parts, receiver);
    let lights: Vec<&Part> = parts.iter().filter(|part| part.material.emits()).collect();
    let count = lights.len() as f64;
    let area: f64 = lights.iter().map(|light| light.area()).sum();
    let total_power: f64 = lights.iter().map(|light| power(light)).sum();
    let by_area = view.over_lights(|light| light.area() / area);
    Answer {
        irradiance: rgb(|c| view.irradiance(c)),
        variance: vec![
            ("hemisphere/uniform", rgb(|c| view.over_directions(c, |of| 2.0 * PI * of.m20))),
            ("hemisphere/cosine", rgb(|c| view.over_directions(c, |of| PI * of.m10))),
            ("hemisphere/toward-lights", by_area),
            ("area/uniform", by_area),
            ("area/uniform@uniform", view.over_lights(|_| 1.0 / count)),
            ("area/uniform@power", view.over_lights(|light| power(light) / total_power)),
        ],
        derivation: view.derivation(),
    }
}

/// What selection by power goes by: area × luminance × sides.
fn power(light: &Part) -> f64 {
    light.area() * light.material.luminance() * light.sides()
}
