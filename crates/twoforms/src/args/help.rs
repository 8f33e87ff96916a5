//! What stands below the options: examples, and in the long help the strategies.

use twoforms_estimator::strategy::Strategy;

pub(super) const ALL: &str = "\
Examples:
  twoforms inspect scenes/cornell-box.gltf
  twoforms compare scenes/cornell-box.gltf
  twoforms exact scenes/cornell-box.gltf
  twoforms render scenes/cornell-box.gltf -o cornell.exr";

pub(super) const COMPARE: &str = "\
Examples:
  twoforms compare scenes/cornell-box.gltf
  twoforms compare scenes/two-lights.gltf --strategies area/uniform,area/uniform@power --samples 16
  twoforms compare scenes/cornell-box.gltf --at 0.2,0,0.1,0,1,0 --format json
  twoforms compare room.glb --camera auto --grid 16,16 --out results
  twoforms compare experiment.toml -D replicates=10000";

pub(super) const EXACT: &str = "\
Examples:
  twoforms exact scenes/cornell-box.gltf
  twoforms exact scenes/square-light.gltf --receiver near --strategies area/uniform,hemisphere/cosine
  twoforms exact scenes/square-light.gltf --receiver near --sweep receiver.y=-3:0.09:30
  twoforms exact scenes/cornell-box.gltf --grid 32,32 --format csv -o grid.csv";

pub(super) const RENDER: &str = "\
Examples:
  twoforms render scenes/cornell-box.gltf -o cornell.exr
  twoforms render scenes/cornell-box.gltf --strategy hemisphere/cosine --spp 256 --width 256 --height 256
  twoforms render room.glb --view 3,2,5,0,1,0,40 --spp 16 --light-samples 16";

pub(super) const REPRODUCE: &str = "\
Examples:
  twoforms reproduce
  twoforms reproduce lecture
  twoforms reproduce lecture --quick --out results
  twoforms reproduce mine.toml -D replicates=100000";

pub(super) const INSPECT: &str = "\
Examples:
  twoforms inspect scenes/cornell-box.gltf
  twoforms inspect room.glb --format json";

pub(super) const COMPLETIONS: &str = "\
Examples:
  twoforms completions bash > ~/.local/share/bash-completion/completions/twoforms
  twoforms completions zsh > ~/.zfunc/_twoforms";

/// How strategies are named, and all names, before `examples`.
pub(super) fn with_strategies(examples: &str) -> String {
    let names = Strategy::all().into_iter().map(|strategy| format!("  {strategy}\n"));
    format!("{NAMING}{}\n{examples}", names.collect::<String>())
}

const NAMING: &str = "\
Strategies are named formulation/density[@selection]. hemisphere/… draws directions Ψ at x and finds y = vp(x, Ψ); \
area/… draws points y on the lights and asks for V(x, y). The density says how they are drawn; @selection picks a \
light first. hemisphere/toward-lights draws as area/uniform does: one density, both formulations.

";
