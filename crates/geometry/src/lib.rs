//! Where things are. Skeleton.

pub mod blocking;
pub mod mesh;
pub mod target;
