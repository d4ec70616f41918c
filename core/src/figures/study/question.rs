//! What is asked.

/// What the report leaves open, or claims, and the questions that it comes down to.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// As a heading.
    pub heading: &'static str,
    /// Its questions.
    pub questions: &'static [Question],
}

/// Whether one variant is better than another.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// How it is called in tables for scripts.
    pub id: &'static str,
    /// The variant that the question is about.
    pub variant: &'static str,
    /// What it is held against.
    pub against: &'static str,
    /// By what.
    pub yardstick: Criterion,
}

/// What two variants are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// 1/(relMSE · CPU seconds): how soon the same error is reached.
    Efficiency,
    /// Paths per CPU second: for variants whose paths are worth the same, where it is all there is and is known much
    /// better than an efficiency.
    Pace,
}

impl Criterion {
    /// As a unit.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Efficiency => "efficiency",
            Self::Pace => "paths per second",
        }
    }
}

const fn efficiency(id: &'static str, variant: &'static str, against: &'static str) -> Question {
    Question { id, variant, against, yardstick: Criterion::Efficiency }
}

const fn pace(id: &'static str, variant: &'static str, against: &'static str) -> Question {
    Question { id, variant, against, yardstick: Criterion::Pace }
}

/// Every topic; the first question of the first is the report's closing one.
pub static TOPICS: &[Topic] = &[
    Topic {
        heading: "New integrator against old",
        questions: &[
            efficiency("null-scattering", "uni-nee-mis", "mitsuba2-volpath"),
            efficiency("null-scattering-as-reported", "uni-nee-mis-analogue", "mitsuba2-volpath"),
            pace("null-scattering-pace", "uni-nee-mis", "mitsuba2-volpath"),
        ],
    },
    Topic {
        heading: "The price of tracking densities",
        questions: &[
            pace("books-apart-f32", "uni-nee-mis-apart-f32", "uni-nee-mis"),
            pace("books-apart-f64", "uni-nee-mis-apart-f64", "uni-nee-mis"),
            pace("books-pairwise", "uni-nee-mis-pairwise", "uni-nee-mis"),
        ],
    },
    Topic {
        heading: "The noise of absorption",
        questions: &[
            efficiency("absorption", "uni-nee-mis-analogue", "uni-nee-mis"),
            efficiency("absorption-unidirectional", "spectral-mis-analogue", "spectral-mis"),
        ],
    },
    Topic {
        heading: "What combining buys",
        questions: &[
            efficiency("over-unidirectional", "uni-nee-mis", "spectral-mis"),
            efficiency("over-nee", "uni-nee-mis", "nee"),
            efficiency("colour", "spectral-mis", "independent"),
        ],
    },
];

/// Every question.
pub fn questions() -> impl Iterator<Item = &'static Question> {
    TOPICS.iter().flat_map(|topic| topic.questions)
}
