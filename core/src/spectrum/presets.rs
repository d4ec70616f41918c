//! Spectra to start from, for extinction, albedo and light alike. One line adds one.

/// A named spectrum.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// How a scene file names it.
    pub id: &'static str,
    /// One line for people.
    pub summary: &'static str,
    /// Control points, `nm:value`.
    pub points: &'static str,
}

/// Every preset, in the order that pickers show.
pub const PRESETS: &[Preset] = &[
    Preset {
        id: "report-plume",
        summary: "strong green extinction, the smoke of the report's figure 2",
        points: "430:8, 540:40, 572:8",
    },
    Preset { id: "grey", summary: "the same at every wavelength", points: "360:1, 830:1" },
    Preset {
        id: "rayleigh",
        summary: "molecules: falls with the fourth power of the wavelength, 1 at 550 nm",
        points: "360:5.448, 400:3.574, 440:2.441, 480:1.724, 520:1.251, 550:1, 600:0.706, 660:0.482, 720:0.341, 780:0.247, 830:0.193",
    },
];

/// The preset with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|p| p.id == id)
}

/// Every id, for messages.
#[must_use]
pub fn ids() -> Vec<&'static str> {
    PRESETS.iter().map(|p| p.id).collect()
}
