//! Settings of the window that persist between runs.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Preferences and recent files; stored by eframe together with the window's geometry.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Chosen theme.
    pub theme: egui::ThemePreference,
    /// Scene files, newest first.
    pub recent: Vec<PathBuf>,
    /// Whether the left column (scene) is shown.
    pub scene_column: bool,
    /// Whether the right column (method) is shown.
    pub method_column: bool,
    /// Whether phase function lobes have a logarithmic radius.
    pub log_lobe: bool,
    /// Depth of the slice of the majorant's cells over the views, from 0 (near) to 1 (far); hidden if absent.
    pub majorant_slice: Option<f32>,
    /// Whether the dock is shown below several views.
    pub dock: bool,
    /// Whether the dock is shown below a single view.
    pub dock_alone: bool,
    /// Id of the open tab of the dock.
    pub tab: String,
    /// Number of completed steps of each lesson, by its id.
    pub lessons: BTreeMap<String, usize>,
    /// Whether text is large, for projectors.
    pub large_type: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            theme: egui::ThemePreference::Dark,
            recent: Vec::new(),
            scene_column: true,
            method_column: true,
            log_lobe: false,
            majorant_slice: None,
            dock: true,
            dock_alone: false,
            tab: "ranking".into(),
            lessons: BTreeMap::new(),
            large_type: false,
        }
    }
}

impl Settings {
    /// Key in eframe's storage.
    pub const KEY: &'static str = "majorant-settings";
    const RECENT: usize = 10;

    /// Zoom factor of the interface: 1, or 1.4 with large text.
    #[must_use]
    pub fn zoom_factor(&self) -> f32 {
        if self.large_type { 1.4 } else { 1.0 }
    }

    /// Moves a file to the head of the recent files.
    pub fn remember(&mut self, path: &Path) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(Self::RECENT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recent_files_are_few_and_distinct() {
        let mut settings = Settings::default();
        for i in 0..20 {
            settings.remember(Path::new(&format!("{i}.toml")));
        }
        settings.remember(Path::new("15.toml"));
        assert_eq!(settings.recent.len(), 10);
        assert_eq!(settings.recent[0], Path::new("15.toml"));
        assert_eq!(settings.recent.iter().filter(|p| p.ends_with("15.toml")).count(), 1);
    }
}
