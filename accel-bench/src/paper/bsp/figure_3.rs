//! Figure 3: the time of every pixel with the kd-tree and with the BSP tree, and the
//! normalised difference.

use accel_core::DynStructure;

use crate::measure;
use crate::report::document::Picture;
use crate::report::heat::Scale;
use crate::scene::camera::Camera;

/// Two heat maps on one scale, and their difference.
pub(super) fn pictures(
    kd_tree: &dyn DynStructure,
    bsp: &dyn DynStructure,
    camera: Camera,
    (width, height): (u32, u32),
) -> [Picture; 3] {
    let rays = camera.rays(width, height);
    let times = [kd_tree, bsp].map(|structure| measure::nanoseconds_of_pixels(structure, &rays));
    let scale = Scale::shared(times.iter().map(Vec::as_slice));
    let picture = |caption: &str, rgb| Picture {
        caption: caption.to_owned(),
        width,
        height,
        rgb,
    };
    let differences = times[0].iter().zip(&times[1]);
    let differences = differences.flat_map(|(kd_tree, bsp)| difference(*kd_tree, *bsp));
    [
        picture("time with the kd-tree", scale.colours(&times[0])),
        picture("time with BSP-tri", scale.colours(&times[1])),
        picture(
            "normalised difference: white where the kd-tree is slower, red where BSP-tri is",
            differences.collect(),
        ),
    ]
}

/// Of two times the difference over the longer one, as a colour: white where the
/// first is longer, red where the second is, black where they are equal.
fn difference(kd_tree: u32, bsp: u32) -> [u8; 3] {
    let longer = f64::from(kd_tree.max(bsp).max(1));
    let share = (f64::from(kd_tree) - f64::from(bsp)) / longer;
    let intensity = (255.0 * share.abs()).round() as u8;
    if share >= 0.0 {
        [intensity; 3]
    } else {
        [intensity, 0, 0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_where_the_kd_tree_is_slower_and_red_where_the_bsp_is() {
        assert_eq!(difference(200, 0), [255; 3]);
        assert_eq!(difference(0, 200), [255, 0, 0]);
        assert_eq!(difference(100, 50), [128; 3]);
        assert_eq!(difference(70, 70), [0; 3]);
        assert_eq!(difference(0, 0), [0; 3]);
    }
}
