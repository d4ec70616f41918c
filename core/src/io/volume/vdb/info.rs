//! Description of the grids of an OpenVDB file, without a dense grid.

use std::path::Path;

use glam::DVec3;
use serde::Serialize;

use super::super::choice::GridRole;
use super::super::error::{Fault, VolumeError};
use super::super::file;
use super::super::read_limits::ReadLimits;
use super::archive::Archive;
use super::value_type::ValueType;
use super::{choice, preflight, read};

/// Description of one grid. Fields without a value are omitted from the JSON.
#[derive(Debug, Clone, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub struct GridInfo {
    /// Name of the grid; the second grid of a name is `name[1]`.
    pub name: String,
    /// Tree type, for example `Tree_float_5_4_3`.
    #[serde(rename = "type")]
    pub kind: String,
    /// Grid class: `fog volume`, `level set`, `staggered` or `unknown`.
    pub class: String,
    /// Whether real numbers are saved as half floats.
    pub half: bool,
    /// Type of the transform, for example `UniformScaleMap`.
    pub map: String,
    /// Active voxels; tiles count by their volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub active_voxels: Option<u64>,
    /// Active voxels that are NaN or infinite; excluded from the statistics below.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub non_finite: Option<u64>,
    /// Smallest active value, over all channels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f32>,
    /// Largest active value, over all channels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f32>,
    /// Mean active value, over all channels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean: Option<f64>,
    /// First and last active index coordinates, both inclusive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bbox: Option<[i32; 6]>,
    /// Value of inactive voxels; one number, or three for a vector grid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background: Option<Background>,
    /// Lengths of a voxel's edges, in world units.
    #[serde(skip)]
    pub voxel_size: Option<[f64; 3]>,
    /// Lengths of the edges of the active box, in world units.
    #[serde(skip)]
    pub world_size: Option<[f64; 3]>,
    /// Reason why the grid cannot be read, if it cannot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

/// A background value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Background {
    /// Background of a grid with one channel.
    Scalar(f32),
    /// Background of a grid with three channels.
    Vector([f32; 3]),
}

/// Description of an OpenVDB file.
#[derive(Debug, Clone, Default, Serialize)]
pub struct FileInfo {
    /// Grids in file order.
    pub grids: Vec<GridInfo>,
    /// Name of the grid that is read as the density by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<String>,
    /// Notices about the file, for example which grid is read as the density.
    pub notices: Vec<String>,
}

/// Describes an OpenVDB file and every grid in it.
///
/// # Errors
/// When the file as a whole cannot be read.
pub fn file_info(path: &Path) -> Result<FileInfo, VolumeError> {
    let (limits, label) = (ReadLimits::default(), path.display().to_string());
    describe(&file::read(path, &limits)?, &label, &limits)
}

/// Describes every grid of an OpenVDB file, in file order. [`GridInfo::error`] states why a grid cannot be
/// read.
///
/// # Errors
/// When the file as a whole cannot be read.
pub fn info(path: &Path) -> Result<Vec<GridInfo>, VolumeError> {
    let limits = ReadLimits::default();
    info_bytes(&file::read(path, &limits)?, &path.display().to_string(), &limits)
}

/// [`info`] for a file in memory; `label` is its path in messages.
///
/// # Errors
/// When the file as a whole cannot be read.
pub fn info_bytes(bytes: &[u8], label: &str, limits: &ReadLimits) -> Result<Vec<GridInfo>, VolumeError> {
    describe(bytes, label, limits).map(|file| file.grids)
}

fn describe(bytes: &[u8], label: &str, limits: &ReadLimits) -> Result<FileInfo, VolumeError> {
    let archive = Archive::open(bytes, &|archive, index| preflight::end_of_grid(archive, index, limits))
        .map_err(|fault| fault.in_file(label, None))?;
    let describe_grid = |index| {
        let mut info = describe_head(&archive, index);
        if let Err(fault) = describe_values(&archive, index, limits, &mut info) {
            info.error = Some(archive.header.blamed(fault).in_file(label, Some(&info.name)).to_string());
        }
        info
    };
    let mut grids: Vec<_> = (0..archive.grids.len()).map(describe_grid).collect();
    if archive.unreachable > 0 {
        let what = format!(
            "{} more grid(s), which cannot be found behind a grid that is not supported",
            archive.unreachable
        );
        let fault = Fault::unsupported(what, "Save the file again, with grid offsets");
        let error = Some(fault.in_file(label, None).to_string());
        grids.push(GridInfo { error, ..GridInfo::default() });
    }
    let density = choice::most_suitable(&archive, GridRole::Density);
    let mut notices = Vec::from_iter(archive.header.notice().map(|notice| format!("{label}: {notice}.")));
    let chosen = density.and_then(|index| choice::notice(&archive, index, GridRole::Density));
    notices.extend(chosen.map(|notice| format!("{label}: {notice}")));
    let density = density.map(|index| archive.grids[index].display_name.clone());
    Ok(FileInfo { grids, density, notices })
}

/// Describes the data in front of the tree, as far as it can be read.
fn describe_head(archive: &Archive, index: usize) -> GridInfo {
    let grid = &archive.grids[index];
    let mut info = GridInfo {
        name: grid.display_name.clone(),
        kind: grid.tree_type.clone(),
        class: preflight::class(None),
        half: grid.half,
        ..GridInfo::default()
    };
    if let Ok(head) = archive.grid_head(grid) {
        info.class = preflight::class(head.metadata.text("class"));
        info.half = head.metadata.boolean("is_saved_as_half_float").unwrap_or(grid.half);
        info.half |= matches!(ValueType::of_tree(&grid.tree_type), Ok(ValueType::Half));
        info.map = head.map_type;
    }
    info
}

/// Adds the statistics of the values.
fn describe_values(
    archive: &Archive,
    index: usize,
    limits: &ReadLimits,
    info: &mut GridInfo,
) -> Result<(), Fault> {
    let preflight = preflight::check(archive, index, limits)?;
    let edges = preflight.world_from_index.matrix3;
    let voxel_size = [edges.x_axis, edges.y_axis, edges.z_axis].map(DVec3::length);
    let sparse = read::unpack(preflight, &|_| ())?;
    let stats = sparse.stats();
    let bbox = sparse.active_bbox();
    info.active_voxels = Some(stats.voxels);
    info.non_finite = Some(stats.non_finite).filter(|&count| count > 0);
    info.min = stats.min;
    info.max = stats.max;
    info.mean = stats.mean();
    info.bbox = bbox.map(|bbox| bbox.to_array());
    info.background = Some(match sparse.channels {
        1 => Background::Scalar(sparse.background[0]),
        _ => Background::Vector(sparse.background),
    });
    info.voxel_size = Some(voxel_size);
    info.world_size = bbox.map(|bbox| {
        let size = bbox.size();
        [0, 1, 2].map(|axis| voxel_size[axis] * size[axis] as f64)
    });
    Ok(())
}
