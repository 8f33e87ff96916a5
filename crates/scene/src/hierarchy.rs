//! The tree of nodes: its soundness, its order and the world transforms.

use glam::DAffine3;
use gltf::json::Index;

use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::warnings::Warnings;

/// A node of the scene with its transform to the world.
pub(crate) struct Placed {
    /// Index of the node.
    pub node: usize,
    /// From the node to the world.
    pub world: DAffine3,
}

/// The nodes of the default scene (else the first, else all nodes), depth first: the scene order.
pub(crate) fn placed(document: &Document<'_>, warnings: &mut Warnings) -> Result<Vec<Placed>, Problem> {
    let parents = parents(document)?;
    let roots = roots(document, &parents, warnings)?;
    let mut waiting: Vec<_> = roots.iter().rev().map(|&node| (node, DAffine3::IDENTITY)).collect();
    let mut placed = Vec::new();
    while let Some((node, parent)) = waiting.pop() {
        let world = world(document, node, parent)?;
        placed.push(Placed { node, world });
        waiting.extend(children(document, node).rev().map(|child| (child, world)));
    }
    Ok(placed)
}

fn world(document: &Document<'_>, node: usize, parent: DAffine3) -> Result<DAffine3, Problem> {
    let place = || format!("node {:?}", document.node_name(node));
    let local = document.placements[node].local().map_err(|fault| malformed(place(), fault))?;
    let world = parent * local;
    if world.is_finite() {
        return Ok(world);
    }
    Err(malformed(place(), "stands at a place, or in a size, that is not finite"))
}

/// The parent of each node, checked to be the only one and to lead to a root.
fn parents(document: &Document<'_>) -> Result<Vec<Option<usize>>, Problem> {
    let count = document.root.nodes.len();
    let mut parents = vec![None; count];
    for node in 0..count {
        for child in children(document, node) {
            if parents[child].replace(node).is_some() {
                let place = format!("node {:?}", document.node_name(child));
                return Err(malformed(place, "has several parents"));
            }
        }
    }
    match in_a_cycle(document, &parents) {
        Some(node) => Err(malformed(format!("node {:?}", document.node_name(node)), "is its own ancestor")),
        None => Ok(parents),
    }
}

/// A node that no root leads to: where every node has one parent at most, it descends from itself.
fn in_a_cycle(document: &Document<'_>, parents: &[Option<usize>]) -> Option<usize> {
    let mut waiting: Vec<_> = (0..parents.len()).filter(|&node| parents[node].is_none()).collect();
    let mut reached = vec![false; parents.len()];
    while let Some(node) = waiting.pop() {
        reached[node] = true;
        waiting.extend(children(document, node));
    }
    reached.iter().position(|reached| !reached)
}

fn roots(document: &Document<'_>, parents: &[Option<usize>], warnings: &mut Warnings) -> Result<Vec<usize>, Problem> {
    let root = &document.root;
    let chosen = root.scene.map_or(0, |scene| scene.value());
    let Some(scene) = root.scenes.get(chosen) else {
        warnings.say("the file has no scene: all its nodes are taken");
        return Ok((0..parents.len()).filter(|&node| parents[node].is_none()).collect());
    };
    let mut listed = vec![false; parents.len()];
    let nodes = scene.nodes.iter().map(Index::value);
    nodes
        .map(|node| {
            let again = std::mem::replace(&mut listed[node], true);
            if again || parents[node].is_some() {
                let place = format!("scenes[{chosen}]");
                let fault = format!("lists {:?}, which is not a root or stands there twice", document.node_name(node));
                return Err(malformed(place, fault));
            }
            Ok(node)
        })
        .collect()
}

fn children<'a>(document: &'a Document<'_>, node: usize) -> impl DoubleEndedIterator<Item = usize> + use<'a> {
    let children = document.root.nodes[node].children.as_deref().unwrap_or_default();
    children.iter().map(Index::value)
}
