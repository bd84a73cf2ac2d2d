//! `render`: a picture of a scene, or of what its rays cost.

use std::fs::File;
use std::io::BufWriter;

use accel_core::glam::Vec3;
use accel_core::{DynStructure, Hit, RaySegment, TraversalCounters};
use anyhow::Context;

use super::arguments::{RenderOptions, Show};
use super::{build, load, with_threads};
use crate::measure;
use crate::registry;
use crate::report::png;
use crate::scene::Scene;

/// Draws and writes the picture.
pub(super) fn run(options: &RenderOptions) -> anyhow::Result<bool> {
    let names = [options.structure.clone()];
    let rows = registry::select(&names).map_err(anyhow::Error::msg)?;
    anyhow::ensure!(
        rows.len() == 1,
        "render takes one structure, not `{}`",
        options.structure
    );
    with_threads(options.scene.threads, || {
        let scene = load(&options.scene_name, &options.scene)?;
        let structure = build(rows[0], &scene, options.scene.invalid())?;
        let rays = scene.camera.rays(options.size.0, options.size.1);
        let context = || format!("writing {}", options.output.display());
        let file = File::create(&options.output).with_context(context)?;
        let mut out = BufWriter::new(file);
        let (width, height) = options.size;
        match picture(&scene, structure.as_ref(), &rays, options.show) {
            Picture::Colours(rgb) => png::write_rgb(&mut out, width, height, &rgb),
            Picture::Values(values) => png::write_heat_map(&mut out, width, height, &values),
        }
        .with_context(context)?;
        Ok(true)
    })
}

enum Picture {
    /// Three bytes a pixel.
    Colours(Vec<u8>),
    /// A quantity a pixel, to be mapped to colours.
    Values(Vec<u32>),
}

fn picture(
    scene: &Scene,
    structure: &dyn DynStructure,
    rays: &[RaySegment],
    show: Show,
) -> Picture {
    let count = |value: fn(&TraversalCounters) -> u64| {
        let counters = measure::count_pixels(structure, rays);
        Picture::Values(
            counters
                .iter()
                .map(|counters| value(counters) as u32)
                .collect(),
        )
    };
    match show {
        Show::Shaded => Picture::Colours(shaded(scene, structure, rays)),
        Show::Normals => Picture::Colours(normals(scene, structure, rays)),
        Show::Nodes => count(|counters| counters.nodes.sum),
        Show::Planes => count(|counters| counters.plane_tests.sum),
        Show::Tests => count(|counters| counters.primitive_tests.sum),
        Show::Cost => count(|counters| counters.nodes.sum + counters.primitive_tests.sum),
        Show::Time => Picture::Values(measure::nanoseconds_of_pixels(structure, rays)),
    }
}

/// The scene lit from the camera, three bytes a pixel.
pub(super) fn shaded(scene: &Scene, structure: &dyn DynStructure, rays: &[RaySegment]) -> Vec<u8> {
    colours(scene, structure, rays, |ray, normal| {
        let facing = normal.dot(ray.direction.normalize_or_zero()).abs();
        // Hemispheric light from above keeps surfaces apart that face alike.
        let sky = 0.5 + 0.5 * normal.y * -normal.dot(ray.direction).signum();
        Vec3::splat(0.12 + 0.58 * facing) + Vec3::new(0.24, 0.27, 0.30) * sky
    })
}

fn normals(scene: &Scene, structure: &dyn DynStructure, rays: &[RaySegment]) -> Vec<u8> {
    colours(scene, structure, rays, |_, normal| normal * 0.5 + 0.5)
}

fn colours(
    scene: &Scene,
    structure: &dyn DynStructure,
    rays: &[RaySegment],
    colour: impl Fn(&RaySegment, Vec3) -> Vec3,
) -> Vec<u8> {
    const BACKGROUND: Vec3 = Vec3::new(0.93, 0.94, 0.96);
    let mut hits: Vec<Option<Hit>> = vec![None; rays.len()];
    structure.trace_closest(rays, &mut hits);
    rays.iter()
        .zip(hits)
        .flat_map(|(ray, hit)| {
            let colour = hit.map_or(BACKGROUND, |hit| {
                colour(ray, scene.triangles[hit.id as usize].normal())
            });
            (colour.clamp(Vec3::ZERO, Vec3::ONE) * 255.0)
                .to_array()
                .map(|channel| channel as u8)
        })
        .collect()
}
