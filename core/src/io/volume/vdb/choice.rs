//! Selection of a grid in an OpenVDB file.

use super::super::choice::{GridChoice, GridRole, Suitability, suitability};
use super::super::error::VolumeError;
use super::super::read_limits::ReadLimits;
use super::LEVEL_SET;
use super::archive::Archive;
use super::preflight::{self, Preflight};
use super::value_type::ValueType;

/// A grid that was found and checked.
pub(super) struct Chosen {
    pub(super) index: usize,
    pub(super) preflight: Preflight,
    /// Notices about the file and the selection.
    pub(super) notices: Vec<String>,
}

/// Finds the requested grid and checks it.
pub(super) fn choose(
    archive: &Archive,
    label: &str,
    choice: GridChoice<'_>,
    limits: &ReadLimits,
) -> Result<Chosen, VolumeError> {
    let no_such_grid =
        |what: String| VolumeError::NoSuchGrid { file: label.to_owned(), what, available: archive.names() };
    let GridChoice { name, role } = choice;
    let index = match name {
        Some(name) => archive
            .grids
            .iter()
            .position(|grid| grid.display_name == name)
            .ok_or_else(|| no_such_grid(format!("it has no grid named \"{name}\"")))?,
        None => most_suitable(archive, role).ok_or_else(|| {
            let (quantity, key) = (role.name(), role.key());
            no_such_grid(match archive.grids.len() {
                0 => "it contains no grid".to_owned(),
                _ => format!(
                    "none of its grids is a {quantity} by its name, type and class: select one with \
                     the key `grid` beside `file` ({key} = \"NAME\")"
                ),
            })
        })?,
    };
    let grid = &archive.grids[index].display_name;
    // A grid that cannot be read is not replaced by a less suitable one, which would show a different image.
    let preflight = preflight::check(archive, index, limits)
        .map_err(|fault| archive.header.blamed(fault).in_file(label, Some(grid)))?;
    let mut notices = Vec::from_iter(archive.header.notice().map(|notice| format!("{label}: {notice}.")));
    notices.extend(
        (name.is_none()).then(|| notice(archive, index, role)).flatten().map(|n| format!("{label}: {n}")),
    );
    Ok(Chosen { index, preflight, notices })
}

/// Index of the grid that is read in a role without a name.
pub(super) fn most_suitable(archive: &Archive, role: GridRole) -> Option<usize> {
    let rank = |index: usize| {
        let grid = &archive.grids[index];
        let suitability = suitability(&grid.display_name, role)?;
        if suitability == Suitability::OwnName {
            // Any type is accepted: a vector grid of densities is valid, and an unsupported type gives an
            // error.
            return Some((suitability, false));
        }
        if !ValueType::of_tree(&grid.tree_type).is_ok_and(ValueType::is_real_scalar) {
            return None;
        }
        let class = archive.grid_head(grid).ok().map(|head| preflight::class(head.metadata.text("class")));
        let is_fog = class.as_deref() == Some("fog volume");
        (class.as_deref() != Some(LEVEL_SET)).then_some((suitability, !is_fog))
    };
    let ranked = (0..archive.grids.len()).filter_map(|index| Some((rank(index)?, index)));
    ranked.min().map(|(_, index)| index)
}

/// Notice about the selected grid and its alternatives; `None` if it has the name of the role and no other
/// grid has a related name.
pub(super) fn notice(archive: &Archive, index: usize, role: GridRole) -> Option<String> {
    let quantity = role.name();
    let named_alike = |other: usize| {
        let suitability = suitability(&archive.grids[other].display_name, role);
        other != index && suitability.is_some_and(|s| s < Suitability::Unknown)
    };
    if archive.grids[index].display_name == quantity && !(0..archive.grids.len()).any(named_alike) {
        return None;
    }
    let quoted = |index: usize| format!("\"{}\"", archive.grids[index].display_name);
    let others: Vec<_> = (0..archive.grids.len()).filter(|other| *other != index).map(quoted).collect();
    let among = match others.is_empty() {
        true => String::new(),
        false => format!(" (the file also contains {})", others.join(", ")),
    };
    Some(format!(
        "its grid {} is read as the {quantity}{among}; {} selects another.",
        quoted(index),
        role.key()
    ))
}
