//! A rectangle that x looks through.

use glam::DVec3;

use crate::frame::Frame;

/// All points at p = w (u, v, 1), w at most the far end, with (u, v) in a rectangle: what a pyramid of four sides holds, x at
/// its apex. Also what can be said of a polygon's place in it: its rectangle, and the nearest and the farthest of its w.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    u: [f64; 2],
    v: [f64; 2],
    w: [f64; 2],
}

/// Least w, over the distance beside the axis, of a point whose u and v are taken for known.
const LEAST: f64 = 1e-6;
/// Least w, over the distance beside the axis, of a point of a window that is not too wide.
const NARROW: f64 = 0.3;
/// What rounding may add to u and v, relative to 1 + |u|.
const SLACK: f64 = 1e-9;

impl Window {
    /// Holds nothing.
    pub(crate) const NONE: Self =
        Self { u: [f64::INFINITY, f64::NEG_INFINITY], v: [f64::INFINITY, f64::NEG_INFINITY], w: [f64::INFINITY, 0.0] };
    const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    /// The window around points given in another frame, opening along the third axis; `None` where it would be too wide.
    pub(crate) fn around(axes: &Frame, points: &[DVec3]) -> Option<Self> {
        Self::by(axes, points, NARROW)
    }

    /// The window around a triangle, which may lie anywhere: unbounded where part of it lies beside or behind x.
    pub(crate) fn before(axes: &Frame, triangle: &[DVec3; 3]) -> Self {
        Self::by(axes, triangle, LEAST).unwrap_or(Self { u: Self::ALL, v: Self::ALL, w: [0.0, f64::INFINITY] })
    }

    fn by(axes: &Frame, points: &[DVec3], least: f64) -> Option<Self> {
        let mut window = Self::NONE;
        for &point in points {
            let p = axes.localize(point);
            if p.z <= least * (p.x.abs() + p.y.abs()) {
                return None;
            }
            let per_w = 1.0 / p.z;
            window.hold(p.x * per_w, p.y * per_w, p.z);
        }
        Some(window)
    }

    fn hold(&mut self, u: f64, v: f64, w: f64) {
        let (pad_u, pad_v) = (SLACK * (1.0 + u.abs()), SLACK * (1.0 + v.abs()));
        self.u = [self.u[0].min(u - pad_u), self.u[1].max(u + pad_u)];
        self.v = [self.v[0].min(v - pad_v), self.v[1].max(v + pad_v)];
        self.w = [self.w[0].min(w), self.w[1].max(w)];
    }

    /// The least window that holds both.
    pub(crate) fn union(&self, other: &Self) -> Self {
        let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self { u: both(self.u, other.u), v: both(self.v, other.v), w: both(self.w, other.w) }
    }

    /// The rectangle that both hold.
    pub(crate) fn shared(&self, other: &Self) -> Self {
        let both = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].min(b[1])];
        Self { u: both(self.u, other.u), v: both(self.v, other.v), w: both(self.w, other.w) }
    }

    /// The rectangle's area.
    pub(crate) fn size(&self) -> f64 {
        (self.u[1] - self.u[0]).max(0.0) * (self.v[1] - self.v[0]).max(0.0)
    }

    /// Whether the rectangles meet, and something of this lies before the other's far end.
    #[inline]
    pub(crate) fn meets(&self, other: &Self) -> bool {
        let meet = |a: [f64; 2], b: [f64; 2]| a[0] <= b[1] && b[0] <= a[1];
        meet(self.u, other.u) && meet(self.v, other.v) && self.w[0] <= other.w[1]
    }

    /// Outward normals of the four sides, in its own axes.
    pub(crate) fn sides(&self) -> [DVec3; 4] {
        let ([u0, u1], [v0, v1]) = (self.u, self.v);
        [DVec3::new(-1.0, 0.0, u0), DVec3::new(1.0, 0.0, -u1), DVec3::new(0.0, -1.0, v0), DVec3::new(0.0, 1.0, -v1)]
    }

    /// The farthest w.
    pub(crate) fn far(&self) -> f64 {
        self.w[1]
    }
}
