//! What x sees of a facet, as convex polygons on its plane.

use glam::DVec3;

use crate::clip::Halves;
use crate::cone::{Cone, Relation, sides};
use crate::facet::Facet;

/// Cuts tried before giving up.
pub const LIMIT: usize = 400_000;

/// Convex polygons on one facet's plane, in one allocation.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    vertices: Vec<DVec3>,
    ends: Vec<usize>,
}

impl Pieces {
    /// One polygon; none when it has no vertices.
    pub fn one(polygon: &[DVec3]) -> Self {
        let mut pieces = Self::default();
        pieces.push(polygon);
        pieces
    }

    pub(crate) fn push(&mut self, polygon: &[DVec3]) {
        if polygon.len() > 2 {
            self.vertices.extend_from_slice(polygon);
            self.ends.push(self.vertices.len());
        }
    }

    /// The polygons, each with its vertices around m.
    pub fn iter(&self) -> impl Iterator<Item = &[DVec3]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.vertices[start..end])
    }

    /// How many polygons.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether nothing is left.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }
}

/// What x sees of a facet.
#[derive(Clone, Debug)]
pub struct Visible {
    /// The part above the horizon that nothing hides.
    pub pieces: Pieces,
    /// Whether a blocker hides some of the part above the horizon.
    pub blocked: bool,
    /// How much rounding of vertices has grown at crossings of small angle (>= 1).
    pub amplification: f64,
}

/// The part of a facet above the receiver's horizon (z > 0), and whether some of it lies below.
pub fn above_horizon(facet: &Facet) -> (Vec<DVec3>, bool) {
    let mut halves = Halves::default();
    halves.cut(&facet.corners, DVec3::Z, facet.tolerance());
    let clipped = !halves.back.is_empty();
    (halves.front, clipped)
}

/// Takes the cones of all blockers from `open`, the facet's part above the horizon. `None` beyond
/// [`LIMIT`] cuts.
pub fn subtract(facet: &Facet, open: &[DVec3], blockers: &[[DVec3; 3]]) -> Option<Visible> {
    let unblocked = || Visible { pieces: Pieces::one(open), blocked: false, amplification: 1.0 };
    if open.is_empty() || blockers.is_empty() {
        return Some(unblocked());
    }
    let sides = sides(open);
    let mut cones: Vec<Cone> = blockers.iter().filter_map(|b| Cone::new(b, facet, &sides)).collect();
    if cones.is_empty() {
        return Some(unblocked());
    }
    cones.sort_by(|a, b| b.size.total_cmp(&a.size));
    let mut subtraction = Subtraction::new(&cones, facet.tolerance());
    subtraction.begin(open);
    subtraction.run()
}

/// A polygon still to be looked at, and the blockers that met the polygon it was cut from: ranges
/// of the two stacks.
#[derive(Clone, Copy)]
struct Job {
    vertices: (usize, usize),
    cones: (usize, usize),
}

/// The difference of convex polygons and convex cones, depth first, so that each part is tested
/// only against the blockers that met its parent. Expected to grow as n log n for n scattered
/// blockers, as binary space partitions do.
struct Subtraction<'a> {
    all: &'a [Cone],
    tolerance: f64,
    vertices: Vec<DVec3>,
    cones: Vec<usize>,
    jobs: Vec<Job>,
    halves: Halves,
    inside: Vec<DVec3>,
    visible: Visible,
}

impl<'a> Subtraction<'a> {
    fn new(all: &'a [Cone], tolerance: f64) -> Self {
        let visible = Visible { pieces: Pieces::default(), blocked: false, amplification: 1.0 };
        Self {
            all,
            tolerance,
            vertices: Vec::new(),
            cones: Vec::new(),
            jobs: Vec::new(),
            halves: Halves::default(),
            inside: Vec::new(),
            visible,
        }
    }

    fn begin(&mut self, open: &[DVec3]) {
        self.vertices.extend_from_slice(open);
        self.cones.extend(0..self.all.len());
        self.jobs.push(Job { vertices: (0, open.len()), cones: (0, self.all.len()) });
    }

    fn run(mut self) -> Option<Visible> {
        let mut cuts = 0;
        while let Some(job) = self.jobs.pop() {
            self.vertices.truncate(job.vertices.1);
            self.cones.truncate(job.cones.1);
            self.look(job);
            cuts += 1;
            if cuts > LIMIT {
                return None;
            }
        }
        Some(self.visible)
    }

    /// Emits the polygon, drops it, or cuts it by the largest blocker that meets it.
    fn look(&mut self, job: Job) {
        let Some(meeting) = self.meeting(job) else {
            self.visible.blocked = true;
            return;
        };
        for first in meeting.0..meeting.1 {
            let rest = (first + 1, meeting.1);
            if self.cut(job.vertices, self.cones[first], rest) {
                self.visible.blocked = true;
                return;
            }
        }
        self.visible.pieces.push(&self.vertices[job.vertices.0..job.vertices.1]);
    }

    /// The blockers that meet the polygon, pushed as a new list; `None` when one covers it.
    fn meeting(&mut self, job: Job) -> Option<(usize, usize)> {
        let begin = self.cones.len();
        for k in job.cones.0..job.cones.1 {
            let cone = self.cones[k];
            let polygon = &self.vertices[job.vertices.0..job.vertices.1];
            match self.all[cone].relation(polygon, self.tolerance) {
                Relation::Apart => {}
                Relation::Covered => return None,
                Relation::Meeting => self.cones.push(cone),
            }
        }
        Some((begin, self.cones.len()))
    }

    /// Pushes the parts outside the cone as jobs. When nothing is inside, takes them back and
    /// returns false.
    fn cut(&mut self, polygon: (usize, usize), cone: usize, rest: (usize, usize)) -> bool {
        let (vertices, jobs) = (self.vertices.len(), self.jobs.len());
        let all = self.all;
        self.inside.clear();
        self.inside.extend_from_slice(&self.vertices[polygon.0..polygon.1]);
        for &plane in all[cone].planes() {
            self.halves.cut(&self.inside, plane, self.tolerance);
            if self.halves.back.len() > 2 {
                let begin = self.vertices.len();
                self.vertices.extend_from_slice(&self.halves.back);
                self.jobs.push(Job { vertices: (begin, self.vertices.len()), cones: rest });
            }
            std::mem::swap(&mut self.inside, &mut self.halves.front);
            if self.inside.len() < 3 {
                self.vertices.truncate(vertices);
                self.jobs.truncate(jobs);
                return false;
            }
        }
        self.visible.amplification = self.visible.amplification.max(all[cone].amplification);
        true
    }
}
