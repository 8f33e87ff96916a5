//! What each sampler promises of its strata.

use twoforms_estimator::sampler::Sampler;

use super::points::{each_once, points, stratum, stream};

/// The sampler of this name.
fn named(name: &str) -> Sampler {
    name.parse().expect("a sampler")
}

/// One point in every elementary interval of the volume 1/N, for points that are as many as a power of two.
fn is_net(points: &[[u32; 2]]) -> bool {
    let n = points.len() as u32;
    let digits = n.ilog2();
    (0..=digits).all(|across| {
        let [columns, rows] = [1 << across, 1 << (digits - across)];
        each_once(points.iter().map(|[u, v]| stratum(*v, rows) * columns + stratum(*u, columns)), n)
    })
}

#[test]
fn jittered_has_one_in_each_cell() {
    for side in [1, 2, 3, 8, 17] {
        for pair in 0..3 {
            let points = points(&stream(named("jittered"), side * side, 1, 7), pair);
            let cells = points.iter().map(|[u, v]| stratum(*v, side) * side + stratum(*u, side));
            assert!(each_once(cells, side * side), "{side} by {side}, pair {pair}");
        }
    }
}

#[test]
fn multi_jittered_has_one_in_each_cell_column_and_row() {
    for [columns, rows] in [[1, 1], [1, 3], [2, 3], [4, 4], [5, 7], [31, 32]] {
        let n = columns * rows;
        for pair in 0..3 {
            let points = points(&stream(named("multi-jittered"), n, 2, 5), pair);
            let cells = points.iter().map(|[u, v]| stratum(*v, rows) * columns + stratum(*u, columns));
            assert!(each_once(cells, n), "{columns} by {rows}, pair {pair}");
            for axis in 0..2 {
                assert!(each_once(points.iter().map(|point| stratum(point[axis], n)), n), "{n}, pair {pair}, {axis}");
            }
        }
    }
}

#[test]
fn nets_have_one_in_each_elementary_interval() {
    for sampler in ["sobol", "pmj02"].map(named) {
        for digits in 0..11 {
            for pair in 0..3 {
                let points = points(&stream(sampler, 1 << digits, 3, digits), pair);
                assert!(is_net(&points), "{sampler}: 2^{digits} points, pair {pair}");
            }
        }
    }
}

/// What is taken at a multiple of a power of two is a net as well: so do the light samples of one camera sample.
#[test]
fn nets_are_made_of_nets() {
    for sampler in ["sobol", "pmj02"].map(named) {
        for pair in 0..2 {
            let points = points(&stream(sampler, 256, 4, 1), pair);
            for size in [1, 2, 8, 64] {
                assert!(points.chunks(size).all(is_net), "{sampler}: {size} of 256 points, pair {pair}");
            }
        }
    }
}

/// In each base that a pair has, as many strata as a power of it that divides N hold as many points each.
#[test]
fn halton_fills_the_strata_of_its_bases() {
    let primes = [[2, 3], [5, 7], [11, 13], [17, 19]];
    for (pair, bases) in primes.into_iter().enumerate() {
        for axis in 0..2 {
            let base: u32 = bases[axis];
            for n in [base, base * base, base * base * 4] {
                let strata = if n == base { base } else { base * base };
                let points = points(&stream(named("halton"), n, 5, 3), pair);
                let mut held = vec![0; strata as usize];
                for point in &points {
                    held[stratum(point[axis], strata) as usize] += 1;
                }
                assert!(held.iter().all(|&held| held == n / strata), "base {base}, {n} points: {held:?}");
            }
        }
    }
}

/// Cells of 2^a × 3^b, of which N = 2^a·3^b points have one each: both numbers of a pair come from one index.
#[test]
fn halton_fills_cells_of_both_bases() {
    let points = points(&stream(named("halton"), 72, 6, 3), 0);
    assert!(each_once(points.iter().map(|[u, v]| stratum(*u, 8) * 9 + stratum(*v, 9)), 72));
}

/// The points of a lattice differ by points of the lattice: sums of differences are differences again. And one axis has one
/// point in each of N strata from any point on.
#[test]
fn a_lattice_is_closed_under_differences() {
    for pair in [0, 1, 20] {
        let points = points(&stream(named("lattice"), 64, 7, 2), pair);
        let from_first = |[u, v]: [u32; 2]| [u.wrapping_sub(points[0][0]), v.wrapping_sub(points[0][1])];
        let differences: Vec<[u32; 2]> = points.iter().map(|&point| from_first(point)).collect();
        for a in &differences {
            for b in &differences {
                assert!(differences.contains(&[a[0].wrapping_add(b[0]), a[1].wrapping_add(b[1])]), "pair {pair}");
            }
        }
        for axis in 0..2 {
            assert!(each_once(differences.iter().map(|point| stratum(point[axis], 64)), 64), "pair {pair}");
        }
    }
}

/// The lattices of a sample's first two pairs keep their points apart: the shortest difference is at least 0.45 times that of
/// the best lattice, (2/√3)^(1/2) N^(-1/2).
#[test]
fn the_first_lattices_keep_their_points_apart() {
    for pair in 0..2 {
        for digits in 4..13 {
            let points = points(&stream(named("lattice"), 1 << digits, 8, 0), pair);
            let length = |[u, v]: [u32; 2]| {
                let [du, dv] =
                    [u.wrapping_sub(points[0][0]), v.wrapping_sub(points[0][1])].map(|d| f64::from(d as i32));
                du.hypot(dv) / super::points::WORDS
            };
            let shortest = points[1..].iter().map(|&point| length(point)).fold(1.0, f64::min);
            let best = (2.0 / 3.0_f64.sqrt() / f64::from(1 << digits)).sqrt();
            assert!(shortest >= 0.45 * best, "pair {pair}, 2^{digits} points: {shortest} of {best}");
        }
    }
}

#[test]
fn the_midpoint_rule_lies_at_midpoints() {
    let points = points(&stream(named("quadrature"), 9, 0, 0), 0);
    let sixths = points.iter().map(|point| point.map(|word| (super::points::unit(word) * 6.0 * 1e6).round() / 1e6));
    let known = (0..9).map(|k| [f64::from(2 * (k % 3) + 1), f64::from(2 * (k / 3) + 1)]);
    assert!(sixths.eq(known), "{points:?}");
}

/// What is rounded once is not rounded again, and nothing is rounded down.
#[test]
fn rounded_counts_stay() {
    for &sampler in Sampler::ALL {
        for n in (1..2000).chain([65_535, 65_536, 1_000_000]) {
            let rounded = sampler.rounded(n);
            assert!(rounded >= n, "{sampler}: {n} becomes {rounded}");
            assert_eq!(sampler.rounded(rounded), rounded, "{sampler}: {n}");
        }
    }
    assert_eq!(
        [named("jittered").rounded(5), named("multi-jittered").rounded(5), named("sobol").rounded(5)],
        [9, 6, 8]
    );
}
