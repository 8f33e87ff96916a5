//! Lights that stand elsewhere than the scene has them, moved and scaled in binary64.
//!
//! Corners and blockers of moved lights are never rounded to binary32, so that every value is as smooth a function of the
//! motion as the light itself. Only the question whether a triangle blocks at all, which jumps anyway, is asked of the
//! rounded vertices: the answer is that of a scene saved with its lights where they have moved.

use std::iter::once;
use std::ops::{ControlFlow, Range};

use glam::DVec3;
use twoforms_geometry::blocking;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::{Mesh, Triangle};
use twoforms_geometry::target::Target;
use twoforms_geometry::tracer::Region;
use twoforms_geometry::view::{Prospect, Standing};

/// Triangles that move as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// A run of the mesh's triangles.
    pub triangles: Range<u32>,
    /// Where they go: y becomes scale × y + offset (world, metres), the scale being that of the [`Motion`].
    pub offset: DVec3,
}

/// Where the lights stand: one scale for all, an offset for each. What belongs to no body stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    scale: f64,
    bodies: Vec<Body>,
    /// The offsets there are, each once; that of what stays first.
    offsets: Vec<Option<DVec3>>,
}

/// y becomes scale × y + offset.
#[derive(Clone, Copy)]
struct Similarity {
    scale: f64,
    offset: DVec3,
}

impl Motion {
    /// The motion of `bodies`, which must hold every target of the scene; `scale` > 0.
    pub fn new(scale: f64, mut bodies: Vec<Body>) -> Self {
        bodies.sort_by_key(|body| body.triangles.start);
        let mut offsets: Vec<Option<DVec3>> = once(None).chain(bodies.iter().map(|body| Some(body.offset))).collect();
        offsets.sort_by_key(|offset| offset.map(|by| by.to_array().map(f64::to_bits)));
        offsets.dedup();
        Self { scale, bodies, offsets }
    }

    /// By how much areas, and so powers, grow.
    pub fn growth(&self) -> f64 {
        self.scale * self.scale
    }

    /// One target as the receiver at the origin of `frame` meets it after the motion, and all that can stand between.
    pub fn prospect(&self, geometry: &Geometry, frame: &Frame, target: u32) -> Prospect {
        Moved { motion: self, geometry, frame, target }.prospect()
    }

    /// The offset of the body that holds a triangle.
    fn offset(&self, triangle: u32) -> Option<DVec3> {
        let after = self.bodies.partition_point(|body| body.triangles.start <= triangle);
        let body = after.checked_sub(1).map(|k| &self.bodies[k])?;
        body.triangles.contains(&triangle).then_some(body.offset)
    }

    /// Where triangles of this offset go.
    fn similarity(&self, offset: Option<DVec3>) -> Similarity {
        match offset {
            Some(offset) => Similarity { scale: self.scale, offset },
            None => Similarity { scale: 1.0, offset: DVec3::ZERO },
        }
    }

    /// A triangle after the motion, rounded to binary32 as a scene would hold it.
    fn rounded(&self, mesh: &Mesh, triangle: u32) -> Triangle {
        let by = self.similarity(self.offset(triangle));
        let [a, b, c] = mesh.triangle(triangle).vertices().map(|v| by.at(v).as_vec3());
        Triangle { a, b, c }
    }
}

impl Similarity {
    fn at(&self, y: DVec3) -> DVec3 {
        self.scale * y + self.offset
    }

    /// The points that go into the region: n·(scale p + offset − origin) <= d.
    fn before(&self, region: &Region) -> Region {
        Region {
            origin: (region.origin - self.offset) / self.scale,
            half_spaces: region.half_spaces.iter().map(|&(n, d)| (n, d / self.scale)).collect(),
        }
    }
}

/// One moved target from one receiver.
struct Moved<'a> {
    motion: &'a Motion,
    geometry: &'a Geometry,
    frame: &'a Frame,
    target: u32,
}

impl Moved<'_> {
    fn target(&self) -> &Target {
        &self.geometry.targets()[self.target as usize]
    }

    fn offset(&self) -> Option<DVec3> {
        self.motion.offset(self.target().first())
    }

    fn rounded(&self, triangle: u32) -> Triangle {
        self.motion.rounded(self.geometry.mesh(), triangle)
    }

    /// Corners that are not finite count as lit, for a sight refuses them.
    fn prospect(&self) -> Prospect {
        let (target, corners) = (self.target, self.corners());
        if !corners.iter().all(|corner| corner.is_finite()) {
            return Prospect {
                target,
                standing: Standing::Lit,
                corners,
                blockers: Vec::new(),
                complete: true,
                veils: Vec::new(),
            };
        }
        let plane = self.rounded(self.target().first());
        Prospect::moved(self.frame, target, &corners, self.target().sides, &plane, |pyramid| self.blockers(pyramid))
    }

    /// In the frame of x, counter-clockwise seen from the front.
    fn corners(&self) -> Vec<DVec3> {
        let by = self.motion.similarity(self.offset());
        let corners = self.target().corners(self.geometry.mesh());
        corners.as_slice().iter().map(|corner| self.frame.localize(by.at(corner.as_dvec3()))).collect()
    }

    /// The triangles whose boxes touch the pyramid over the target and that may block it: one query of the hierarchy for
    /// each offset, where the triangles are at rest and the pyramid is moved back.
    fn blockers(&self, pyramid: &Region) -> Vec<[DVec3; 3]> {
        let mut blockers = Vec::new();
        for &offset in &self.motion.offsets {
            let by = self.motion.similarity(offset);
            self.geometry.within(&by.before(pyramid), |triangle| {
                if self.motion.offset(triangle) == offset && self.may_block(triangle, offset) {
                    let vertices = self.geometry.mesh().triangle(triangle).vertices();
                    blockers.push(vertices.map(|v| self.frame.localize(by.at(v))));
                }
                ControlFlow::Continue(())
            });
        }
        blockers
    }

    /// Whether a triangle is neither part of the target nor coplanar with it, nor edge-on to x. What moves alike stays
    /// coplanar.
    fn may_block(&self, triangle: u32, offset: Option<DVec3>) -> bool {
        let spared = if offset == self.offset() {
            !self.geometry.may_block(triangle, self.target)
        } else {
            self.target().triangles().any(|own| blocking::coplanar(&self.rounded(own), &self.rounded(triangle)))
        };
        !spared && !blocking::plane_holds(&self.rounded(triangle), self.frame.x())
    }
}
