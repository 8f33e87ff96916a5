//! A tree over the targets, walked from the root to the target that a random word picks, at each node to the child that may give
//! more to x with more probability (Conty Estévez and Kulla 2018, "Importance sampling of many lights with adaptive tree
//! splitting"; nothing is split here).
//!
//! Words are whole numbers all the way: each node hands its words on to its children, at least one to every target below. How
//! many of the 2³² words pick a target is its probability, both where it is drawn and where it is asked for, so that rounding
//! cannot set the two apart; and a target that the bounds hold to be dark is still picked once in a while.

mod bounds;
mod build;
mod cone;
mod emitter;
mod row;
mod walk;

pub(crate) use emitter::Emitter;
pub use walk::Walk;

use std::fmt;

use glam::DVec3;

use build::Build;
use row::Row;

/// The tree over the targets of a scene.
#[derive(Clone)]
pub struct Tree {
    /// What rows are relative to, in world space: the middle of all targets.
    origin: DVec3,
    /// A row for each node that has two children: after it those below its left child, then those below its right.
    rows: Vec<Row>,
    /// Targets below the left child of each.
    left: Vec<u32>,
    /// Targets in the order of the leaves.
    order: Vec<u32>,
    /// Where each target stands in that order.
    place: Vec<u32>,
    /// 1/A of each target, in 1/m².
    per_area: Vec<f32>,
}

impl Tree {
    /// The tree over these targets, which have these areas in m². There must be at least one.
    pub(crate) fn new(emitters: &[Emitter], areas: &[f64]) -> Self {
        let origin = emitters.iter().map(Emitter::middle).sum::<DVec3>() / emitters.len() as f64;
        let mut order: Vec<u32> = (0..emitters.len() as u32).collect();
        let Build { rows, left, .. } = Build::new(emitters, origin, &mut order);
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, &target)| place[target as usize] = at as u32);
        let per_area = areas.iter().map(|area| (1.0 / area) as f32).collect();
        Self { origin, rows, left, order, place, per_area }
    }
}

impl fmt::Debug for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a tree over {} targets", self.order.len())
    }
}
