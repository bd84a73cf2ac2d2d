//! Pictures as PNG.

use std::io::Write;

use super::heat::Scale;

/// Writes a picture of three bytes a pixel.
///
/// # Errors
/// What `out` answers, or that `rgb` is not as long as the size says.
pub fn write_rgb(
    out: &mut impl Write,
    width: u32,
    height: u32,
    rgb: &[u8],
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(rgb)
}

/// Writes a quantity as colours on a scale of its own.
///
/// # Errors
/// As [`write_rgb`].
pub fn write_heat_map(
    out: &mut impl Write,
    width: u32,
    height: u32,
    values: &[u32],
) -> Result<(), png::EncodingError> {
    write_rgb(out, width, height, &Scale::shared([values]).colours(values))
}
