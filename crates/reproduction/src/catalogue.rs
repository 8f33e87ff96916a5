//! The reproductions and the scenes that come with the program.

macro_rules! files {
    ($folder:literal: $($name:literal),* $(,)?) => {
        &[$(($name, include_bytes!(concat!("../../../", $folder, "/", $name)).as_slice())),*]
    };
}

/// Reproductions, in the order in which they are listed.
const REPRODUCTIONS: &[(&str, &[u8])] = files!(
    "docs/reproductions":
    "lecture.toml",
    "nori.toml",
    "disk-crossings.toml",
    "square-crossings.toml",
    "rates.toml",
    "projected-solid-angle.toml",
    "near-lights.toml",
    "selection.toml",
    "furnace.toml",
);

const SCENES: &[(&str, &[u8])] = files!(
    "scenes":
    "cornell-box.gltf",
    "cornell-box-empty.gltf",
    "furnace.gltf",
    "lamp-and-ceiling.gltf",
    "nori-light-1.gltf",
    "nori-light-2.gltf",
    "nori-light-3.gltf",
    "nori-light-4.gltf",
    "nori-light-5.gltf",
    "square-light.gltf",
    "tiny-far-light.gltf",
    "two-lights.gltf",
    "four-colours.gltf",
);

/// The text of each reproduction, by name.
pub fn reproductions() -> impl Iterator<Item = (&'static str, &'static str)> + Clone {
    REPRODUCTIONS.iter().map(|(name, bytes)| {
        let text = std::str::from_utf8(bytes).unwrap_or_default();
        (name.trim_end_matches(".toml"), text)
    })
}

/// The scenes, by file name.
pub fn scenes() -> impl Iterator<Item = (&'static str, &'static [u8])> + Clone {
    SCENES.iter().copied()
}

/// The scene of a file name.
pub fn scene(name: &str) -> Option<&'static [u8]> {
    scenes().find(|(known, _)| *known == name).map(|(_, bytes)| bytes)
}
