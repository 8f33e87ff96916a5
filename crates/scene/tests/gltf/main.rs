//! Small glTF files, right and wrong, and what becomes of them.

mod images;
mod lights;
mod pictures;
mod reading;
mod receivers;
mod refusals;
mod support;
mod textures;
