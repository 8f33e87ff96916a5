//! Where things are: directions, points and segments, triangle meshes, y = vp(x, Ψ), V(x, y), and the view from x.
//!
//! Nothing here knows what a surface is made of or how much it emits.

pub mod blocking;
pub mod clusters;
pub mod frame;
pub mod geometry;
mod hierarchy;
pub mod lanes;
pub mod masked;
pub mod mesh;
pub mod number;
pub mod ray;
pub mod real;
pub mod segment;
pub mod solid_angle;
pub mod target;
pub mod tracer;
pub mod vector;
pub mod veil;
pub mod view;
pub mod wide;
