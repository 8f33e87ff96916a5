//! Directions uniform in projected solid angle over a convex polygon above the horizon.
//!
//! Projected straight down, onto the unit disk in x's horizon, projected solid angle is area, and the great circles of the edges
//! are ellipses around the origin (Peters 2021, "BRDF importance sampling for polygonal lights"). Between the azimuths of its
//! vertices the polygon is a sector: what lies between the arc of one edge, the outer, and that of another, the inner, or the
//! zenith. u picks the azimuth by the area swept up to it, v the squared radius.
//!
//! At t the azimuth is that of D(t) = D₀ + t (D₁ − D₀), where the edges stand at the heights z_o(t) and z_i(t), linear too:
//! E(t) = (D, z) points at the edge. From E(0) to E(t) the arc is θ with tan θ = t X/(g L), X = D₀ × D₁, L = E(0)·E(t), and g the
//! vertical part of the unit normal of its plane. Twice the area swept below it is g θ, so with a = tan θ_o, b = tan θ_i
//!
//! 2A(t) = g_o atan a − g_i atan b,
//!
//! a difference that loses all digits where the polygon is small or thin. With atan a = a − ρ(a) and g a = t X/L,
//!
//! 2A(t) = t X (L_i − L_o)/(L_o L_i) − (g_o − g_i) ρ(a) − g_i (s ab/(1 + ab) + ρ(s/(1 + ab))),   s = a − b,
//!
//! where every difference is linear in t and found in binary64 beforehand. Sectors are cut until no arc is longer than π/4, and until Newton's
//! steps begin near enough to end at rounding.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_4};

use glam::{DVec2, DVec3};
use twoforms_geometry::real::{Real, arctan_defect, at_least};
use twoforms_geometry::solid_angle::above_horizon;
use twoforms_geometry::vector::Vector;

/// Numbers that a draw needs.
pub(crate) const ROW: usize = 28;
/// Newton's steps.
const STEPS: usize = 3;
/// How far the mean of A′ at both ends may be from the mean of A′, relative to that.
const UNEVEN: f64 = 0.1;
/// How often a sector is cut because it is uneven.
const MOST_CUTS: u32 = 8;
/// Vertical part of a plane's normal below which it is taken to hold the zenith.
const UPRIGHT: f64 = 1e-9;
/// Least cos²θ_x that is drawn, so that what is drawn at the horizon is not lost to rounding.
const LEAST_COS2: f32 = 1e-14;

/// What lies between two azimuths, below an edge's arc and above another's or none's.
#[derive(Clone, Copy, Debug)]
pub struct Sector {
    /// D₀ and D₁.
    d: [DVec2; 2],
    outer: Edge,
    inner: Option<Edge>,
}

/// The plane of an edge and x.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// z/D: the plane's height over a horizontal vector.
    slope: DVec2,
    /// |vertical part of the unit normal|.
    g: f64,
}

/// An edge from one azimuth to another, in turns of the way around that the outer edges go.
struct Arc {
    edge: Edge,
    from: f64,
    span: f64,
}

/// The sectors that the part of a convex polygon above the horizon falls into. Corners in metres in the frame of x, in order
/// around.
pub fn sectors(corners: &[DVec3], mut f: impl FnMut(Sector)) {
    let corners = above_horizon(corners);
    let next = corners.iter().cycle().skip(1);
    let edges: Vec<(DVec3, DVec3, DVec3)> = corners.iter().zip(next).map(|(&v, &w)| (v, w, v.cross(w - v))).collect();
    let area: f64 = edges.iter().map(|&(v, w, normal)| arc(v, w) * normal.normalize_or_zero().z).sum();
    let around = 1.0_f64.copysign(area);
    let (mut outer, mut inner) = (Vec::new(), Vec::new());
    for (v, w, normal) in edges {
        let unit = normal.normalize_or_zero();
        if unit.z.abs() < UPRIGHT {
            continue;
        }
        let outside = unit.z * around > 0.0;
        let (v, w) = if outside { (v, w) } else { (w, v) };
        let (v, w) = (v.truncate(), w.truncate());
        let edge = Edge { slope: unit.truncate() / -unit.z, g: unit.z.abs() };
        let arc =
            Arc { edge, from: libm::atan2(v.y, v.x) * around, span: libm::atan2(v.perp_dot(w) * around, v.dot(w)) };
        if outside { outer.push(arc) } else { inner.push(arc) }
    }
    for arc in &outer {
        arc.each_sector(around, &inner, &mut f);
    }
}

fn arc(v: DVec3, w: DVec3) -> f64 {
    libm::atan2(v.cross(w - v).length(), v.dot(w))
}

impl Arc {
    /// The sectors below this outer arc, parted where inner arcs begin and end.
    fn each_sector(&self, around: f64, inner: &[Self], f: &mut dyn FnMut(Sector)) {
        let relative = |arc: &Self| {
            let begin = libm::remainder(arc.from - self.from, std::f64::consts::TAU);
            (begin.max(0.0), (begin + arc.span).min(self.span), Some(arc.edge))
        };
        let mut parts: Vec<_> = inner.iter().map(relative).filter(|(begin, end, _)| begin < end).collect();
        parts.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut reached = 0.0;
        let at = |angle: f64| DVec2::from_angle((self.from + angle) * around);
        for (begin, end, edge) in parts.into_iter().chain([(self.span, self.span, None)]) {
            for (from, to, inner) in [(reached, begin, None), (begin, end, edge)] {
                if to - from > 1e-14 {
                    Sector { d: [at(from), at(to)], outer: self.edge, inner }.cut(0, f);
                }
            }
            reached = end;
        }
    }
}

impl Edge {
    /// E over an azimuth.
    fn over(&self, d: DVec2) -> DVec3 {
        d.extend(self.slope.dot(d))
    }

    /// The arc between two azimuths.
    fn arc(&self, d: [DVec2; 2]) -> f64 {
        arc(self.over(d[0]), self.over(d[1]))
    }

    /// The azimuth halfway along the arc.
    fn middle(&self, d: [DVec2; 2]) -> DVec2 {
        (self.over(d[0]).normalize() + self.over(d[1]).normalize()).truncate().normalize()
    }
}

impl Sector {
    /// Cuts the sector until its arcs are short, and the area swept grows nearly evenly faster or slower with t.
    fn cut(self, cuts: u32, f: &mut dyn FnMut(Self)) {
        let level = Edge { slope: DVec2::ZERO, g: 1.0 };
        let sides = [Some((level, FRAC_PI_3)), Some((self.outer, FRAC_PI_4)), self.inner.map(|edge| (edge, FRAC_PI_4))];
        let excess = |&(edge, most): &(Edge, f64)| edge.arc(self.d) / most;
        let longest = sides.into_iter().flatten().max_by(|one, other| excess(one).total_cmp(&excess(other)));
        let long = longest.filter(|side| excess(side) > 1.0).map(|(edge, _)| edge);
        match long.or_else(|| (cuts < MOST_CUTS && self.is_uneven()).then_some(self.outer)) {
            Some(edge) => {
                let middle = edge.middle(self.d);
                Self { d: [self.d[0], middle], ..self }.cut(cuts + 1, f);
                Self { d: [middle, self.d[1]], ..self }.cut(cuts + 1, f);
            }
            None if self.projected_solid_angle() > 0.0 => f(self),
            None => (),
        }
    }

    /// Whether the first guess of the azimuth, that A′ is linear, is far off.
    fn is_uneven(&self) -> bool {
        let ([begin, end], whole) = (self.growth(), 2.0 * self.projected_solid_angle());
        (0.5 * (begin + end) - whole).abs() > UNEVEN * whole
    }

    /// Its projected solid angle in steradian.
    pub fn projected_solid_angle(&self) -> f64 {
        let lines = Lines::new(self);
        let defect = |x: f64| if x.abs() < 0.03 { x.powi(3) * series(x * x) } else { x - libm::atan(x) };
        let [x, g_o, g_i] = [lines.x, self.outer.g, lines.g_i];
        let [l_o, l_i, d, s] = [lines.l_o, lines.l_i, lines.d, lines.s].map(|[at_0, slope]| at_0 + slope);
        let (a, b) = (x / (g_o * l_o), if g_i > 0.0 { x / (g_i * l_i) } else { 0.0 });
        let (s, ab) = (s / (l_o * l_i), a * b);
        0.5 * (x * d / (l_o * l_i) - (g_o - g_i) * defect(a) - g_i * (s * ab / (1.0 + ab) + defect(s / (1.0 + ab))))
    }

    /// 2 dA/dt at the beginning and at the end.
    fn growth(&self) -> [f64; 2] {
        let x = self.d[0].perp_dot(self.d[1]).abs();
        [0, 1].map(|k| {
            let [e_o, e_i] = [Some(self.outer), self.inner].map(|edge| edge.map(|edge| edge.over(self.d[k])));
            let (e_o, outer) = (e_o.unwrap_or_default(), e_o.map_or(0.0, |e| 1.0 / e.length_squared()));
            let part = |e_i: DVec3| (e_i.z - e_o.z) * (e_i.z + e_o.z) / e_i.length_squared();
            (x * outer * e_i.map_or(1.0, part)).max(0.0)
        })
    }

    pub(crate) fn row(&self) -> [f32; ROW] {
        let lines = Lines::new(self);
        let [d_0, d_1] = self.d;
        let across = d_1 - d_0;
        let z_o = self.outer.over(d_0).z;
        let z_i = self.inner.map_or(0.0, |edge| edge.over(d_0).z);
        let [dz_o, dz_i] = [self.outer.slope.dot(across), self.inner.map_or(0.0, |edge| edge.slope.dot(across))];
        let wedge = self.inner.map_or(DVec2::ZERO, |edge| edge.slope - self.outer.slope);
        let [begin, end] = self.growth();
        let [begin, end] = if begin + end > 0.0 { [begin, end] } else { [1.0, 1.0] };
        let per = |x: f64, g: f64| if g > 0.0 { x / g } else { 0.0 };
        let row: [f64; ROW] = [
            d_0.x,
            d_0.y,
            across.x,
            across.y,
            z_o,
            dz_o,
            z_i,
            dz_i,
            wedge.dot(d_0),
            wedge.dot(across),
            lines.x,
            lines.l_o[0],
            lines.l_o[1],
            lines.l_i[0],
            lines.l_i[1],
            lines.d[0],
            lines.d[1],
            lines.s[0],
            lines.s[1],
            per(lines.x, self.outer.g),
            per(lines.x, lines.g_i),
            lines.g_i,
            self.outer.g - lines.g_i,
            2.0 * self.projected_solid_angle(),
            begin,
            end,
            if self.inner.is_some() { 1.0 } else { 0.0 },
            1.0,
        ];
        row.map(|number| number as f32)
    }

    /// The direction that two uniform numbers pick, in the frame of x.
    pub fn direction(&self, uv: [f32; 2]) -> [f32; 3] {
        direction(&self.row(), uv).to_array()
    }
}

/// (x − atan x)/x³ for small x, from x².
fn series(x2: f64) -> f64 {
    1.0 / 3.0 - x2 * (1.0 / 5.0 - x2 * (1.0 / 7.0 - x2 * (1.0 / 9.0 - x2 * (1.0 / 11.0 - x2 / 13.0))))
}

/// What is linear in t: [at 0, slope].
struct Lines {
    x: f64,
    g_i: f64,
    l_o: [f64; 2],
    l_i: [f64; 2],
    /// L_i − L_o.
    d: [f64; 2],
    /// s L_o L_i/t = X (L_i/g_o − L_o/g_i).
    s: [f64; 2],
}

impl Lines {
    fn new(sector: &Sector) -> Self {
        let [d_0, d_1] = sector.d;
        let x = d_0.perp_dot(d_1).abs();
        let line = |at_0: f64, at_1: f64| [at_0, at_1 - at_0];
        let of = |edge: &Edge| {
            let [e_0, e_1] = [edge.over(d_0), edge.over(d_1)];
            line(e_0.length_squared(), e_0.dot(e_1))
        };
        let (outer, l_o) = (&sector.outer, of(&sector.outer));
        let Some(inner) = &sector.inner else {
            return Self { x, g_i: 0.0, l_o, l_i: [1.0, 0.0], d: [1.0, 0.0], s: [0.0; 2] };
        };
        let wedge = inner.slope - outer.slope;
        let difference = |d: DVec2| {
            // z_i0 z_i − z_o0 z_o
            wedge.dot(d_0) * inner.slope.dot(d) + outer.slope.dot(d_0) * wedge.dot(d)
        };
        let l_i = of(inner);
        let s = [0, 1].map(|k| x * (l_i[k] / outer.g - l_o[k] / inner.g));
        Self { x, g_i: inner.g, l_o, l_i, d: line(difference(d_0), difference(d_1)), s }
    }
}

/// Ψ in the frame of x.
#[inline(always)]
pub(crate) fn direction<R: Real>(row: &[R; ROW], [u, v]: [R; 2]) -> Vector<R> {
    let [d_x, d_y, e_x, e_y, z_o, dz_o, z_i, dz_i, w, dw, ..] = *row;
    let t = azimuth(row, u);
    let (x, y) = (d_x + e_x * t, d_y + e_y * t);
    let n = x * x + y * y;
    let gap = Gap::at(row, [z_o + dz_o * t, z_i + dz_i * t, w + dw * t], n);
    // cos²θ_x of the outer edge, and what v leaves of the way to the inner; the squared radius likewise from the inner.
    let rise = n * gap.per_outer * gap.share;
    let cos2 = at_least(gap.z2_o * gap.per_outer + (R::one() - v) * rise, R::splat(LEAST_COS2));
    let radius2_over_n = gap.per_inner + v * gap.per_outer * gap.share;
    let radius = radius2_over_n.sqrt();
    Vector::new(x * radius, y * radius, cos2.sqrt())
}

/// What lies between the edges at one azimuth.
struct Gap<R> {
    z2_o: R,
    /// 1/|E_o|², and 1/|E_i|² or zero.
    per_outer: R,
    per_inner: R,
    /// 1 − |E_o|²/|E_i|².
    share: R,
}

impl<R: Real> Gap<R> {
    #[inline(always)]
    fn at(row: &[R; ROW], [z_o, z_i, w]: [R; 3], n: R) -> Self {
        let has_inner = R::zero().lt(row[26]);
        let per_outer = R::one() / (n + z_o * z_o);
        let per_inner = R::one() / (n + z_i * z_i);
        let share = at_least(w * (z_i + z_o) * per_inner, R::zero());
        Self {
            z2_o: z_o * z_o,
            per_outer,
            per_inner: R::select(has_inner, per_inner, R::zero()),
            share: R::select(has_inner, share, R::one()),
        }
    }
}

/// t with A(t) = u A(1): from the guess that A′ is linear, by Newton's steps.
#[inline(always)]
fn azimuth<R: Real>(row: &[R; ROW], u: R) -> R {
    let [
        d_x,
        d_y,
        e_x,
        e_y,
        z_o,
        dz_o,
        z_i,
        dz_i,
        w,
        dw,
        cross,
        l_o,
        dl_o,
        l_i,
        dl_i,
        d,
        dd,
        s,
        ds,
        a,
        b,
        g_i,
        dg,
        whole,
        begin,
        end,
        _,
        _,
    ] = *row;
    let (zero, one) = (R::zero(), R::one());
    let wanted = u * whole;
    let mut t = u * (begin + end) / (begin + (begin * begin + u * (end - begin) * (end + begin)).sqrt());
    let flat = whole * R::splat(1e-3);
    for _ in 0..STEPS {
        let (x, y) = (d_x + e_x * t, d_y + e_y * t);
        let n = x * x + y * y;
        let gap = Gap::at(row, [z_o + dz_o * t, z_i + dz_i * t, w + dw * t], n);
        let growth = cross * gap.per_outer * gap.share;
        let (per_l_o, per_l_i) = (one / (l_o + dl_o * t), one / (l_i + dl_i * t));
        let both = t * per_l_o * per_l_i;
        let (a, b) = (t * a * per_l_o, t * b * per_l_i);
        let (s, ab) = ((s + ds * t) * both, a * b);
        let per = one / (one + ab);
        let swept = cross * (d + dd * t) * both - dg * arctan_defect(a) - g_i * (s * ab * per + arctan_defect(s * per));
        t = t - (swept - wanted) / at_least(growth, flat);
        t = at_least(t, zero);
        t = R::select(t.lt(one), t, one);
    }
    t
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::DVec3;
    use rand_philox::splitmix64;
    use twoforms_geometry::solid_angle::projected_solid_angle;

    use super::{Sector, sectors};

    struct Random(u64);

    impl Random {
        fn uniform(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
            ((splitmix64(self.0) >> 12) as f64 + 0.5) / 4_503_599_627_370_496.0
        }

        /// A triangle of any size around any direction: before x, across its horizon, or overhead.
        fn triangle(&mut self) -> [DVec3; 3] {
            let size = 10.0_f64.powf(4.0 * self.uniform() - 3.0);
            let (z, (sin, cos)) = (self.uniform(), (TAU * self.uniform()).sin_cos());
            let toward = DVec3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z);
            [0; 3].map(|_| toward + size * (DVec3::new(self.uniform(), self.uniform(), self.uniform()) - 0.5))
        }
    }

    /// (u, v) of a direction, found from areas in binary64, and how much of the squared radius v runs over.
    fn undone(sector: &Sector, psi: [f32; 3]) -> [f64; 3] {
        let psi = DVec3::from(psi.map(f64::from)).normalize();
        let to = Sector { d: [sector.d[0], psi.truncate().normalize()], ..*sector };
        let square = |edge: Option<super::Edge>| edge.map_or(0.0, |edge| 1.0 / edge.over(to.d[1]).length_squared());
        let (outer, inner) = (square(Some(sector.outer)), square(sector.inner));
        let u = to.projected_solid_angle() / sector.projected_solid_angle();
        [u, (psi.truncate().length_squared() - inner) / (outer - inner), outer - inner]
    }

    /// Sectors add up to the polygon, and what is drawn at (u, v) comes back as (u, v).
    #[test]
    fn draws_are_uniform_over_polygons_of_any_size() {
        let mut random = Random(3);
        let mut worst = [0.0_f64; 2];
        for _ in 0..20_000 {
            let corners = random.triangle();
            let whole = projected_solid_angle(&corners);
            let mut sum = 0.0;
            sectors(&corners, |sector| {
                let part = sector.projected_solid_angle();
                sum += part;
                let uv = [random.uniform() as f32, random.uniform() as f32];
                let psi = sector.direction(uv);
                assert!(psi.iter().all(|c| c.is_finite()) && psi[2] > 0.0, "{psi:?} at {uv:?} of {corners:?}");
                let [u, v, thick] = undone(&sector, psi);
                let off = [(u - f64::from(uv[0])).abs(), (v - f64::from(uv[1])).abs()];
                // What is misplaced of the polygon, beside what rounding the direction to binary32 moves it by.
                let rounding = [1e-6 / part.sqrt(), 5e-7 / thick];
                let misplaced = [0, 1].map(|k| (off[k] - rounding[k]).max(0.0) * (part / whole) - 2e-7 / whole.sqrt());
                worst = [worst[0].max(misplaced[0]), worst[1].max(misplaced[1])];
            });
            assert!((sum - whole).abs() <= 1e-9 * whole + 1e-14, "{sum} of {whole}: {corners:?}");
        }
        assert!(worst[0] < 1e-4 && worst[1] < 1e-4, "{worst:?}");
    }
}
