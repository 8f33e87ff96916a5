//! Where two strategies are equally good.

use glam::DVec3;
use twoforms_estimator::strategy::Strategy;
use twoforms_exact::Sight;

use crate::support::{Scene, ceiling, lamp};
use crate::view_factors::polygon;

const AREA: &str = "area/uniform";
const COSINE: &str = "hemisphere/cosine";
const UNIFORM: &str = "hemisphere/uniform";

fn variance(sight: &Sight, name: &str) -> f64 {
    sight.variance(name.parse::<Strategy>().unwrap()).unwrap().luminance
}

/// A unit square at height h, the receiver beside the point below its centre.
fn square(h: f64, aside: (f64, f64)) -> Sight {
    let scene = Scene::of(vec![lamp(ceiling(DVec3::new(0.0, 0.0, h), 1.0, 1.0), 1.0)]);
    scene.sight(DVec3::new(aside.0, aside.1, 0.0), DVec3::Z)
}

fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = f(high) > 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

/// All sign changes on h/s in [0.01, 10], twelve points a decade.
fn roots(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let grid: Vec<f64> = (0..=36).map(|k| 0.01 * 10_f64.powf(f64::from(k) / 12.0)).collect();
    let changes = grid.windows(2).filter(|pair| (f(pair[0]) > 0.0) != (f(pair[1]) > 0.0));
    changes.map(|pair| root(&f, pair[0], pair[1])).collect()
}

/// Roots known from a computation in 34 to 40 digits, by offset: area = cosine, area = uniform,
/// cosine = uniform.
type Known = ((f64, f64), &'static [f64], &'static [f64], &'static [f64]);

const SQUARE: [Known; 9] = [
    ((0.0, 0.0), &[0.390_387_878_4], &[0.296_531_457_6], &[]),
    ((0.25, 0.0), &[0.399_078_809_1], &[0.303_072_843_5], &[]),
    ((0.5, 0.0), &[0.364_628_463_5], &[0.290_616_870_7], &[]),
    ((0.5, 0.5), &[0.340_687_564_0], &[0.284_282_611_5], &[]),
    ((0.6, 0.0), &[0.045_286_024_9, 0.285_888_731_3], &[0.017_713_918_9, 0.234_684_533_2], &[0.131_538_258_1]),
    ((0.75, 0.0), &[], &[], &[0.265_261_026_1]),
    ((1.0, 0.0), &[], &[], &[0.445_092_493_1]),
    ((2.0, 0.0), &[], &[], &[1.082_085_339_3]),
    ((1.0, 1.0), &[], &[], &[0.693_276_101_3]),
];

#[test]
fn square_light_crossings() {
    for (aside, area_cosine, area_uniform, cosine_uniform) in SQUARE {
        for (one, other, known) in
            [(AREA, COSINE, area_cosine), (AREA, UNIFORM, area_uniform), (COSINE, UNIFORM, cosine_uniform)]
        {
            let found = roots(|h| {
                let sight = square(h, aside);
                variance(&sight, one) - variance(&sight, other)
            });
            assert_eq!(found.len(), known.len(), "{one} = {other} at {aside:?}: {found:?}");
            for (f, k) in found.iter().zip(known) {
                assert!((f - k).abs() < 1e-10, "{one} = {other} at {aside:?}: {f}, known {k}");
            }
        }
    }
}

/// h, E, then the variances of area/uniform, hemisphere/cosine and hemisphere/uniform below the centre.
const CENTRE: [[f64; 5]; 8] = [
    [0.05, 3.116_100_618, 409.168_690_9, 0.079_435_746_61, 3.439_642_371],
    [0.1, 3.042_128_438, 95.461_563_36, 0.302_582_917_7, 3.829_845_622],
    [0.25, 2.610_753_031, 9.852_291_903, 1.385_891_154, 5.420_501_748],
    [0.5, 1.740_839_503, 0.773_667_12, 2.438_486_419, 6.192_766_975],
    [1.0, 0.752_274_688_5, 0.017_178_141_32, 1.797_423_428, 3.857_081_27],
    [2.0, 0.230_836_797_7, 1.323_733_726e-4, 0.671_909_560_7, 1.369_028_28],
    [5.0, 0.039_474_025_28, 1.087_366_347e-7, 0.122_453_109_2, 0.245_647_728_1],
    [10.0, 0.009_966_782_906, 4.394_049_668e-10, 0.031_212_235_2, 0.062_471_781_54],
];

#[test]
fn square_light_below_the_centre() {
    for [h, e, area, cosine, uniform] in CENTRE {
        let sight = square(h, (0.0, 0.0));
        let got =
            [sight.irradiance().luminance, variance(&sight, AREA), variance(&sight, COSINE), variance(&sight, UNIFORM)];
        for (value, known) in got.into_iter().zip([e, area, cosine, uniform]) {
            assert!((value - known).abs() <= 6e-10 * known, "h = {h}: {value}, known {known}");
        }
    }
}

/// Disk below its centre: area = cosine at (1+t)³ − 3(1+t)² − 1 = 0, R/h = √t = 1.450449; area =
/// uniform at 1.906761; solid angle = cosine at 3.202819. Roots for n and 2n corners, extrapolated
/// in 1/n².
#[test]
fn disk_crossings() {
    for (one, other, known) in
        [(AREA, COSINE, 1.450_449), (AREA, UNIFORM, 1.906_761), ("area/solid-angle", COSINE, 3.202_819)]
    {
        let of_polygon = |n: usize| {
            let difference = |radius: f64| {
                let sight = polygon(radius, 1.0, n);
                variance(&sight, one) - variance(&sight, other)
            };
            root(difference, 1.2, 4.0)
        };
        let found = (4.0 * of_polygon(400) - of_polygon(200)) / 3.0;
        assert!((found - known).abs() < 6e-7, "{one} = {other}: {found}, known {known}");
    }
}
