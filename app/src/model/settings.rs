//! What the window remembers between runs.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Preferences and recent files; stored by eframe beside the window's geometry.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// The chosen theme.
    pub theme: egui::ThemePreference,
    /// Scene files, newest first.
    pub recent: Vec<PathBuf>,
    /// Whether the left column (scene) is shown.
    pub scene_column: bool,
    /// Whether the right column (method) is shown.
    pub method_column: bool,
    /// Phase function lobes on a logarithmic radius.
    pub log_lobe: bool,
    /// The slice of the majorant's cells that is drawn over the pictures, 0 nearest to 1 farthest; none if absent.
    pub majorant_slice: Option<f32>,
    /// Whether numbers are shown below the pictures, once there are several.
    pub dock: bool,
    /// Whether they are shown below a single picture.
    pub dock_alone: bool,
    /// Which numbers.
    pub tab: String,
    /// How many steps of each lesson were taken, by its id.
    pub lessons: BTreeMap<String, usize>,
    /// Larger type, for projectors.
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
    /// Where eframe's storage keeps them.
    pub const KEY: &'static str = "majorant-settings";
    const RECENT: usize = 10;

    /// Points of the interface over those of the screen.
    #[must_use]
    pub fn zoom_factor(&self) -> f32 {
        if self.large_type { 1.4 } else { 1.0 }
    }

    /// Puts a file at the head of the recent ones.
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
