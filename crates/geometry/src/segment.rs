//! A point of a light as x meets it, and the segment that joins the two.
//!
//! All of it is said in the frame of x: x is the origin and N_x the third axis, so that cosθ_x is a coordinate. See
//! [`Frame`](crate::frame::Frame).

use crate::real::Real;
use crate::vector::{Direction, Vector};

/// A point y on a target.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<R: Real> {
    /// y − x in metres.
    pub position: Vector<R>,
    /// N_y·(x − y) in metres: how far x lies from the plane through y, on the side that emits. Negative where x is
    /// behind a one-sided target; the distance itself where both sides emit. Known to full precision from the set-up,
    /// unlike a dot product of rounded vectors.
    pub depth: R,
    /// The target that y lies on.
    pub target: R::Word,
}

impl<R: Real> SurfacePoint<R> {
    /// One point where the mask holds, else the other.
    #[inline(always)]
    pub fn select(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            position: Vector::new(
                R::select(mask, yes.position.x, no.position.x),
                R::select(mask, yes.position.y, no.position.y),
                R::select(mask, yes.position.z, no.position.z),
            ),
            depth: R::select(mask, yes.depth, no.depth),
            target: R::select_word(mask, yes.target, no.target),
        }
    }
}

/// The segment from x to y.
#[derive(Clone, Copy, Debug)]
pub struct Segment<R> {
    /// Ψ: the direction from x to y.
    pub psi: Direction<R>,
    /// r_xy in metres.
    pub r: R,
    /// 1/r_xy, per metre.
    pub per_r: R,
    /// cosθ_x = N_x·Ψ.
    pub cos_x: R,
    /// cosθ_y = N_y·(−Ψ).
    pub cos_y: R,
}

impl<R: Real> Segment<R> {
    /// The segment from x, the origin, to y.
    #[inline(always)]
    pub fn to(y: &SurfacePoint<R>) -> Self {
        let r = y.position.length();
        let per_r = R::one() / r;
        let psi = Direction::of(y.position, per_r);
        Self { psi, r, per_r, cos_x: psi.cos_theta(), cos_y: y.depth * per_r }
    }

    /// dω/dA = cosθ_y / r²: the solid angle that x sees per area around y, in sr/m².
    #[inline(always)]
    pub fn d_omega_d_area(&self) -> R {
        self.cos_y * (self.per_r * self.per_r)
    }

    /// G without V: cosθ_x cosθ_y / r², in 1/m².
    #[inline(always)]
    pub fn g(&self) -> R {
        self.cos_x * self.d_omega_d_area()
    }

    /// Where x and y face each other: both cosines positive.
    #[inline(always)]
    pub fn facing(&self) -> R::Mask {
        R::zero().lt(self.cos_x) & R::zero().lt(self.cos_y)
    }
}
