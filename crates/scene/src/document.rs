//! The parsed file, checked before anything is read through it.

use std::path::{Path, PathBuf};

use gltf::json::validation::{Error as Fault, Validate};
use gltf::json::{Path as JsonPath, Root};
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::allowances;
use crate::buffer::{self, Buffer};
use crate::container;
use crate::error::{Problem, malformed};
use crate::extensions;
use crate::transform::Placement;

/// A parsed file with its buffers.
pub(crate) struct Document<'a> {
    /// The parsed JSON, in which every index is known to be in range.
    pub root: Root,
    /// Where the nodes are, in binary64, by node index.
    pub placements: Vec<Placement>,
    /// Whether something moves in it.
    pub animated: bool,
    /// Whether attributes may be integers.
    pub quantized: bool,
    /// Where files that it names are looked for.
    pub folder: PathBuf,
    /// The buffers by index.
    pub buffers: Vec<Buffer<'a>>,
}

/// What this crate reads of the JSON by itself: nodes, whose numbers the parsed form rounds to binary32.
#[derive(Deserialize)]
struct Outline {
    #[serde(default)]
    nodes: Vec<Placement>,
    #[serde(default)]
    animations: Vec<IgnoredAny>,
}

/// The part that must be understood before the rest can be.
#[derive(Deserialize)]
struct Preamble {
    asset: Asset,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asset {
    version: String,
    min_version: Option<String>,
}

impl<'a> Document<'a> {
    /// Parses `bytes` and reads the buffers, files among them from the folder of `path`.
    pub fn open(bytes: &'a [u8], path: &Path) -> Result<Self, Problem> {
        let container = container::open(bytes)?;
        check_version(&container.json)?;
        let root = parse_root(&container.json)?;
        let Outline { nodes: placements, animations } = parse(&container.json)?;
        extensions::check(&root)?;
        validate(&root)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let buffers = buffer::read_all(&root, container.blob, folder)?;
        let quantized = extensions::uses(&root, extensions::QUANTIZATION);
        Ok(Self { root, placements, animated: !animations.is_empty(), quantized, folder: folder.into(), buffers })
    }

    /// What messages call node `index`: its name, else its place in the file.
    pub fn node_name(&self, index: usize) -> String {
        self.root.nodes[index].name.clone().unwrap_or_else(|| format!("nodes[{index}]"))
    }
}

fn parse_root(json: &[u8]) -> Result<Root, Problem> {
    parse(json).or_else(|problem| allowances::parse(json).ok_or(problem))
}

fn parse<'de, T: Deserialize<'de>>(json: &'de [u8]) -> Result<T, Problem> {
    serde_json::from_slice(json).map_err(|error| {
        Problem::NotGltf(match error.classify() {
            serde_json::error::Category::Data => format!("its JSON does not follow glTF 2.0 ({error})"),
            _ => format!("it is not JSON ({error})"),
        })
    })
}

/// Refuses other versions by name, before their form is taken for a fault.
fn check_version(json: &[u8]) -> Result<(), Problem> {
    let Asset { version, min_version } = parse::<Preamble>(json)?.asset;
    if !version.starts_with("2.") {
        return Err(Problem::NotGltf(format!("its asset.version is {version:?}")));
    }
    match min_version {
        Some(least) if least != "2.0" => Err(Problem::NotGltf(format!("its asset.minVersion is {least:?}"))),
        _ => Ok(()),
    }
}

/// Checks every index and every enumerated value.
fn validate(root: &Root) -> Result<(), Problem> {
    check_positions(root)?;
    let mut faults = Vec::new();
    root.validate(root, JsonPath::new, &mut |path, fault| faults.push((path().0, fault)));
    faults.retain(|(path, fault)| matters(path, *fault));
    match faults.first() {
        Some((path, fault)) => Err(malformed(path, clause(*fault))),
        None => Ok(()),
    }
}

/// Checks the indices that the validation itself follows without looking.
fn check_positions(root: &Root) -> Result<(), Problem> {
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            if primitive.attributes.values().any(|accessor| root.get(*accessor).is_none()) {
                let place = format!("meshes[{m}].primitives[{p}]");
                return Err(malformed(place, "names an accessor that does not exist"));
            }
        }
    }
    Ok(())
}

/// What the validation calls the parts of a file that are not read, or whose faults count only where a surface shows them.
const UNREAD: [&str; 6] = ["animations", "extensions", "images", "samplers", "skins", "textures"];

/// Whether a fault is one here. Bounds of accessors and attributes of other names are not read, and required extensions
/// and accessors without data are looked after elsewhere.
fn matters(path: &str, fault: Fault) -> bool {
    let part = path.split(['[', '.']).next().unwrap_or_default();
    let bounds = matches!(path.rsplit('.').next(), Some("min" | "max"));
    match fault {
        _ if UNREAD.contains(&part) || bounds => false,
        Fault::Unsupported => false,
        Fault::Missing => part != "accessors",
        Fault::Invalid => !path.contains(".attributes["),
        _ => true,
    }
}

fn clause(fault: Fault) -> &'static str {
    match fault {
        Fault::IndexOutOfBounds => "names something that does not exist",
        Fault::Missing => "is missing",
        Fault::Oversize => "is larger than this machine's addresses",
        Fault::Invalid | Fault::Unsupported => "has a value that glTF does not know",
    }
}
