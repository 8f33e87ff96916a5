//! Why a scene cannot be used.

use std::path::{Path, PathBuf};

use thiserror::Error;

/// A scene file that cannot be used: which file, what is wrong where in it, and what to do about it.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct SceneError {
    /// The scene file.
    pub path: PathBuf,
    /// What is wrong.
    pub problem: Problem,
}

impl SceneError {
    /// Says that `problem` is about the file at `path`.
    pub fn at(path: &Path, problem: Problem) -> Self {
        Self { path: path.to_owned(), problem }
    }
}

/// What is wrong with a scene file, each with its remedy.
#[derive(Debug, Error)]
pub enum Problem {
    /// A file that cannot be read: the scene itself, or a buffer or image that it names.
    #[error("cannot read {what}: {reason}; check the name and the permissions")]
    Unreadable {
        /// "the file", or the buffer or image and the file that it names.
        what: String,
        /// The system's answer.
        reason: String,
    },
    /// The file is something else than glTF 2.0, or a part of one.
    #[error("not glTF 2.0: {0}; export the scene as .gltf or .glb, version 2.0")]
    NotGltf(String),
    /// The file breaks the rules of glTF.
    #[error("{place} {fault}; repair it or export the scene again (the glTF validator may tell more)")]
    Malformed {
        /// A node's or material's name, or a JSON path such as `accessors[3]`.
        place: String,
        /// What is wrong there, a clause whose subject is the place.
        fault: String,
    },
    /// The file is right but asks for something that is not read.
    #[error("{what}; {remedy}")]
    Unsupported {
        /// What is asked for, and where.
        what: String,
        /// How to get a file that can be read.
        remedy: String,
    },
    /// More vertices or triangles than are held.
    #[error("{place} takes the scene beyond {limit} vertices or triangles; export a smaller part of it")]
    TooLarge {
        /// Where the limit is passed.
        place: String,
        /// The largest number of vertices, and of triangles.
        limit: usize,
    },
    /// A light whose texture cannot be used, and why.
    #[error("material {material:?} emits by a texture that cannot be used: {problem}")]
    Emission {
        /// The material's name.
        material: String,
        /// What is wrong with the texture.
        problem: Box<Problem>,
    },
    /// There is no light. The text says what stands in its place, if anything.
    #[error("no triangle emits light{0}; give a mesh, such as a plane, a material with emissiveFactor above zero")]
    NoEmitter(String),
}

/// A breach of glTF's rules at `place`.
pub(crate) fn malformed(place: impl Into<String>, fault: impl Into<String>) -> Problem {
    Problem::Malformed { place: place.into(), fault: fault.into() }
}
