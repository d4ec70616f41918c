//! One EXR file with a layer for every view and one for the reference.

use super::ReportError;
use super::gather::{Gathered, Shown};
use crate::compare::Reference;
use crate::io::export::{METADATA, metadata};
use exr::prelude::*;
use serde_json::json;
use std::path::Path;

type Channels = SmallVec<[AnyChannel<FlatSamples>; 4]>;

/// Writes R, G, B, `stderr.R/G/B` and `map.ID` of every view, in a layer named e.g. `A-nee`, and the image
/// and standard error of the reference. Every layer has its metadata as JSON in the attribute `majorant`.
pub(super) fn write(gathered: &Gathered<'_>, path: &Path) -> std::result::Result<(), ReportError> {
    let mut layers: Vec<Layer<AnyChannels<FlatSamples>>> = gathered.views.iter().map(view).collect();
    layers.extend(gathered.reference().map(reference));
    // Readers without support for layers use the first layer and the size of the display window.
    let size = layers.first().map_or(Vec2(1, 1), |l| l.size);
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    let image = Image { attributes, layer_data: layers.into() };
    let image: Image<Layers<AnyChannels<FlatSamples>>> = image;
    image.write().to_file(path).map_err(|e| ReportError::write(path, e))
}

fn view(shown: &Shown<'_>) -> Layer<AnyChannels<FlatSamples>> {
    let snapshot = &shown.view.snapshot;
    let mut channels = Channels::new();
    colour(&mut channels, "", &snapshot.mean);
    colour(&mut channels, "stderr.", &snapshot.standard_error);
    for (map, values) in &shown.maps {
        let name = format!("map.{}", map.id);
        channels.push(AnyChannel::new(name.as_str(), FlatSamples::F32(values.clone())));
    }
    let about = metadata(snapshot, &shown.view.doc);
    layer(&shown.name, (snapshot.width, snapshot.height), &about, channels)
}

fn reference(reference: &Reference) -> Layer<AnyChannels<FlatSamples>> {
    let mut channels = Channels::new();
    colour(&mut channels, "", reference.mean());
    if let Some(errors) = reference.standard_error() {
        colour(&mut channels, "stderr.", errors);
    }
    let about = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "target": reference.target,
        "origin": reference.origin,
    });
    layer("reference", (reference.width, reference.height), &about, channels)
}

fn colour(channels: &mut Channels, prefix: &str, pixels: &[[f32; 3]]) {
    for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
        let plane = FlatSamples::F32(pixels.iter().map(|p| p[c]).collect());
        channels.push(AnyChannel::new(format!("{prefix}{name}").as_str(), plane));
    }
}

fn layer(
    name: &str,
    size: (usize, usize),
    about: &serde_json::Value,
    channels: Channels,
) -> Layer<AnyChannels<FlatSamples>> {
    let mut attributes = LayerAttributes::named(name);
    let text = about.to_string();
    attributes.other.insert(Text::from(METADATA), AttributeValue::Text(Text::from(text.as_str())));
    Layer::new(size, attributes, Encoding::SMALL_FAST_LOSSLESS, AnyChannels::sort(channels))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::report::fixture;

    #[test]
    fn every_layer_reads_back_by_name() {
        let experiment = fixture::experiment("A cloud");
        let gathered = Gathered::of(&experiment);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("compare.exr");
        write(&gathered, &path).unwrap();
        let image =
            read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
        let image = image.from_file(&path).unwrap();
        let names: Vec<String> =
            image.layer_data.iter().map(|l| l.attributes.layer_name.clone().unwrap().to_string()).collect();
        assert_eq!(names, ["A-spectral-mis", "B-nee", "C-uni-nee-mis", "reference"]);
        for (layer, shown) in image.layer_data.iter().zip(&gathered.views) {
            let channel = |name: &str| {
                let list = &layer.channel_data.list;
                let found = list.iter().find(|c| c.name == *name).unwrap();
                found.sample_data.values_as_f32().collect::<Vec<f32>>()
            };
            let red: Vec<f32> = shown.view.snapshot.mean.iter().map(|p| p[0]).collect();
            assert_eq!(channel("R"), red);
            let z = crate::compare::maps::find("z").unwrap();
            assert_eq!(channel("map.z"), shown.map(z).unwrap());
            assert_eq!(channel("stderr.B").len(), red.len());
        }
        // Readers without support for layers see the first layer as an image with its noise.
        let first = crate::io::picture::read_estimate(&path).unwrap();
        assert_eq!(first.picture.pixels, experiment.views[0].1.snapshot.mean);
        assert!(first.metadata.unwrap().contains("spectral-mis"));
    }
}
