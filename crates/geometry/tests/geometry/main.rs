//! The geometry put under attack: leaks, self-intersection, the blocking rule, the view against rays, points on targets.

mod blocking;
mod degenerate;
mod directions;
mod draws;
mod facets;
mod hierarchy;
mod leaks;
mod meshes;
mod oracle;
mod placement;
mod prospects;
mod surfaces;
mod views;
