//! Quadrature: deterministic rules on the unit cube.

use twoforms_estimator::gauss::legendre;

/// Nodes on an axis and their weights.
pub type Nodes = Vec<(f64, f64)>;

/// A rule on [0, 1], and its products on cubes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The middles of m cells, each of the same weight: the lecture's rule. Its error falls as 1/m² for smooth functions.
    Midpoint,
    /// The Gauss–Legendre rule of m nodes, exact for polynomials up to degree 2m − 1.
    GaussLegendre,
}

impl Rule {
    /// m nodes on [0, 1] with their weights, which sum to 1.
    pub fn nodes(self, m: u32) -> Nodes {
        let width = 1.0 / f64::from(m);
        match self {
            Self::Midpoint => (0..m).map(|k| ((f64::from(k) + 0.5) * width, width)).collect(),
            Self::GaussLegendre => legendre(m as usize),
        }
    }

    /// ∫ g dξ over the unit cube of `dimension` axes, by the product of the rule of m nodes with itself.
    ///
    /// ```
    /// use twoforms_integration::Rule;
    ///
    /// // ∫∫ x² y⁵ = 1/18, of degree 5: three nodes along each axis are exact.
    /// let integral = Rule::GaussLegendre.integrate(2, 3, |xi| xi[0].powi(2) * xi[1].powi(5));
    /// assert!((integral - 1.0 / 18.0).abs() < 1e-16);
    /// ```
    pub fn integrate(self, dimension: usize, m: u32, g: impl Fn(&[f64]) -> f64) -> f64 {
        product(&vec![self.nodes(m); dimension], |xi, weight| weight * g(xi))
    }
}

/// Σ of a function of node and weight over the product of rules, one for each axis.
pub(crate) fn product(axes: &[Nodes], mut term: impl FnMut(&[f64], f64) -> f64) -> f64 {
    if axes.iter().any(Vec::is_empty) {
        return 0.0;
    }
    let (mut at, mut sum) = (vec![0; axes.len()], 0.0);
    let mut xi: Vec<f64> = axes.iter().map(|axis| axis[0].0).collect();
    loop {
        let weight = axes.iter().zip(&at).map(|(axis, &k)| axis[k].1).product();
        sum += term(&xi, weight);
        let Some(axis) = next(&mut at, axes) else { return sum };
        for k in 0..=axis {
            xi[k] = axes[k][at[k]].0;
        }
    }
}

/// Moves on to the next node, the first axis fastest; answers with the last axis that moved, or nothing after the last node.
fn next(at: &mut [usize], axes: &[Nodes]) -> Option<usize> {
    for (axis, k) in at.iter_mut().enumerate() {
        *k += 1;
        if *k < axes[axis].len() {
            return Some(axis);
        }
        *k = 0;
    }
    None
}
