//! Named spectra for extinction, albedo and light, one entry each.

/// Quantity that a preset describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// Relative extinction.
    Extinction,
    /// Albedo or reflectance, 0 to 1.
    Albedo,
    /// Radiance or irradiance.
    Light,
}

/// A named spectrum.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// Id in scene files.
    pub id: &'static str,
    /// Quantities that the preset is meaningful for.
    pub uses: &'static [Use],
    /// One-line description.
    pub summary: &'static str,
    /// Control points, `nm:value`.
    pub points: &'static str,
}

/// All presets, in display order.
pub const PRESETS: &[Preset] = &[
    Preset {
        id: "report-plume",
        uses: &[Use::Extinction],
        summary: "strong green extinction, the smoke of the report's figure 2",
        points: "430:8, 540:40, 572:8",
    },
    Preset {
        id: "grey",
        uses: &[Use::Extinction, Use::Albedo, Use::Light],
        summary: "constant over wavelength",
        points: "360:1, 830:1",
    },
    Preset {
        id: "rayleigh",
        uses: &[Use::Extinction],
        summary: "molecules: falls with the fourth power of the wavelength, 1 at 550 nm",
        points: "360:5.448, 400:3.574, 440:2.441, 480:1.724, 520:1.251, 550:1, 600:0.706, 660:0.482, 720:0.341, 780:0.247, 830:0.193",
    },
    Preset {
        id: "blue-smoke",
        uses: &[Use::Extinction],
        summary: "fine particles: falls with the wavelength to the power 2.5, 1 at 550 nm",
        points: "360:2.88, 400:2.22, 440:1.75, 480:1.41, 520:1.15, 550:1, 600:0.805, 660:0.634, 720:0.51, 830:0.357",
    },
    Preset {
        id: "whole-milk",
        uses: &[Use::Extinction],
        summary: "extinction of whole milk (reduced, use g = 0), 1 at 550 nm; Jensen et al. 2001, RGB read as 610, 550, 465 nm",
        points: "465:1.178, 550:1, 610:0.7941",
    },
    Preset {
        id: "skim-milk",
        uses: &[Use::Extinction],
        summary: "extinction of skim milk (reduced, use g = 0), 1 at 550 nm; Jensen et al. 2001, RGB read as 610, 550, 465 nm",
        points: "465:1.566, 550:1, 610:0.5738",
    },
    Preset {
        id: "whole-milk-albedo",
        uses: &[Use::Albedo],
        summary: "albedo of whole milk; Jensen et al. 2001",
        points: "465:0.9963, 550:0.99925, 610:0.99957",
    },
    Preset {
        id: "skim-milk-albedo",
        uses: &[Use::Albedo],
        summary: "albedo of skim milk; Jensen et al. 2001",
        points: "465:0.99258, 550:0.99796, 610:0.998",
    },
    Preset {
        id: "amber-albedo",
        uses: &[Use::Albedo],
        summary: "an invented albedo: brown smoke that turns amber where it is thick",
        points: "400:0.45, 450:0.58, 500:0.72, 550:0.84, 600:0.92, 650:0.96, 700:0.975",
    },
    Preset {
        id: "rose-albedo",
        uses: &[Use::Albedo],
        summary: "an invented albedo: absorbs some green, thick parts turn rose",
        points: "400:0.95, 450:0.93, 500:0.86, 540:0.8, 570:0.86, 600:0.97, 700:0.99",
    },
    Preset {
        id: "tungsten",
        uses: &[Use::Light],
        summary: "spectrum of an incandescent lamp (CIE illuminant A), 1 at 560 nm",
        points: "360:0.06145, 400:0.1471, 450:0.3309, 500:0.5986, 560:1, 620:1.436, 680:1.854, 750:2.27, 830:2.616",
    },
];

/// Returns the preset with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|p| p.id == id)
}

/// Returns the presets that are meaningful for a quantity.
pub fn suiting(use_: Use) -> impl Iterator<Item = &'static Preset> {
    PRESETS.iter().filter(move |p| p.uses.contains(&use_))
}

/// Ids of all presets, for messages.
#[must_use]
pub fn ids() -> Vec<&'static str> {
    PRESETS.iter().map(|p| p.id).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::SpectrumDoc;

    #[test]
    fn every_preset_is_a_spectrum_and_has_a_name_of_its_own() {
        for preset in PRESETS {
            let points = SpectrumDoc::parse_points(preset.points).unwrap();
            let bounded = preset.uses.contains(&Use::Albedo);
            assert!(!bounded || points.iter().all(|p| p.value <= 1.0), "{}", preset.id);
            assert_eq!(PRESETS.iter().filter(|p| p.id == preset.id).count(), 1);
        }
        for use_ in [Use::Extinction, Use::Albedo, Use::Light] {
            assert!(suiting(use_).count() > 1);
        }
    }
}
