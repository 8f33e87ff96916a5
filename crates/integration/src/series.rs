//! Series that make the law of large numbers and rates of convergence visible.

use libm::log;

/// The means of the first 1, 2, 3, … values: what the strong law of large numbers says comes to the expected value.
///
/// ```
/// use twoforms_integration::running_means;
///
/// let means: Vec<f64> = running_means([4.0, 2.0, 3.0]).collect();
/// assert_eq!(means, [4.0, 3.0, 3.0]);
/// ```
pub fn running_means(values: impl IntoIterator<Item = f64>) -> impl Iterator<Item = f64> {
    values.into_iter().scan((0.0, 0.0), |(n, sum), value| {
        (*n, *sum) = (*n + 1.0, *sum + value);
        Some(*sum / *n)
    })
}

/// The exponent b of y = a xᵇ through points (x, y): the slope of ln y over ln x, by least squares. NaN where an x or y is not
/// positive or there are no two different x.
///
/// ```
/// use twoforms_integration::exponent;
///
/// assert!((exponent(&[(1.0, 3.0), (4.0, 1.5), (16.0, 0.75)]) + 0.5).abs() < 1e-15);
/// ```
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let points: Vec<[f64; 2]> = points.iter().map(|&(x, y)| [log(x), log(y)]).collect();
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let sum = |term: fn(f64, f64) -> f64| points.iter().map(|point| term(point[0] - x, point[1] - y)).sum::<f64>();
    sum(|dx, dy| dx * dy) / sum(|dx, _| dx * dx)
}
