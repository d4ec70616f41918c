//! Questions of the study.

/// A claim or open problem of the report, with the corresponding questions.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// Heading.
    pub heading: &'static str,
    /// Questions of the topic.
    pub questions: &'static [Question],
}

/// A comparison of two variants.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Id in machine-readable tables.
    pub id: &'static str,
    /// Variant under test.
    pub variant: &'static str,
    /// Variant that it is compared with.
    pub against: &'static str,
    /// Criterion of the comparison.
    pub criterion: Criterion,
}

/// Criterion by which two variants are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// 1/(relMSE · CPU seconds), which measures the time to reach an error.
    Efficiency,
    /// Paths per CPU second: for variants whose paths have the same variance. It is then equivalent to
    /// efficiency and known much more accurately.
    Pace,
}

impl Criterion {
    /// Name of the unit.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Efficiency => "efficiency",
            Self::Pace => "paths per second",
        }
    }
}

const fn efficiency(id: &'static str, variant: &'static str, against: &'static str) -> Question {
    Question { id, variant, against, criterion: Criterion::Efficiency }
}

const fn pace(id: &'static str, variant: &'static str, against: &'static str) -> Question {
    Question { id, variant, against, criterion: Criterion::Pace }
}

/// All topics; the first question of the first topic is the closing question of the report.
pub static TOPICS: &[Topic] = &[
    Topic {
        heading: "New and old integrator",
        questions: &[
            efficiency("null-scattering", "uni-nee-mis", "mitsuba2-volpath"),
            efficiency("null-scattering-as-reported", "uni-nee-mis-analogue", "mitsuba2-volpath"),
            pace("null-scattering-pace", "uni-nee-mis", "mitsuba2-volpath"),
        ],
    },
    Topic {
        heading: "Cost of tracking densities",
        questions: &[
            pace("books-apart-f32", "uni-nee-mis-apart-f32", "uni-nee-mis"),
            pace("books-apart-f64", "uni-nee-mis-apart-f64", "uni-nee-mis"),
            pace("books-pairwise", "uni-nee-mis-pairwise", "uni-nee-mis"),
        ],
    },
    Topic {
        heading: "Noise of absorption",
        questions: &[
            efficiency("absorption", "uni-nee-mis-analogue", "uni-nee-mis"),
            efficiency("absorption-unidirectional", "spectral-mis-analogue", "spectral-mis"),
        ],
    },
    Topic {
        heading: "Benefit of combining techniques",
        questions: &[
            efficiency("over-unidirectional", "uni-nee-mis", "spectral-mis"),
            efficiency("over-nee", "uni-nee-mis", "nee"),
            efficiency("colour", "spectral-mis", "independent"),
        ],
    },
];

/// All questions.
pub fn questions() -> impl Iterator<Item = &'static Question> {
    TOPICS.iter().flat_map(|topic| topic.questions)
}
