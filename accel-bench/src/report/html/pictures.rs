//! Heat maps and pictures as parts of the page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use super::HtmlError;
use crate::report::heat::Scale;
use crate::report::model::{HeatMap, Pictures, Quantity};
use crate::report::png;

/// The pictures of a scene.
#[derive(Serialize)]
pub(super) struct SceneMaps {
    width: u32,
    height: u32,
    /// The scene itself, as a data URI.
    shaded: Option<String>,
    quantities: Vec<QuantityMaps>,
    /// The scale's colours from zero to its top, as CSS.
    legend: String,
}

/// Heat maps of one quantity, on one scale.
#[derive(Serialize)]
struct QuantityMaps {
    name: &'static str,
    /// The value at the bright end of the scale.
    top: u32,
    maps: Vec<StructureMap>,
}

#[derive(Serialize)]
struct StructureMap {
    structure: String,
    image: String,
    mean: f64,
    max: u32,
}

/// The pictures of `scene`, if there are any.
pub(super) fn of_scene(scene: &str, pictures: &Pictures) -> Result<Option<SceneMaps>, HtmlError> {
    let maps: Vec<&HeatMap> = pictures
        .heat_maps
        .iter()
        .filter(|map| map.scene == scene)
        .collect();
    let Some(first) = maps.first() else {
        return Ok(None);
    };
    let shaded = pictures
        .shaded
        .iter()
        .find(|picture| picture.scene == scene);
    let shaded = shaded.map(|picture| data_uri(picture.width, picture.height, &picture.rgb));
    let quantities = Quantity::ALL.into_iter().map(|quantity| {
        let maps: Vec<&HeatMap> = maps
            .iter()
            .copied()
            .filter(|map| map.quantity == quantity)
            .collect();
        quantity_maps(quantity, &maps)
    });
    Ok(Some(SceneMaps {
        width: first.width,
        height: first.height,
        shaded: shaded.transpose()?,
        quantities: quantities.collect::<Result<_, _>>()?,
        legend: legend(),
    }))
}

fn quantity_maps(quantity: Quantity, maps: &[&HeatMap]) -> Result<QuantityMaps, HtmlError> {
    let scale = Scale::shared(maps.iter().map(|map| map.values.as_slice()));
    let maps = maps.iter().map(|map| {
        let sum: f64 = map.values.iter().copied().map(f64::from).sum();
        Ok(StructureMap {
            structure: map.structure.clone(),
            image: data_uri(map.width, map.height, &scale.colours(&map.values))?,
            mean: sum / map.values.len().max(1) as f64,
            max: map.values.iter().copied().max().unwrap_or(0),
        })
    });
    Ok(QuantityMaps {
        name: quantity.name(),
        top: scale.top,
        maps: maps.collect::<Result<_, HtmlError>>()?,
    })
}

/// A picture of three bytes a pixel, as part of a page.
pub(in crate::report) fn data_uri(
    width: u32,
    height: u32,
    rgb: &[u8],
) -> Result<String, HtmlError> {
    let mut bytes = Vec::new();
    png::write_rgb(&mut bytes, width, height, rgb)?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(bytes)))
}

fn legend() -> String {
    const STEPS: u32 = 16;
    let scale = Scale { top: STEPS };
    let stops = (0..=STEPS).map(|step| {
        let colour = scale.colours(&[step]);
        format!("rgb({},{},{})", colour[0], colour[1], colour[2])
    });
    format!(
        "linear-gradient(90deg,{})",
        stops.collect::<Vec<_>>().join(",")
    )
}
