//! A ray as the lanes see it: rounded to binary32, with what the rounding can do.

use fearless_simd::{Simd, f32x8, prelude::*};

use crate::ray::Ray;

/// 2⁻²⁴: what rounding to binary32 changes at most, relative.
pub(super) const EPSILON: f32 = f32::EPSILON / 2.0;

/// Coordinates from this magnitude on are not held against lanes: products of three of them would overflow.
pub(super) const HUGE: f64 = (1_u64 << 60) as f64;

/// A slope below this is taken for this, so that its inverse is finite: along any ray within the scene and its origin
/// (a length of at most 4R, R their largest coordinate) the difference is at most 2⁻⁵⁰ R, less than [`GRAZE`] of R.
const FLAT: f32 = 1.0 / (1_u64 << 52) as f32;

/// How far the faces of a box move apart, in units of R, the largest coordinate of scene and origin: more than what
/// [`FLAT`] and the rounding of the binary64 test can displace a ray, so that a ray within a face meets the box.
const GRAZE: f32 = 1.0 / (1_u64 << 46) as f32;

/// A ray rounded to binary32. Its direction is scaled so that its largest component is ±1; distances t' = t·|d_z| are
/// in those units, with z the axis of that component.
///
/// **Boxes.** The ray enters the slab between two planes at (b − o)/d'. The lanes compute b·r − o·r with r = 1/d': r is
/// wrong by 3ε relative (ε = 2⁻²⁴), o, the products and the difference by ε each, so the distance is wrong by at most
/// 4ε|T| + 4ε|o·r|, fused or not. The faces are moved apart by w = 8ε|o| + 2⁻⁴⁶ R, and the far distance is stretched by
/// 1 + 16ε: no box is missed that the ray meets.
pub(super) struct Probe<S: Simd> {
    /// Rows of a node that the ray meets first and last, for each axis.
    pub(super) near_rows: [usize; 3],
    pub(super) far_rows: [usize; 3],
    pub(super) near: [Slab<S>; 3],
    pub(super) far: [Slab<S>; 3],
    /// The axes of the shear: z is that of the largest component.
    pub(super) axes: [usize; 3],
    /// The origin along those axes.
    pub(super) origin: [f32x8<S>; 3],
    /// Minus the slopes of the shear.
    pub(super) slope: [f32x8<S>; 2],
    /// The sign bit of d_z.
    pub(super) backward: u32,
    /// 32ε times the origin's largest coordinate.
    pub(super) blur: f32,
    /// |d_z|: what a distance is multiplied by to give t'.
    scale: f64,
}

/// The distance of a plane b along one axis is b·rate + start.
pub(super) struct Slab<S: Simd> {
    pub(super) rate: f32x8<S>,
    pub(super) start: f32x8<S>,
}

impl<S: Simd> Probe<S> {
    /// The probe of a ray through a scene whose largest coordinate is `magnitude`.
    #[inline(always)]
    pub(super) fn new(simd: S, ray: &Ray, magnitude: f32) -> Self {
        let shear = ray.shear();
        let [x, y, z] = shear.axes;
        let along = ray.direction[z];
        let sign = 1.0_f32.copysign(along as f32);
        let mut step = [0.0; 3];
        step[x] = shear.slope[0] as f32 * sign;
        step[y] = shear.slope[1] as f32 * sign;
        step[z] = sign;
        let origin = ray.origin.as_vec3().to_array();
        let most = origin[0].abs().max(origin[1].abs()).max(origin[2].abs());
        let graze = GRAZE * most.max(magnitude);
        let rate = step.map(|d| 1.0 / if d.abs() < FLAT { FLAT } else { d });
        let apart = [0, 1, 2].map(|k| (8.0 * EPSILON * origin[k].abs() + graze) * rate[k].abs());
        let stretch = 1.0 + 16.0 * EPSILON;
        let slab = |rate: f32, start: f32| Slab { rate: f32x8::splat(simd, rate), start: f32x8::splat(simd, start) };
        Self {
            near_rows: [0, 1, 2].map(|k| if rate[k] < 0.0 { k + 3 } else { k }),
            far_rows: [0, 1, 2].map(|k| if rate[k] < 0.0 { k } else { k + 3 }),
            near: [0, 1, 2].map(|k| slab(rate[k], -origin[k] * rate[k] - apart[k])),
            far: [0, 1, 2].map(|k| slab(rate[k] * stretch, (apart[k] - origin[k] * rate[k]) * stretch)),
            axes: shear.axes,
            origin: [x, y, z].map(|k| f32x8::splat(simd, origin[k])),
            slope: shear.slope.map(|s| f32x8::splat(simd, -s as f32)),
            backward: (along as f32).to_bits() & SIGN,
            blur: 32.0 * EPSILON * most,
            scale: along.abs(),
        }
    }

    /// t' of a distance in units of the ray's direction, rounded up.
    #[inline(always)]
    pub(super) fn reach(&self, t: f64) -> f32 {
        (t * self.scale) as f32 * (1.0 + 16.0 * EPSILON) + f32::MIN_POSITIVE
    }
}

/// The sign bit of a binary32 number.
pub(super) const SIGN: u32 = 1 << 31;
