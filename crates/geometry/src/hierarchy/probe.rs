//! A ray as the lanes see it: rounded to binary32, with what the rounding can do.

use std::ops::Range;

use glam::Vec3A;

use crate::ray::{Ray, Shear};

/// 2⁻²⁴: what rounding to binary32 changes at most, relative.
pub(super) const EPSILON: f32 = f32::EPSILON / 2.0;

/// Coordinates from this magnitude on are not held against lanes: products would overflow.
pub(super) const HUGE: f64 = (1_u64 << 40) as f64;
/// The squared lengths of directions that are held against lanes as they are: their largest components are between 2⁻³⁰
/// and 2³⁰.
pub(super) const STEPS: Range<f64> = 3.0 / (1_u64 << 60) as f64..(1_u64 << 60) as f64;
/// Scenes smaller than this are taken to be of this size, so that what is granted to rounding does not underflow.
const SMALL: f32 = 1.0 / (1_u64 << 60) as f32;

/// A component below this is taken for this, so that its inverse is finite. The largest is at least 2⁻³⁰ ([`STEPS`]), so
/// that along any ray within the scene and its origin (a length of at most 4R, R their largest coordinate) the difference
/// is at most 2⁻⁵⁰ R, less than [`GRAZE`] of R.
const FLAT: f32 = 1.0 / (1_u128 << 82) as f32;

/// How far the faces of a box move apart, in units of R, the largest coordinate of scene and origin: more than what
/// [`FLAT`] and the rounding of the binary64 test can displace a ray, so that a ray within a face meets the box.
const GRAZE: f32 = 1.0 / (1_u64 << 46) as f32;

/// By how much distances are stretched for their own rounding.
pub(super) const STRETCH: f32 = 1.0 + 16.0 * EPSILON;

/// By how much distances are shortened for their own rounding and that of the products they are compared with.
const SHORTENED: f32 = 1.0 - 64.0 * EPSILON;

/// The sign bit of a binary32 number.
pub(super) const SIGN: u32 = 1 << 31;

/// A ray rounded to binary32, with distances in units of its direction's length.
///
/// **Boxes.** The ray enters the slab between two planes at (b − o)/d. The lanes compute b·r − o·r with r = 1/d: r is
/// wrong by 3ε relative (ε = 2⁻²⁴), o, the products and the difference by ε each, so the distance is wrong by at most
/// 4ε|T| + 4ε|o·r|, fused or not. The faces are moved apart by w = 8ε|o| + 2⁻⁴⁶ R, and the far distance is stretched by
/// S = 1 + 16ε: no box is missed that the ray meets. It is b·(r·S) − (o·r − w·|r|)·S, whose factors are wrong by ε each,
/// and it by ε|T| + 2ε|o·r| more.
#[derive(Clone, Copy)]
pub(super) struct Probe {
    /// 1/d, for each axis.
    pub(super) rate: [f32; 3],
    /// 1/d, stretched.
    pub(super) stretched: [f32; 3],
    /// A face b is entered at b·rate + enter, and left at b·stretched + leave.
    pub(super) enter: [f32; 3],
    pub(super) leave: [f32; 3],
    /// The rows of a node that hold the faces where the ray enters, and those where it leaves.
    pub(super) near: [usize; 3],
    pub(super) far: [usize; 3],
    /// The origin.
    pub(super) place: [f32; 3],
    /// By how much the faces are moved apart.
    pub(super) apart: [f32; 3],
    /// The axes of the shear: z is that of the largest component.
    pub(super) axes: [usize; 3],
    /// The origin along those axes.
    pub(super) origin: [f32; 3],
    /// Minus the slopes of the shear.
    pub(super) slope: [f32; 2],
    /// The sign bit of d_z.
    pub(super) backward: u32,
    /// |d_z|: what a distance is multiplied by to give a depth.
    pub(super) depth: f32,
    /// 32ε times the origin's largest coordinate.
    pub(super) blur: f32,
    /// The largest coordinate of the origin and the scene, rounded up.
    pub(super) magnitude: f32,
}

impl Probe {
    /// The probe of no ray.
    pub(super) const NONE: Self = Self {
        rate: [0.0; 3],
        stretched: [0.0; 3],
        enter: [0.0; 3],
        leave: [0.0; 3],
        near: [0; 3],
        far: [0; 3],
        place: [0.0; 3],
        apart: [0.0; 3],
        axes: [0; 3],
        origin: [0.0; 3],
        slope: [0.0; 2],
        backward: 0,
        depth: 0.0,
        blur: 0.0,
        magnitude: 0.0,
    };

    /// The probe of a ray through a scene whose largest coordinate is `magnitude`.
    #[inline(always)]
    pub(super) fn new(ray: &Ray, shear: &Shear, magnitude: f32) -> Self {
        let (origin, step) = (ray.origin.as_vec3a(), ray.direction.as_vec3a());
        let flat = Vec3A::splat(FLAT);
        let step = Vec3A::select(step.abs().cmplt(flat), flat, step);
        let rate = 1.0 / step;
        let most = origin.abs().max_element();
        let apart = origin.abs() * (8.0 * EPSILON) + GRAZE * most.max(magnitude).max(SMALL);
        let (shift, slack) = (origin * rate, apart * rate.abs());
        let negative = step.is_negative_bitmask();
        let row = |k: usize, far: u32| k + 3 * ((negative >> k & 1) ^ far) as usize;
        Self {
            rate: rate.to_array(),
            stretched: (rate * STRETCH).to_array(),
            enter: (-shift - slack).to_array(),
            leave: ((slack - shift) * STRETCH).to_array(),
            near: [row(0, 0), row(1, 0), row(2, 0)],
            far: [row(0, 1), row(1, 1), row(2, 1)],
            place: origin.to_array(),
            apart: apart.to_array(),
            axes: shear.axes,
            origin: [shear.origin[0] as f32, shear.origin[1] as f32, shear.origin[2] as f32],
            slope: [-shear.slope[0] as f32, -shear.slope[1] as f32],
            backward: (shear.along as f32).to_bits() & SIGN,
            depth: shear.along.abs() as f32,
            blur: 32.0 * EPSILON * most,
            magnitude: most.max(magnitude) * STRETCH,
        }
    }
}

/// A distance in binary32, rounded up.
#[inline(always)]
pub(super) fn reach_of(t: f64) -> f32 {
    t as f32 * STRETCH + f32::MIN_POSITIVE
}

/// A distance in binary32, rounded down, with room for the rounding of what it is compared with.
#[inline(always)]
pub(super) fn short_of(t: f64) -> f32 {
    t as f32 * SHORTENED - f32::MIN_POSITIVE
}
