//! Cameras.

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use gltf::json;

use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::hierarchy::Placed;
use crate::warnings::Warnings;

/// A perspective camera in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name of the node, else of the camera.
    pub name: String,
    /// Centre of projection, in metres.
    pub position: DVec3,
    /// Unit vector to the right of the image: forward × up.
    pub right: DVec3,
    /// Unit vector to the top of the image.
    pub up: DVec3,
    /// Unit vector into the image.
    pub forward: DVec3,
    /// Vertical field of view in radians, in (0, π).
    pub yfov: f64,
    /// Width over height, where the file gives it.
    pub aspect: Option<f64>,
}

/// The perspective cameras in scene order.
pub(crate) fn read(
    document: &Document<'_>,
    placed: &[Placed],
    warnings: &mut Warnings,
) -> Result<Vec<Camera>, Problem> {
    let mut cameras = Vec::new();
    for Placed { node, world } in placed {
        let Some(camera) = document.root.nodes[*node].camera.and_then(|c| document.root.get(c)) else {
            continue;
        };
        let name = document.root.nodes[*node].name.clone().or_else(|| camera.name.clone());
        let name = name.unwrap_or_else(|| document.node_name(*node));
        match &camera.perspective {
            Some(perspective) => cameras.push(place(name, perspective, world)?),
            None => warnings.at("an orthographic camera is skipped", &name),
        }
    }
    Ok(cameras)
}

fn place(name: String, camera: &json::camera::Perspective, world: &DAffine3) -> Result<Camera, Problem> {
    let fault = |fault: &str| malformed(format!("camera {name:?}"), fault);
    let yfov = f64::from(camera.yfov);
    if !(yfov > 0.0 && yfov < PI) {
        return Err(fault("has a yfov outside (0, π)"));
    }
    let aspect = camera.aspect_ratio.map(f64::from);
    if aspect.is_some_and(|aspect| !(aspect > 0.0 && aspect.is_finite())) {
        return Err(fault("has an aspectRatio that is not above zero"));
    }
    let [right, up, forward] = axes(world).ok_or_else(|| fault("has a transform that flattens space"))?;
    Ok(Camera { name, position: world.translation, right, up, forward, yfov, aspect })
}

/// Right, up and forward: the camera looks along −Z with +Y up; scale and shear are left out, and −Z is kept.
fn axes(world: &DAffine3) -> Option<[DVec3; 3]> {
    let forward = (-world.matrix3.z_axis).try_normalize()?;
    let y = world.matrix3.y_axis.try_normalize()?;
    let right = forward.cross(y).try_normalize()?;
    Some([right, right.cross(forward), forward])
}
