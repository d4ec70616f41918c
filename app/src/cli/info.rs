//! `majorant info`: description of a file.

use super::{Failure, options, print_line};
use majorant_core::io::volume::{self, FileInfo, GridInfo, ReadLimits, VoxelGrid};
use majorant_core::io::{picture, scene_file};
use majorant_core::scene::{SceneDoc, Within};
use std::path::{Path, PathBuf};

#[derive(clap::Args, Debug)]
#[command(after_help = "\
--json prints one line. For a volume: {\"grids\":[{\"name\",\"type\",\"class\",\"half\",\"map\",\"active_voxels\",
\"min\",\"max\",\"mean\",\"bbox\":[x0,y0,z0,x1,y1,z1],\"background\"}…]}; the bounding box is in inclusive index
coordinates, the mean is over active voxels, and an unsupported grid has \"error\" instead. \"density\" is the name of
the grid that is rendered by default, \"notices\" lists choices and repairs made when the file was read. For an EXR:
width, height, display_window, data_window [x0,y0,x1,y1], channels, majorant, notices.")]
pub(super) struct Arguments {
    /// A .vdb, .vol, .npy, .raw, .exr or .toml file.
    file: PathBuf,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.file;
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    match extension.to_ascii_lowercase().as_str() {
        "vdb" => grids(&volume::file_info(path)?, arguments.json),
        "vol" | "npy" | "raw" => {
            let grid = volume::read_volume(path, None, &ReadLimits::default())?;
            let file = FileInfo { grids: vec![describe(&grid, extension)], ..FileInfo::default() };
            grids(&file, arguments.json)
        }
        "exr" => exr(path, arguments.json),
        "toml" => scene(path, arguments.json),
        _ => Err(Failure::Message(format!(
            "{}: info supports .vdb, .vol, .npy, .raw, .exr and .toml files",
            path.display()
        ))),
    }
}

/// Describes a dense grid like a sparse one whose voxels are all active.
fn describe(grid: &VoxelGrid, kind: &str) -> GridInfo {
    let range = grid.min_max();
    GridInfo {
        name: grid.name.clone(),
        kind: format!("{kind}, {} channel(s)", grid.channels),
        class: "dense".into(),
        map: "box".into(),
        active_voxels: Some(grid.voxels() as u64),
        min: range.map(|r| r.0),
        max: range.map(|r| r.1),
        mean: Some(grid.mean()),
        bbox: Some(grid.index_bbox()),
        background: Some(volume::Background::Scalar(grid.background)),
        ..GridInfo::default()
    }
}

fn grids(file: &FileInfo, json: bool) -> Result<(), Failure> {
    options::print_notes(&file.notices);
    if json {
        return print_line(&serde_json::to_string(file)?);
    }
    let grids = &file.grids;
    if grids.is_empty() {
        return print_line("The file contains no grids.");
    }
    for g in grids {
        let half = if g.half { ", half floats" } else { "" };
        print_line(&format!("{}  {}  {}{half}  {}", quoted(&g.name), g.kind, g.class, g.map))?;
        if let Some(error) = &g.error {
            print_line(&format!("  not readable: {error}"))?;
            continue;
        }
        if let (Some(n), Some(b)) = (g.active_voxels, g.bbox) {
            print_line(&format!(
                "  {n} active voxels, indices ({}, {}, {}) to ({}, {}, {})",
                b[0], b[1], b[2], b[3], b[4], b[5]
            ))?;
        }
        if let (Some(min), Some(max), Some(mean)) = (g.min, g.max, g.mean) {
            print_line(&format!("  values {min} to {max}, mean {mean:.6}"))?;
        }
        if let Some(n) = g.non_finite.filter(|n| *n > 0) {
            print_line(&format!("  {n} voxels are NaN or infinite; they are set to 0 when rendered"))?;
        }
        if let (Some(w), Some(v)) = (g.world_size, g.voxel_size) {
            print_line(&format!(
                "  {:.4} × {:.4} × {:.4} units, voxels of {:.4} × {:.4} × {:.4}",
                w[0], w[1], w[2], v[0], v[1], v[2]
            ))?;
        }
    }
    Ok(())
}

fn quoted(name: &str) -> String {
    if name.is_empty() { "(unnamed)".into() } else { name.to_owned() }
}

fn exr(path: &Path, json: bool) -> Result<(), Failure> {
    let info = picture::exr_info(path)?;
    let mut notices = info.notices;
    // A file without colour, such as a depth map, has no texel notices.
    notices.extend(picture::texel_notices(path).unwrap_or_default());
    options::print_notes(&notices);
    let metadata: Option<serde_json::Value> =
        info.metadata.as_deref().and_then(|text| serde_json::from_str(text).ok());
    if json {
        return print_line(
            &serde_json::json!({
                "width": info.width,
                "height": info.height,
                "display_window": info.display_window,
                "data_window": info.data_window,
                "channels": info.channels,
                "majorant": metadata,
                "notices": notices,
            })
            .to_string(),
        );
    }
    print_line(&format!("{} × {} pixels, channels {}", info.width, info.height, info.channels.join(", ")))?;
    match metadata {
        Some(m) => print_line(&format!(
            "rendered by Majorant {}: {} ({}), {} spp, seed {}, {:.2} s\n\n{}",
            m["version"].as_str().unwrap_or("?"),
            m["estimator"].as_str().unwrap_or("?"),
            m["mode"].as_str().unwrap_or("?"),
            m["spp"],
            m["seed"],
            m["seconds"].as_f64().unwrap_or(0.0),
            m["scene"].as_str().unwrap_or("")
        )),
        None => print_line("not rendered by Majorant"),
    }
}

/// Scene as JSON: `media` lists all media, and `medium` is the only medium of a scene that has one.
fn scene_json(doc: &SceneDoc) -> Result<serde_json::Value, Failure> {
    let mut value = serde_json::to_value(doc)?;
    let media = value.get("media").and_then(serde_json::Value::as_array).map(Vec::as_slice);
    if let Some([only]) = media {
        let only = only.clone();
        value["medium"] = only;
    }
    Ok(value)
}

fn scene(path: &Path, json: bool) -> Result<(), Failure> {
    let doc = scene_file::load(path)?;
    if json {
        return print_line(&scene_json(&doc)?.to_string());
    }
    print_line(&format!("{}: {}", doc.title, doc.note))?;
    print_line(&format!(
        "{} × {} pixels, {} light(s), {} object(s), estimator {}",
        doc.film.width,
        doc.film.height,
        doc.lights.len(),
        doc.objects.len(),
        doc.estimator.id
    ))?;
    for object in doc.objects.iter().filter(|object| !object.name.is_empty()) {
        print_line(&format!("object {}: {}", object.name, object.shape.kind_name().to_lowercase()))?;
    }
    for medium in &doc.media {
        let density = match medium.density.grid() {
            Some(grid) => format!("density from {}", grid.file),
            None => "homogeneous medium".to_owned(),
        };
        let within = match &medium.within {
            Within::Object(name) => format!(" within {name}"),
            Within::Grid | Within::Everywhere => String::new(),
        };
        let disabled = if medium.enabled { "" } else { ", disabled" };
        match doc.media.len() {
            1 => print_line(&format!("{density}{within}{disabled}"))?,
            _ => print_line(&format!("{}: {density}{within}{disabled}", medium.name))?,
        }
    }
    Ok(())
}
