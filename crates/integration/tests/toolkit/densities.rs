//! Densities against their own definition: p integrates to F, F⁻¹ undoes F, and drawn points lie as p says.

use twoforms_integration::hemisphere::Angles;
use twoforms_integration::{
    CosineHemisphere, Density, Domain, Estimator, Exponential, Given, Hemisphere, Interval, Line, Linear, Piecewise,
    Power, Source, Transformed, Uniform, Variable, integrate,
};

use crate::support::{Outcome, SIX, close};

type Listed = (&'static str, Interval, Box<dyn Line<Domain = Interval>>);

/// Every density on the line, with an interval that holds all of it but for what is below rounding.
fn all() -> Result<Vec<Listed>, twoforms_integration::Error> {
    let side = Interval::new(0.5, 3.0)?;
    let unit = Interval::UNIT;
    let places = [0.5, 1.0, 1.25, 2.0, 3.0];
    let sine = |x: f64| 0.5 * libm::sin(x - 0.5) / (0.5 * (1.0 - libm::cos(2.5)));
    let rise = |x: f64| (1.0 - libm::cos(x - 0.5)) / (1.0 - libm::cos(2.5));
    Ok(vec![
        ("uniform", side, Box::new(Uniform(side)) as _),
        ("linear, falling to zero", side, Box::new(Linear::new(side, [3.0, 0.0])?)),
        ("linear, rising", side, Box::new(Linear::new(side, [1.0, 1e3])?)),
        ("linear, level", side, Box::new(Linear::new(side, [1e-300, 1e-300])?)),
        ("power 2.5", side, Box::new(Power::new(side, 2.5)?)),
        ("power −1/2", unit, Box::new(Power::new(unit, -0.5)?)),
        ("exponential", Interval::new(1.0, 30.0)?, Box::new(Exponential::new(1.5, 1.0)?)),
        ("exponential, truncated", side, Box::new(Exponential::truncated(0.25, side)?)),
        ("steps", side, Box::new(Piecewise::steps(&places, &[1.0, 0.0, 4.0, 0.5])?)),
        ("lines", side, Box::new(Piecewise::lines(&places, &[0.0, 2.0, 2.0, 0.0, 0.1])?)),
        ("numeric", side, Box::new(Given::numeric(side, sine, rise)?)),
    ])
}

#[test]
fn p_is_what_f_rises_by() -> Outcome {
    for (name, whole, density) in all()? {
        for [from, to] in [[0.0, 1.0], [0.0, 0.3], [0.3, 0.8]] {
            let part = Interval::new(whole.a() + from * whole.length(), whole.a() + to * whole.length())?;
            let known = density.probability(part.a(), part.b());
            let p = |xi: &[f64]| part.length() * density.pdf(&part.at(xi));
            let integral = integrate(1, p, 1e-10, 0.0)?.value;
            assert!((integral - known).abs() < 1e-9, "{name} over {part:?}: {integral}, not {known}");
        }
    }
    Ok(())
}

#[test]
fn inversion_undoes_the_cdf() -> Outcome {
    for (name, whole, density) in all()? {
        for k in 1..1000 {
            let xi = f64::from(k) / 1000.0;
            let x = density.invert(xi);
            assert!(whole.contains(&x), "{name}: F⁻¹({xi}) = {x}");
            assert!((density.cdf(x) - xi).abs() < 4e-15, "{name}: F(F⁻¹({xi})) = {}", density.cdf(x));
        }
        assert_eq!([density.cdf(whole.a() - 1.0), density.pdf(&(whole.a() - 1.0))], [0.0, 0.0], "{name}");
    }
    Ok(())
}

/// χ² over twenty cells of equal probability, seed 21: qchisq(1e-8, 19, lower.tail = FALSE) is 74.0, so eleven tests have level
/// 1.1·10⁻⁷ together.
#[test]
fn drawn_points_lie_as_p_says() -> Outcome {
    for (name, _, density) in all()? {
        let mut counts = [0.0_f64; 20];
        let points = Transformed::new(|x| x, density.as_ref()).samples(&Source::independent(21).stream(20_000, 0))?;
        for x in points {
            counts[((density.cdf(x) * 20.0) as usize).min(19)] += 1.0;
        }
        let chi2: f64 = counts.iter().map(|count| (count - 1000.0).powi(2) / 1000.0).sum();
        assert!(chi2 < 74.0, "{name}: χ² {chi2}");
    }
    Ok(())
}

/// Tables are followed in shape, and not only made densities: areas 1 and 3 under the lines, 2 and 2 under the steps.
#[test]
fn tables_are_proportional_to_what_they_were_given() -> Outcome {
    let lines = Piecewise::lines(&[0.0, 1.0, 3.0], &[0.0, 2.0, 1.0])?;
    for (x, value) in [(0.25, 0.5), (0.5, 1.0), (1.0, 2.0), (2.0, 1.5), (3.0, 1.0), (3.5, 0.0), (-1.0, 0.0)] {
        close(lines.pdf(&x), value / 4.0, 1e-15);
    }
    let steps = Piecewise::steps(&[0.0, 1.0, 5.0], &[2.0, 0.5])?;
    for (x, cdf) in [(-1.0, 0.0), (0.5, 0.25), (1.0, 0.5), (3.0, 0.75), (9.0, 1.0)] {
        close(steps.cdf(x), cdf, 1e-15);
    }
    Ok(())
}

/// E[g] over drawn directions is ∫ g p dω over all directions.
#[test]
fn directions_lie_as_p_says() -> Outcome {
    let g = |Angles { phi, theta }: Angles| 2.0 + libm::cos(phi) * libm::cos(theta) + theta;
    let drawn = Transformed::new(g, CosineHemisphere).exact(1e-11)?.mean;
    let weighed = Estimator::new(|at| g(at) * CosineHemisphere.pdf(&at), Uniform(Hemisphere)).exact(1e-10)?.mean;
    close(drawn, weighed, 1e-8);
    let one = Estimator::new(|at| CosineHemisphere.pdf(&at), Uniform(Hemisphere)).exact(1e-11)?.mean;
    close(one, 1.0, 1e-10);
    Ok(())
}

/// Parts of a product are drawn independently: E[xy] = E[x] E[y]. Seed 22.
#[test]
fn products_are_independent() -> Outcome {
    let side = Interval::new(0.0, 2.0)?;
    let pair = (Power::new(side, 1.0)?, Exponential::new(2.0, 0.0)?);
    let product =
        Transformed::new(|(x, y): (f64, f64)| x * y, pair).average(&Source::independent(22).stream(50_000, 0))?;
    let sigma = (product.variance().unwrap_or(f64::NAN) / 50_000.0).sqrt();
    close(product.mean, 4.0 / 3.0 * 0.5, SIX * sigma);
    assert_eq!(pair.pdf(&(1.0, 0.0)), 0.5 * 2.0);
    Ok(())
}
