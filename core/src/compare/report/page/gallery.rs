//! Image layers of the page, embedded as data URLs.

use crate::compare::Standing;
use crate::compare::maps::{Map, Range};
use crate::compare::report::gather::{Gathered, Shown};
use crate::compare::report::{pictures, words};
use base64::Engine;
use serde::Serialize;

/// One image or map of every view.
#[derive(Serialize)]
pub(super) struct Layer {
    id: String,
    name: String,
    formula: String,
    legend: Option<Legend>,
    images: Vec<Picture>,
}

#[derive(Serialize)]
struct Picture {
    /// A, B, C, … or R.
    view: String,
    name: String,
    alt: String,
    png: String,
    width: usize,
    height: usize,
}

/// A colour bar with its ticks.
#[derive(Serialize)]
struct Legend {
    /// CSS colour stops of equal spacing.
    gradient: String,
    ticks: Vec<Tick>,
}

#[derive(Serialize)]
struct Tick {
    percent: String,
    text: String,
}

/// The images, and every map that some view has.
pub(super) fn layers(gathered: &Gathered<'_>) -> Result<Vec<Layer>, String> {
    let mut pictures = Vec::new();
    for (shown, standing) in gathered.views.iter().zip(&gathered.standings) {
        let alt = format!("The scene rendered by {}, {} samples per pixel", standing.name, standing.spp);
        pictures.push(picture(shown, standing, alt, pictures::picture(shown)?));
    }
    if let (Some(reference), Some(png)) = (gathered.reference(), pictures::reference(gathered)) {
        pictures.push(Picture {
            view: "R".into(),
            name: "Reference".into(),
            alt: format!("The reference: {}", reference.origin),
            png: base64(&png?),
            width: reference.width,
            height: reference.height,
        });
    }
    let formula = "tone-mapped with the view settings of the scene".into();
    let mut layers =
        vec![Layer { id: "picture".into(), name: "Picture".into(), formula, legend: None, images: pictures }];
    for (map, range) in &gathered.maps {
        layers.push(map_layer(gathered, map, range)?);
    }
    Ok(layers)
}

fn map_layer(gathered: &Gathered<'_>, map: &Map, range: &Range) -> Result<Layer, String> {
    let mut images = Vec::new();
    for (shown, standing) in gathered.views.iter().zip(&gathered.standings) {
        if let Some(png) = pictures::painted(shown, map, range) {
            let alt = format!("Map of {}, {}: {}", standing.name, map.name, map.formula);
            images.push(picture(shown, standing, alt, png?));
        }
    }
    let (id, name, formula) = (map.id.to_owned(), map.name.to_owned(), map.formula.to_owned());
    Ok(Layer { id, name, formula, legend: Some(legend(range)), images })
}

fn picture(shown: &Shown<'_>, standing: &Standing, alt: String, png: Vec<u8>) -> Picture {
    Picture {
        view: standing.label.clone(),
        name: standing.name.clone(),
        alt,
        png: base64(&png),
        width: shown.view.snapshot.width,
        height: shown.view.snapshot.height,
    }
}

fn base64(bytes: &[u8]) -> String {
    base64::engine::general_purpose::STANDARD.encode(bytes)
}

/// Number of intervals of the gradient.
const STEPS: u8 = 32;

fn legend(range: &Range) -> Legend {
    let stops = (0..=STEPS).map(|i| {
        let [r, g, b] = range.colour(f32::from(i) / f32::from(STEPS));
        format!("#{r:02x}{g:02x}{b:02x}")
    });
    let at = [0.0, 0.25, 0.5, 0.75, 1.0];
    let tick = |position: &f32| Tick {
        percent: format!("{:.0}", 100.0 * position),
        text: words::tick(f64::from(range.value(*position))),
    };
    Legend { gradient: stops.collect::<Vec<_>>().join(", "), ticks: at.iter().map(tick).collect() }
}
