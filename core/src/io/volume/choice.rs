//! Choice of a grid in a file with several, by name or by role.

/// Physical quantity for which a scalar grid is read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum GridRole {
    /// Density of the medium.
    #[default]
    Density,
    /// Temperature for thermal emission of the medium.
    Temperature,
}

impl GridRole {
    /// Name of the quantity in messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::Temperature => "temperature",
        }
    }

    /// Scene key that names a grid of this role.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Density => "medium.density.grid",
            Self::Temperature => "medium.emission.temperature.grid",
        }
    }
}

/// A grid name, or a role for which the most suitable grid is chosen.
#[derive(Debug, Clone, Copy, Default)]
pub struct GridChoice<'a> {
    /// Name of the grid; `None` to choose by role.
    pub name: Option<&'a str>,
    /// Quantity for which the grid is read.
    pub role: GridRole,
}

/// Choice by name, or of the most suitable density.
impl<'a> From<Option<&'a str>> for GridChoice<'a> {
    fn from(name: Option<&'a str>) -> Self {
        Self { name, role: GridRole::Density }
    }
}

/// Suitability of a grid for a role, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Suitability {
    /// Exact name of the role.
    OwnName,
    /// Name of the role with different capitalisation.
    OwnNameAnyCase,
    /// Another common name of the quantity.
    CommonName,
    /// A name that contains a common name.
    Related,
    /// No name.
    Unnamed,
    /// A name without relation to the quantity.
    Unknown,
}

/// Suitability of a grid called `name` for a role; `None` if the name refers to another quantity.
pub(super) fn suitability(name: &str, role: GridRole) -> Option<Suitability> {
    let name = without_number(name);
    if name == role.name() {
        return Some(Suitability::OwnName);
    }
    let lower = name.to_lowercase();
    if lower == role.name() {
        return Some(Suitability::OwnNameAnyCase);
    }
    if lower.trim().is_empty() {
        return Some(Suitability::Unnamed);
    }
    let words = words(name);
    let (mine, other) = match role {
        GridRole::Density => (DENSITY, TEMPERATURE),
        GridRole::Temperature => (TEMPERATURE, DENSITY),
    };
    if OTHER.matches(&words) || other.matches(&words) {
        None
    } else if words.len() == 1 && mine.words.contains(&words[0].as_str()) {
        Some(Suitability::CommonName)
    } else if mine.matches(&words) {
        Some(Suitability::Related)
    } else {
        Some(Suitability::Unknown)
    }
}

/// Names of one quantity.
#[derive(Debug, Clone, Copy)]
struct Vocabulary {
    /// Whole words of a name, in lower case and without trailing numbers.
    words: &'static [&'static str],
    /// Substrings of the concatenated words, for names written without separators.
    parts: &'static [&'static str],
    /// Words that match only as the whole name.
    alone: &'static [&'static str],
}

/// Names of densities used by exporters.
const DENSITY: Vocabulary = Vocabulary {
    words: &[
        "density",
        "densities",
        "dens",
        "smoke",
        "fog",
        "soot",
        "cloud",
        "clouds",
        "mist",
        "haze",
        "steam",
        "vapor",
        "vapour",
        "dust",
        "ash",
        "extinction",
        "opacity",
        "rho",
    ],
    parts: &["density", "smoke", "cloud", "extinction"],
    alone: &[],
};

/// Names of temperatures and related quantities.
const TEMPERATURE: Vocabulary = Vocabulary {
    words: &[
        "temperature",
        "temperatures",
        "temp",
        "heat",
        "kelvin",
        "celsius",
        "flame",
        "flames",
        "fire",
        "blackbody",
    ],
    parts: &["temperature", "flame", "blackbody"],
    alone: &[],
};

/// Names of other quantities: motion, distances, colours, and auxiliary simulation data.
const OTHER: Vocabulary = Vocabulary {
    words: &[
        "velocity",
        "vel",
        "vx",
        "vy",
        "vz",
        "velx",
        "vely",
        "velz",
        "speed",
        "motion",
        "force",
        "vorticity",
        "curl",
        "div",
        "divergence",
        "pressure",
        "gradient",
        "grad",
        "normal",
        "normals",
        "advection",
        "sdf",
        "distance",
        "dist",
        "surface",
        "levelset",
        "ls",
        "phi",
        "collision",
        "collider",
        "obstacle",
        "boundary",
        "color",
        "colour",
        "cd",
        "rgb",
        "albedo",
        "emission",
        "shadow",
        "fuel",
        "burn",
        "react",
        "age",
        "rest",
        "uv",
        "id",
        "mask",
        "weight",
    ],
    parts: &["velocity", "vorticity", "divergence", "pressure", "levelset", "distance"],
    alone: &["v", "u", "w"],
};

impl Vocabulary {
    fn matches(&self, words: &[String]) -> bool {
        let joined = words.concat();
        self.alone.contains(&joined.as_str())
            || words.iter().any(|word| self.words.contains(&word.as_str()))
            || self.parts.iter().any(|part| joined.contains(part))
    }
}

/// Words of a name in lower case: `airTemperature_01` becomes air, temperature.
fn words(name: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut was_lower = false;
    for c in name.chars() {
        if !c.is_alphanumeric() || (c.is_uppercase() && was_lower) {
            words.push(std::mem::take(&mut word));
        }
        if c.is_alphanumeric() {
            word.extend(c.to_lowercase());
        }
        was_lower = c.is_lowercase();
    }
    words.push(word);
    words.iter().map(|word| unnumbered(word)).filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

/// Removes a trailing number: `temp2` becomes temp. A single letter with a digit, as in `v2`, is usually a
/// version and is kept.
fn unnumbered(word: &str) -> &str {
    let stem = word.trim_end_matches(|c: char| c.is_ascii_digit());
    if stem.chars().count() == 1 { word } else { stem }
}

/// Removes the number that distinguishes grids of the same name: `density[1]`.
fn without_number(name: &str) -> &str {
    let stem = name.strip_suffix(']').and_then(|open| open.rsplit_once('['));
    stem.filter(|(_, number)| number.chars().all(|c| c.is_ascii_digit())).map_or(name, |(stem, _)| stem)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Suitability::{CommonName, OwnName, OwnNameAnyCase, Related, Unknown, Unnamed};

    #[test]
    fn names_are_told_apart_by_quantity() {
        // Name, suitability as a density, suitability as a temperature.
        let table = [
            ("density", Some(OwnName), None),
            ("density[1]", Some(OwnName), None),
            ("Density", Some(OwnNameAnyCase), None),
            ("DENSITY", Some(OwnNameAnyCase), None),
            ("smoke", Some(CommonName), None),
            ("Fog", Some(CommonName), None),
            ("SOOT", Some(CommonName), None),
            ("Cloud2", Some(CommonName), None),
            ("voxel_fog_density", Some(Related), None),
            ("smokeDensity", Some(Related), None),
            ("smokedensity", Some(Related), None),
            ("smoke_v2", Some(Related), None),
            ("", Some(Unnamed), Some(Unnamed)),
            (" ", Some(Unnamed), Some(Unnamed)),
            ("[1]", Some(Unnamed), Some(Unnamed)),
            ("ls_vdb", None, None),
            ("grid", Some(Unknown), Some(Unknown)),
            ("volume[2]", Some(Unknown), Some(Unknown)),
            ("temperature", None, Some(OwnName)),
            ("Temperature", None, Some(OwnNameAnyCase)),
            ("temp", None, Some(CommonName)),
            ("temp2", None, Some(CommonName)),
            ("heat", None, Some(CommonName)),
            ("Flames", None, Some(CommonName)),
            ("airTemperature_01", None, Some(Related)),
            ("air temperature", None, Some(Related)),
            ("density_temperature", None, None),
            ("velocity", None, None),
            ("vel.x", None, None),
            ("v", None, None),
            ("V", None, None),
            ("densityVelocity", None, None),
            ("surface", None, None),
            ("levelset", None, None),
            ("Level_Set", None, None),
            ("sdf", None, None),
            ("fuel", None, None),
            ("Cd", None, None),
            ("pressure", None, None),
            ("sheath", Some(Unknown), Some(Unknown)),
            ("volatile", Some(Unknown), Some(Unknown)),
        ];
        for (name, density, temperature) in table {
            assert_eq!(suitability(name, GridRole::Density), density, "{name:?} as a density");
            assert_eq!(suitability(name, GridRole::Temperature), temperature, "{name:?} as a temperature");
        }
        assert!(OwnName < OwnNameAnyCase && CommonName < Related && Unnamed < Unknown);
    }
}
