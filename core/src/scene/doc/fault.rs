//! Mistakes that real renderers have made, to be planted on purpose in Uni+NEE MIS.

use serde::{Deserialize, Serialize};

/// A planted mistake; each biases the image, or breaks it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// None.
    #[default]
    None,
    /// p_uni takes the hero's probability of an event for every component.
    HeroProbability,
    /// The probability of surviving roulette is left out of p_nee.
    RouletteOnOneTechnique,
    /// An event is taken as null where its density is zero, and divides by that.
    NullByRounding,
    /// p_nee has the phase function's density besides the light's.
    PhaseInBoth,
    /// A flight ends after so many null collisions.
    NullCap,
}

/// A mistake as people meet it.
#[derive(Clone, Copy, Debug)]
pub struct FaultEntry {
    /// Name for people.
    pub name: &'static str,
    /// What is wrong, and where it shows.
    pub summary: &'static str,
    /// Where it was made, and put right.
    pub thread: &'static str,
}

impl Fault {
    /// Every mistake, in the order that lists show.
    pub const ALL: [Self; 5] = [
        Self::HeroProbability,
        Self::RouletteOnOneTechnique,
        Self::NullByRounding,
        Self::PhaseInBoth,
        Self::NullCap,
    ];

    /// How people meet it; `None` where nothing is wrong.
    #[must_use]
    pub const fn entry(self) -> Option<FaultEntry> {
        let (name, summary, thread) = match self {
            Self::None => return None,
            Self::HeroProbability => (
                "One event probability for all channels",
                "The weights take the probability with which the hero drew an event as that of every channel. \
                 Where it cancels nothing is lost but the combination; wrong where one hero never draws what \
                 another would: absorption as an event, and a channel that only absorbs.",
                "mitsuba3 #1387, put right by #1628 in 2025",
            ),
            Self::RouletteOnOneTechnique => (
                "Roulette in one technique only",
                "Surviving roulette enters the unidirectional density and not that of the connections, so that \
                 the weights no longer sum to one. Wrong where paths are long enough for roulette.",
                "mitsuba3's volpathmis",
            ),
            Self::NullByRounding => (
                "A null collision where there is none",
                "Rounding draws a null collision of density zero, and what follows is divided by that: not a \
                 number. There once in ten million collisions, here once in five hundred.",
                "pbrt-v4 #172, #179 and #196",
            ),
            Self::PhaseInBoth => (
                "Algorithm 4 as printed",
                "The density of the phase function multiplies both techniques. It belongs to the unidirectional \
                 one; a connection's direction is drawn by the light.",
                "the report's algorithm 4, lines 14 and 19",
            ),
            Self::NullCap => (
                "A cap on null collisions",
                "A flight ends in the dark after eight null collisions, where a renderer might allow a \
                 thousand. Wrong where the majorant is loose.",
                "lajolla's max_null_collisions",
            ),
        };
        Some(FaultEntry { name, summary, thread })
    }
}
