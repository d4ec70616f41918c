//! The grid of an OpenVDB file that is read.

use super::super::choice::{GridChoice, GridRole, Suitability, suitability};
use super::super::error::VolumeError;
use super::super::limits::Limits;
use super::LEVEL_SET;
use super::archive::Archive;
use super::preflight::{self, Preflight};
use super::value_type::ValueType;

/// A grid that was found and checked.
pub(super) struct Chosen {
    pub(super) index: usize,
    pub(super) preflight: Preflight,
    /// What is to be known about the file and the choice.
    pub(super) notices: Vec<String>,
}

/// Finds the grid that is asked for, and checks it.
pub(super) fn choose(
    archive: &Archive,
    label: &str,
    choice: GridChoice<'_>,
    limits: &Limits,
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
                0 => "it holds no grid".to_owned(),
                _ => format!(
                    "none of its grids is a {quantity} by its name, type and class: name the one that is meant with \
                     the key `grid` beside `file` ({key} = \"NAME\")"
                ),
            })
        })?,
    };
    let grid = &archive.grids[index].display_name;
    // A grid that cannot be read is not replaced by a less suitable one: that would be another picture.
    let preflight = preflight::check(archive, index, limits)
        .map_err(|fault| archive.header.blamed(fault).in_file(label, Some(grid)))?;
    let mut notices = Vec::from_iter(archive.header.notice().map(|notice| format!("{label}: {notice}.")));
    notices.extend(
        (name.is_none()).then(|| notice(archive, index, role)).flatten().map(|n| format!("{label}: {n}")),
    );
    Ok(Chosen { index, preflight, notices })
}

/// Number of the grid that is read in a role when none is named.
pub(super) fn most_suitable(archive: &Archive, role: GridRole) -> Option<usize> {
    let rank = |index: usize| {
        let grid = &archive.grids[index];
        let suitability = suitability(&grid.display_name, role)?;
        if suitability == Suitability::OwnName {
            // Whatever its type: a vector grid of densities is one, and what cannot be read is said so.
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

/// Which grid was chosen from which, unless it has the role's own name and no other could be meant.
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
        false => format!(" (the file also holds {})", others.join(", ")),
    };
    Some(format!(
        "its grid {} is read as the {quantity}{among}; {} names another.",
        quoted(index),
        role.key()
    ))
}
