//! The pictures of a report.

use accel_core::{DynStructure, TraversalCounters};

use crate::cli::arguments::CompareOptions;
use crate::cli::render;
use crate::measure;
use crate::registry::Row;
use crate::report::model::{HeatMap, Pictures, Quantity, Shaded};
use crate::scene::Scene;

/// A picture's width, in pixels, at most: pictures are for looking at.
const PICTURE_WIDTH: u32 = 480;

/// Heat maps of the primary rays, and the scene itself.
pub(super) fn draw(
    scene: &Scene,
    rows: &[&Row],
    structures: &[&dyn DynStructure],
    options: &CompareOptions,
    pictures: &mut Pictures,
) {
    let (width, height) = picture_size(options.size);
    let rays = scene.camera.rays(width, height);
    for (row, structure) in rows.iter().zip(structures) {
        let counters = measure::count_pixels(*structure, &rays);
        for quantity in Quantity::ALL {
            let value = |counters: &TraversalCounters| match quantity {
                Quantity::NodeVisits => counters.nodes.sum as u32,
                Quantity::PrimitiveTests => counters.primitive_tests.sum as u32,
            };
            pictures.heat_maps.push(HeatMap {
                scene: scene.name.clone(),
                structure: row.name.to_owned(),
                quantity,
                width,
                height,
                values: counters.iter().map(value).collect(),
            });
        }
    }
    if let Some(structure) = structures.first() {
        pictures.shaded.push(Shaded {
            scene: scene.name.clone(),
            width,
            height,
            rgb: render::shaded(scene, *structure, &rays),
        });
    }
}

fn picture_size((width, height): (u32, u32)) -> (u32, u32) {
    let picture_width = width.clamp(1, PICTURE_WIDTH);
    let picture_height = (u64::from(height) * u64::from(picture_width) / u64::from(width)).max(1);
    (picture_width, picture_height as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_keep_their_shape() {
        assert_eq!(picture_size((256, 192)), (256, 192));
        assert_eq!(picture_size((1920, 1080)), (480, 270));
        assert_eq!(picture_size((16_384, 1)), (480, 1));
    }
}
