//! Embedded scenes and volumes, available from any working directory.

/// An embedded scene.
#[derive(Clone, Copy, Debug)]
pub struct EmbeddedScene {
    /// Name by which it is opened.
    pub name: &'static str,
    /// Text of the scene file.
    pub toml: &'static str,
}

/// An embedded volume; scenes refer to it as `embedded:NAME`.
#[derive(Clone, Copy, Debug)]
pub struct EmbeddedVolume {
    /// Name without `embedded:`.
    pub name: &'static str,
    /// Bytes of the file.
    pub bytes: &'static [u8],
}

macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        &[$(EmbeddedScene {
            name: $name,
            toml: include_str!(concat!("../../../assets/scenes/", $name, ".toml")),
        }),*]
    };
}

/// All embedded scenes; the first one opens by default.
pub static SCENES: &[EmbeddedScene] = scenes![
    "first-light",
    "plume-spectral",
    "cloud-backlit",
    "cloud-sidelit",
    "homogeneous-absorption",
    "fire",
    "lantern",
    "furnace",
];

/// All embedded volumes.
pub static VOLUMES: &[EmbeddedVolume] = &[
    EmbeddedVolume { name: "plume.vdb", bytes: include_bytes!("../../../assets/volumes/plume.vdb") },
    EmbeddedVolume { name: "cloud.vdb", bytes: include_bytes!("../../../assets/volumes/cloud.vdb") },
];

/// Prefix of the names of embedded volumes in scenes.
pub const PREFIX: &str = "embedded:";

impl EmbeddedScene {
    /// Note of the scene on one line.
    #[must_use]
    pub fn summary(&self) -> String {
        super::scene_file::parse(self.toml, self.name)
            .map(|doc| doc.note.split_whitespace().collect::<Vec<_>>().join(" "))
            .unwrap_or_default()
    }
}

/// Embedded scene with the given name.
#[must_use]
pub fn find(name: &str) -> Option<&'static EmbeddedScene> {
    SCENES.iter().find(|s| s.name == name)
}

/// Bytes of `embedded:NAME`; `None` if `file` lacks the prefix or no such volume exists.
#[must_use]
pub fn volume(file: &str) -> Option<&'static [u8]> {
    let name = file.strip_prefix(PREFIX)?;
    VOLUMES.iter().find(|v| v.name == name).map(|v| v.bytes)
}
