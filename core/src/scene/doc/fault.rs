//! Known bugs of other renderers, which can be injected into Uni+NEE MIS.

use serde::{Deserialize, Serialize};

/// Injected bug; each biases the image or corrupts it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// No bug.
    #[default]
    None,
    /// p_uni uses the hero's event probability for every component.
    HeroProbability,
    /// p_nee omits the survival probability of Russian roulette.
    RouletteOnOneTechnique,
    /// An event of density zero is treated as a null collision, and the weight is divided by zero.
    NullByRounding,
    /// p_nee includes the phase function's density besides the light's.
    PhaseInBoth,
    /// A free flight ends after a fixed number of null collisions.
    NullCap,
}

/// Description of a bug for users.
#[derive(Clone, Copy, Debug)]
pub struct FaultEntry {
    /// Display name.
    pub name: &'static str,
    /// Description of the error, and where it is visible.
    pub summary: &'static str,
    /// Renderer and issue in which it occurred and was fixed.
    pub thread: &'static str,
}

impl Fault {
    /// All bugs, in display order.
    pub const ALL: [Self; 5] = [
        Self::HeroProbability,
        Self::RouletteOnOneTechnique,
        Self::NullByRounding,
        Self::PhaseInBoth,
        Self::NullCap,
    ];

    /// Description for users; `None` for [`Self::None`].
    #[must_use]
    pub const fn entry(self) -> Option<FaultEntry> {
        let (name, summary, thread) = match self {
            Self::None => return None,
            Self::HeroProbability => (
                "One event probability for all channels",
                "The weights use the hero's event probability for every channel. Where the probability cancels, \
                 only the benefit of MIS is lost. The image is wrong where one hero never samples an event that \
                 another would: with absorption as an event, and with a channel that only absorbs.",
                "mitsuba3 #1387, fixed by #1628 in 2025",
            ),
            Self::RouletteOnOneTechnique => (
                "Roulette in one technique only",
                "The survival probability of Russian roulette enters the unidirectional density, but not that of \
                 the connections, so the MIS weights no longer sum to one. Wrong where paths are long enough for \
                 roulette.",
                "mitsuba3's volpathmis",
            ),
            Self::NullByRounding => (
                "A null collision of density zero",
                "Rounding selects a null collision of density zero, and the weight is divided by that density: NaN. \
                 In the original once in ten million collisions, here once in five hundred.",
                "pbrt-v4 #172, #179 and #196",
            ),
            Self::PhaseInBoth => (
                "Algorithm 4 as printed",
                "The density of the phase function multiplies both techniques. It belongs to the unidirectional \
                 technique only; the direction of a connection is sampled from the light.",
                "the report's algorithm 4, lines 14 and 19",
            ),
            Self::NullCap => (
                "A cap on null collisions",
                "A free flight ends with zero contribution after eight null collisions; a renderer might allow a \
                 thousand. Wrong where the majorant is loose.",
                "lajolla's max_null_collisions",
            ),
        };
        Some(FaultEntry { name, summary, thread })
    }
}
