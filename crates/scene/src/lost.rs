//! Lights that never become emitters: punctual ones, and the empty nodes that exporters leave of area lights.

use gltf::json::Node;

use crate::document::Document;
use crate::hierarchy::Placed;
use crate::receiver::Receiver;
use crate::warnings::Warnings;

/// Counts the nodes with point, spot and directional lights.
pub(crate) fn punctual(document: &Document<'_>, placed: &[Placed], warnings: &mut Warnings) -> usize {
    let lights = placed.iter().filter(|placed| is_punctual(&document.root.nodes[placed.node]));
    lights.map(|placed| warn(document, placed, "a punctual light has no area and is ignored", warnings)).count()
}

/// Names of the empty nodes that are named like lights and are no receivers.
pub(crate) fn empty(
    document: &Document<'_>,
    placed: &[Placed],
    receivers: &[Receiver],
    warnings: &mut Warnings,
) -> Vec<String> {
    let receives = |node: &Node| receivers.iter().any(|receiver| node.name.as_ref() == Some(&receiver.name));
    let nodes = placed.iter().map(|placed| (placed, &document.root.nodes[placed.node]));
    let lost = nodes.filter(|(_, node)| is_lost(node) && !receives(node)).map(|(placed, _)| placed);
    lost.map(|placed| warn(document, placed, "an empty node is named like a light and gives none", warnings)).collect()
}

fn warn(document: &Document<'_>, placed: &Placed, text: &str, warnings: &mut Warnings) -> String {
    let name = document.node_name(placed.node);
    warnings.at(text, &name);
    name
}

fn is_punctual(node: &Node) -> bool {
    node.extensions.as_ref().is_some_and(|extensions| extensions.khr_lights_punctual.is_some())
}

fn is_lost(node: &Node) -> bool {
    let childless = node.children.as_ref().is_none_or(Vec::is_empty);
    let empty = childless && node.mesh.is_none() && node.camera.is_none() && !is_punctual(node);
    empty && node.name.as_deref().is_some_and(sounds_like_a_light)
}

/// Whether a name is one that modelling programs give to lights.
fn sounds_like_a_light(name: &str) -> bool {
    let name = name.to_lowercase();
    let begins = ["area", "point", "spot", "sun"].iter().any(|word| name.starts_with(word));
    begins || ["light", "lamp"].iter().any(|word| name.contains(word))
}
