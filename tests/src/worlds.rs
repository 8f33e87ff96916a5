//! The scenes of the repository, ready to be measured.

use std::fmt;
use std::path::{Path, PathBuf};

use twoforms_comparison::place::Place;
use twoforms_comparison::world::World;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::{Kind, Technique};
use twoforms_scene::{KnownAnswer, Scene};

/// A scene file of the repository, read and built.
pub struct Stage {
    /// The file's name without `.gltf`.
    pub name: String,
    /// The scene, its hierarchy and its lights.
    pub world: World,
}

/// A receiver whose answer is known.
#[derive(Clone)]
pub struct Case<'a> {
    /// The scene.
    pub stage: &'a Stage,
    /// The receiver.
    pub place: Place,
    /// Its answer.
    pub known: KnownAnswer,
}

/// Every scene in the repository's folder, in the order of their names.
pub fn all() -> Vec<Stage> {
    let entries = std::fs::read_dir(folder()).expect("the folder of scenes");
    let paths = entries.map(|entry| entry.expect("an entry of the folder").path());
    let mut scenes: Vec<PathBuf> = paths.filter(|path| path.extension().is_some_and(|end| end == "gltf")).collect();
    scenes.sort();
    scenes.iter().map(|path| Stage::load(path)).collect()
}

/// The scene of that name.
pub fn stage(name: &str) -> Stage {
    Stage::load(&folder().join(name).with_extension("gltf"))
}

/// Every receiver with a known answer in these scenes.
pub fn cases(stages: &[Stage]) -> Vec<Case<'_>> {
    stages.iter().flat_map(Stage::cases).collect()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

impl Stage {
    fn load(path: &Path) -> Self {
        let name = path.file_stem().expect("a file's name").to_string_lossy().into_owned();
        let scene = Scene::load(path).expect("a scene that can be read");
        Self { name, world: World::new(scene).expect("a scene with lights") }
    }

    /// Its receivers with a known answer.
    pub fn cases(&self) -> Vec<Case<'_>> {
        let case = |place: Place| place.known.clone().map(|known| Case { stage: self, place, known });
        self.world.scene.receivers.iter().map(Place::of_receiver).filter_map(case).collect()
    }

    /// The receiver of that name.
    pub fn case(&self, receiver: &str) -> Case<'_> {
        self.cases().into_iter().find(|case| case.place.name == receiver).expect("a receiver of that name")
    }
}

impl Case<'_> {
    /// The variance of one independent sample that the scene cites, RGB. Strategies of one density share it, but for the one whose
    /// samples count what lies behind the point drawn.
    pub fn variance(&self, strategy: Strategy) -> Option<[f64; 3]> {
        let cited = |name: String| self.known.variance.get(&name).copied();
        let marginal = |technique: Technique| technique.kind == Kind::HemisphereTowardLightsMarginal;
        let shares = !strategy.techniques().into_iter().any(marginal);
        cited(strategy.to_string()).or_else(|| cited(strategy.density_name()).filter(|_| shares))
    }
}

impl fmt::Display for Case<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.stage.name, self.place.name)
    }
}
