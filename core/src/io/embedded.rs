//! Scenes and volumes that are part of the program, found from any working directory.

/// A scene that is part of the program.
#[derive(Clone, Copy, Debug)]
pub struct EmbeddedScene {
    /// How it is asked for.
    pub name: &'static str,
    /// Its scene file.
    pub toml: &'static str,
}

/// A volume that is part of the program; scenes name it `embedded:NAME`.
#[derive(Clone, Copy, Debug)]
pub struct EmbeddedVolume {
    /// How it is asked for, without `embedded:`.
    pub name: &'static str,
    /// Its bytes.
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

/// Every embedded scene; the first opens by default.
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

/// Every embedded volume.
pub static VOLUMES: &[EmbeddedVolume] = &[
    EmbeddedVolume { name: "plume.vdb", bytes: include_bytes!("../../../assets/volumes/plume.vdb") },
    EmbeddedVolume { name: "cloud.vdb", bytes: include_bytes!("../../../assets/volumes/cloud.vdb") },
];

/// What a scene puts before the name of an embedded volume.
pub const PREFIX: &str = "embedded:";

impl EmbeddedScene {
    /// The scene's note, as one line.
    #[must_use]
    pub fn summary(&self) -> String {
        super::scene_file::parse(self.toml, self.name)
            .map(|doc| doc.note.split_whitespace().collect::<Vec<_>>().join(" "))
            .unwrap_or_default()
    }
}

/// The embedded scene with this name.
#[must_use]
pub fn find(name: &str) -> Option<&'static EmbeddedScene> {
    SCENES.iter().find(|s| s.name == name)
}

/// The bytes of `embedded:NAME`, if `file` is such a name and it exists.
#[must_use]
pub fn volume(file: &str) -> Option<&'static [u8]> {
    let name = file.strip_prefix(PREFIX)?;
    VOLUMES.iter().find(|v| v.name == name).map(|v| v.bytes)
}
