//! Rays of neighbouring pixels side by side.

use accel_core::RaySegment;

/// The rays of a picture `width` pixels across, given row by row, in tiles of 8
/// by 8 pixels, of these in blocks of 4 by 2: so that 8 or 64 rays in a row,
/// where a packet takes them, are neighbours both ways.
pub(super) fn in_tiles(rays: &[RaySegment], width: u32) -> Vec<RaySegment> {
    let width = width.max(1) as usize;
    let mut pixels: Vec<usize> = (0..rays.len()).collect();
    pixels.sort_by_key(|pixel| {
        let (x, y) = (pixel % width, pixel / width);
        (y / 8, x / 8, y / 2, x / 4, y, x)
    });
    pixels.into_iter().map(|pixel| rays[pixel]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_rays_in_a_row_are_a_block_and_every_ray_stays() {
        let pixel = |index: usize| [(index % 13) as f32, (index / 13) as f32, 0.0];
        let rays: Vec<_> = (0..13 * 10)
            .map(|index| RaySegment::new(pixel(index), [0.0, 0.0, 1.0]))
            .collect();
        let tiled = in_tiles(&rays, 13);
        let block: Vec<_> = tiled[8..16]
            .iter()
            .map(|ray| (ray.origin.x, ray.origin.y))
            .collect();
        let expected = [0.0, 1.0].map(|y| [4.0, 5.0, 6.0, 7.0].map(|x| (x, y)));
        assert_eq!(block, expected.concat());
        let position = |ray: &RaySegment| (ray.origin.y as u32, ray.origin.x as u32);
        let mut back: Vec<_> = tiled.iter().map(position).collect();
        back.sort_unstable();
        assert_eq!(back, rays.iter().map(position).collect::<Vec<_>>());
    }
}
