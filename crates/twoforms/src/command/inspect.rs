//! `twoforms inspect`: what a scene holds, as twoforms reads it.

use std::fmt::Write;

use anyhow::{Context, Result};
use serde_json::{Value, json};
use twoforms_comparison::viewpoint;
use twoforms_geometry::target::Sides;
use twoforms_scene::{Camera, Light, Scene};

use crate::args::{InspectArgs, InspectFormat};
use crate::output;

/// Prints the scene's contents.
pub fn run(args: &InspectArgs) -> Result<()> {
    let scene = Scene::load(&args.scene)?;
    match args.format {
        InspectFormat::Table => output::print(&text(&scene)),
        InspectFormat::Json => {
            let text = serde_json::to_string_pretty(&document(&scene)).context("the scene can't be written as JSON")?;
            output::print(&(text + "\n"))
        }
    }
}

fn document(scene: &Scene) -> Value {
    let light = |light: &Light| {
        json!({
            "name": light.name, "targets": light.targets.len(), "area": light.area, "power": light.power(),
            "radiance": light.radiance.map(f64::from), "sides": sides(light),
        })
    };
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
        "emitter_triangles": scene.targets.iter().flat_map(|target| target.triangles()).count(),
        "targets": scene.targets.len(),
        "lights": scene.lights.iter().map(light).collect::<Vec<_>>(),
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
    writeln!(out, "{}", scene.path.display())?;
    writeln!(out, "{} triangles in {} surfaces, {emitting} of them emit", scene.mesh.len(), scene.surfaces.len())?;
    if let Some((low, high)) = scene.mesh.bounds() {
        writeln!(out, "from {low} to {high} m")?;
    }
    writeln!(out, "\n{} lights, {} targets", scene.lights.len(), scene.targets.len())?;
    for light in scene.lights.iter().take(LIGHTS_LISTED) {
        let [r, g, b] = light.radiance;
        let [pr, pg, pb] = light.power();
        writeln!(
            out,
            "  {}: area {:.6} m², radiance ({r}, {g}, {b}), power ({pr:.4}, {pg:.4}, {pb:.4}), {}, {} targets",
            light.name,
            light.area,
            sides(light),
            light.targets.len(),
        )?;
    }
    if scene.lights.len() > LIGHTS_LISTED {
        writeln!(out, "  … and {} more (all with --format json)", scene.lights.len() - LIGHTS_LISTED)?;
    }
    write_cameras(scene, out)?;
    writeln!(out, "\n{} receivers", scene.receivers.len())?;
    for receiver in &scene.receivers {
        writeln!(out, "  {}: at {}, normal {}", receiver.name, receiver.position, receiver.normal)?;
        if let Some(known) = &receiver.known {
            writeln!(out, "    known irradiance {:?}: {}", known.irradiance, known.derivation)?;
        }
    }
    if !scene.warnings.is_empty() {
        writeln!(out, "\n{} warnings", scene.warnings.len())?;
    }
    scene.warnings.iter().try_for_each(|warning| writeln!(out, "  {warning}"))
}

fn write_cameras(scene: &Scene, out: &mut String) -> std::fmt::Result {
    let line = |out: &mut String, camera: &Camera| {
        let (from, toward) = (camera.position, camera.forward);
        writeln!(out, "  {}: at {from:.3}, toward {toward:.3}, {:.2}° high", camera.name, camera.yfov.to_degrees())
    };
    writeln!(out, "\n{} cameras, and auto", scene.cameras.len())?;
    scene.cameras.iter().chain(viewpoint::auto(&scene.mesh).as_ref()).try_for_each(|camera| line(out, camera))
}

fn sides(light: &Light) -> &'static str {
    match light.sides {
        Sides::Front => "front",
        Sides::Both => "both sides",
    }
}
