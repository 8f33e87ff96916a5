//! `twoforms inspect`: what a scene holds, as twoforms reads it.

use std::fmt::Write;
use std::sync::Arc;

use anyhow::{Context, Result};
use glam::DVec3;
use serde_json::{Value, json};
use twoforms_comparison::viewpoint;
use twoforms_comparison::world::counted;
use twoforms_geometry::target::{Sides, Target};
use twoforms_scene::{Camera, Image, Light, Scene};

use crate::args::{InspectArgs, InspectFormat};
use crate::output::{self, plain};

/// Prints the scene's contents.
pub fn run(args: &InspectArgs) -> Result<()> {
    let scene = Scene::load(&args.scene)?;
    let text = match args.format {
        InspectFormat::Table => text(&scene),
        InspectFormat::Json => {
            serde_json::to_string_pretty(&document(&scene)).context("the scene can't be written as JSON")? + "\n"
        }
    };
    Ok(output::print(&text)?)
}

fn document(scene: &Scene) -> Value {
    let light = |light: &Light| {
        json!({
            "name": light.name, "targets": light.targets.len(), "area": light.area, "power": light.power(),
            "radiance": light.radiance.map(f64::from), "sides": sides(light), "textured": light.is_textured(),
        })
    };
    let image = |image: &Arc<Image>| json!({"name": image.name, "width": image.width, "height": image.height, "bytes": image.bytes()});
    let camera = |camera: &Camera| {
        json!({
            "name": camera.name, "position": camera.position.to_array(), "forward": camera.forward.to_array(),
            "yfov": camera.yfov, "aspect": camera.aspect,
        })
    };
    let receivers: Vec<Value> = scene
        .receivers
        .iter()
        .map(|r| {
            json!({
                "name": r.name, "position": r.position.to_array(), "normal": r.normal.to_array(),
                "irradiance": r.known.as_ref().map(|known| known.irradiance),
                "derivation": r.known.as_ref().map(|known| &known.derivation),
            })
        })
        .collect();
    json!({
        "schema": "twoforms.inspect/1",
        "scene": scene.path.display().to_string(),
        "scene_sha256": scene.sha256,
        "triangles": scene.mesh.len(),
        "surfaces": scene.surfaces.len(),
        "emitter_triangles": scene.targets.iter().flat_map(Target::triangles).count(),
        "targets": scene.targets.len(),
        "lights": scene.lights.iter().map(light).collect::<Vec<_>>(),
        "textures": scene.textures.len(),
        "images": scene.images.iter().map(image).collect::<Vec<_>>(),
        "cameras": scene.cameras.iter().map(camera).collect::<Vec<_>>(),
        "auto_camera": viewpoint::auto(&scene.mesh).as_ref().map(camera),
        "receivers": receivers,
        "warnings": scene.warnings,
    })
}

fn text(scene: &Scene) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = write_text(scene, &mut text);
    text
}

/// Lights that are listed one by one.
const LIGHTS_LISTED: usize = 20;

fn write_text(scene: &Scene, out: &mut String) -> std::fmt::Result {
    let emitting: usize = scene.targets.iter().map(|target| target.triangles().count()).sum();
    writeln!(out, "{}", plain(&scene.path.display().to_string()))?;
    let (triangles, surfaces) = (counted(scene.mesh.len(), "triangle"), counted(scene.surfaces.len(), "surface"));
    writeln!(out, "{triangles} in {surfaces}, {emitting} of them emitting")?;
    if let Some((low, high)) = scene.mesh.bounds() {
        writeln!(out, "from {low} to {high} m")?;
    }
    writeln!(out, "\n{}, {}", counted(scene.lights.len(), "light"), counted(scene.targets.len(), "target"))?;
    for light in scene.lights.iter().take(LIGHTS_LISTED) {
        let [r, g, b] = light.radiance;
        let [pr, pg, pb] = light.power();
        writeln!(
            out,
            "  {}: area {:.6} m², {} ({r}, {g}, {b}), power ({pr:.4}, {pg:.4}, {pb:.4}), {}, {}",
            plain(&light.name),
            light.area,
            if light.is_textured() { "textured, mean radiance" } else { "radiance" },
            sides(light),
            counted(light.targets.len(), "target"),
        )?;
    }
    if scene.lights.len() > LIGHTS_LISTED {
        writeln!(out, "  … and {} more (all with --format json)", scene.lights.len() - LIGHTS_LISTED)?;
    }
    write_images(scene, out)?;
    write_cameras(scene, out)?;
    write_receivers(scene, out)?;
    if !scene.warnings.is_empty() {
        writeln!(out, "\n{}", counted(scene.warnings.len(), "warning"))?;
    }
    scene.warnings.iter().try_for_each(|warning| writeln!(out, "  {}", plain(warning)))
}

/// Images that textures show, where there are any.
fn write_images(scene: &Scene, out: &mut String) -> std::fmt::Result {
    if scene.images.is_empty() {
        return Ok(());
    }
    let (textures, images) = (counted(scene.textures.len(), "texture"), counted(scene.images.len(), "image"));
    let bytes: usize = scene.images.iter().map(|image| image.bytes()).sum();
    writeln!(out, "\n{textures}, {images}, {}", mebibytes(bytes))?;
    for image in &scene.images {
        let Image { name, width, height, .. } = image.as_ref();
        writeln!(out, "  {}: {width} × {height}, {}", plain(name), mebibytes(image.bytes()))?;
    }
    Ok(())
}

fn mebibytes(bytes: usize) -> String {
    format!("{:.2} MiB", bytes as f64 / f64::from(1 << 20))
}

fn write_receivers(scene: &Scene, out: &mut String) -> std::fmt::Result {
    writeln!(out, "\n{}", counted(scene.receivers.len(), "receiver"))?;
    for receiver in &scene.receivers {
        let (position, normal) = (receiver.position + DVec3::ZERO, receiver.normal + DVec3::ZERO);
        writeln!(out, "  {}: at {position}, normal {normal}", plain(&receiver.name))?;
        if let Some(known) = &receiver.known {
            writeln!(out, "    known irradiance {:?}: {}", known.irradiance, plain(&known.derivation))?;
        }
    }
    Ok(())
}

fn write_cameras(scene: &Scene, out: &mut String) -> std::fmt::Result {
    let line = |out: &mut String, camera: &Camera| {
        let (from, toward) = (thousandths(camera.position), thousandths(camera.forward));
        writeln!(
            out,
            "  {}: at {from:.3}, toward {toward:.3}, {:.2}° high",
            plain(&camera.name),
            camera.yfov.to_degrees()
        )
    };
    writeln!(out, "\n{}, and auto", counted(scene.cameras.len(), "camera"))?;
    scene.cameras.iter().chain(viewpoint::auto(&scene.mesh).as_ref()).try_for_each(|camera| line(out, camera))
}

/// Rounded to three places, and no zero with a sign.
fn thousandths(v: DVec3) -> DVec3 {
    (v * 1000.0).round() / 1000.0 + DVec3::ZERO
}

fn sides(light: &Light) -> &'static str {
    match light.sides {
        Sides::Front => "front",
        Sides::Both => "both sides",
    }
}
