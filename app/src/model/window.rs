//! Display state of the window that is saved with a scene, under `[window]`.

use majorant_core::scene::SceneDoc;
use serde::{Deserialize, Serialize};

/// Display state of the views.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WindowDoc {
    /// Arrangement of the views.
    pub arrangement: Arrangement,
    /// Two views of a wipe, a difference or a z-map.
    pub pair: Pair,
    /// Displayed layer of every view: `picture`, or the id of a map.
    pub layer: Layer,
    /// Whether every view has a separate zoom.
    pub own_zoom: bool,
}

impl WindowDoc {
    /// Reads the state from a scene document.
    ///
    /// # Errors
    /// When a key is unknown or its value has the wrong type.
    pub fn read(doc: &SceneDoc) -> Result<Self, String> {
        let table = toml::Value::Table(doc.window.clone());
        table.try_into().map_err(|error: toml::de::Error| format!("[window]: {}", error.message()))
    }

    /// Returns the state of an opened document, or the defaults if it cannot be read.
    #[must_use]
    pub fn of(doc: &SceneDoc) -> Self {
        Self::read(doc).unwrap_or_default()
    }

    /// Changes the state in a document; values equal to their defaults are not stored.
    pub fn edit(doc: &mut SceneDoc, change: impl FnOnce(&mut Self)) {
        let mut window = Self::of(doc);
        change(&mut window);
        let table = |window: &Self| match toml::Value::try_from(window) {
            Ok(toml::Value::Table(table)) => table,
            _ => toml::Table::new(),
        };
        let usual = table(&Self::default());
        doc.window =
            table(&window).into_iter().filter(|(key, value)| usual.get(key) != Some(value)).collect();
    }
}

/// Two different views, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pair(pub usize, pub usize);

impl Default for Pair {
    fn default() -> Self {
        Self(0, 1)
    }
}

/// Id of the displayed layer of a view.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Layer(pub String);

impl Layer {
    /// Id of the rendered image.
    pub const PICTURE: &'static str = "picture";
}

impl Default for Layer {
    fn default() -> Self {
        Self(Self::PICTURE.into())
    }
}

/// Arrangement of the views in the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arrangement {
    /// Side by side.
    #[default]
    Grid,
    /// Two views over each other, with a divider.
    Wipe,
    /// One view at a time.
    Flip,
    /// Difference of two views.
    Difference,
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::io::scene_file;
    use majorant_core::scene::keys;

    #[test]
    fn keys_of_earlier_files_are_read_and_written_under_window() {
        let compare = "compare = { arrangement = \"wipe\", pair = [1, 0], layer = \"z\", own_zoom = true }";
        let earlier = scene_file::parse(&format!("majorant = 1\n{compare}"), "earlier").unwrap();
        let expected = WindowDoc {
            arrangement: Arrangement::Wipe,
            pair: Pair(1, 0),
            layer: Layer("z".into()),
            own_zoom: true,
        };
        assert_eq!(WindowDoc::read(&earlier), Ok(expected));
        let text = scene_file::to_toml(&earlier);
        assert!(text.contains("[window]") && !text.contains("[compare]"), "{text}");
        assert_eq!(scene_file::parse(&text, "again").unwrap(), earlier);
        let set = ["compare.layer=\"variance\"".to_owned(), "window.own_zoom=false".to_owned()];
        let window = WindowDoc::of(&scene_file::override_keys(&earlier, &set).unwrap());
        assert_eq!((window.layer.0.as_str(), window.own_zoom), ("variance", false));
    }

    #[test]
    fn every_key_is_in_the_table_of_keys_with_its_default() {
        let toml::Value::Table(all) = toml::Value::try_from(WindowDoc::default()).unwrap() else { panic!() };
        let listed = keys::all().iter().filter_map(|key| Some((key.path.strip_prefix("window.")?, key)));
        let listed: Vec<_> = listed.collect();
        assert_eq!(listed.len(), all.len());
        for (name, key) in listed {
            assert_eq!(key.default_value().as_ref(), all.get(name), "{name}");
        }
    }

    #[test]
    fn an_edit_stores_what_differs_from_the_default() {
        let mut doc = SceneDoc::default();
        WindowDoc::edit(&mut doc, |window| window.pair = Pair(2, 1));
        assert_eq!(doc.window.keys().collect::<Vec<_>>(), ["pair"]);
        WindowDoc::edit(&mut doc, |window| window.pair = Pair::default());
        assert!(doc.window.is_empty());
    }

    #[test]
    fn an_unknown_key_is_named() {
        let doc = scene_file::parse("majorant = 1\n[window]\narangement = \"grid\"", "typo").unwrap();
        assert!(WindowDoc::read(&doc).unwrap_err().contains("arangement"));
    }
}
