//! Conclusions in sentences, derived from the numbers only.

use super::variant::name;
use super::{Answer, Criterion, Outcome, Question, SceneStudy, TOPICS, Topic};
use crate::compare::report::words;

/// Conclusions of the study: the answer to the closing question of the report, a paragraph per topic,
/// variants that did not run, and a caution. Empty without a study.
#[must_use]
pub fn conclusion(studies: &[SceneStudy]) -> Vec<String> {
    if studies.is_empty() {
        return Vec::new();
    }
    let mut paragraphs = vec![verdict(studies)];
    paragraphs.extend(TOPICS.iter().filter_map(|topic| paragraph(topic, studies)));
    paragraphs.extend(missing(studies));
    paragraphs.push(caution(studies));
    paragraphs
}

/// Answers of all scenes to a question.
struct Votes<'a> {
    all: Vec<(&'static str, &'a Answer)>,
}

impl<'a> Votes<'a> {
    /// Collects the answers; `None` if no scene has one.
    fn of(question: &Question, studies: &'a [SceneStudy]) -> Option<Self> {
        let all: Vec<_> = studies.iter().filter_map(|s| Some((s.scene, s.answer(question)?))).collect();
        (!all.is_empty()).then_some(Self { all })
    }

    fn which(&self, outcomes: &[Outcome]) -> Vec<String> {
        let found = self.all.iter().filter(|(_, answer)| outcomes.contains(&answer.outcome));
        found.map(|(scene, answer)| format!("{scene} {}", answer.ratio.as_ratio())).collect()
    }

    fn better(&self) -> Vec<String> {
        self.which(&[Outcome::Better])
    }

    fn worse(&self) -> Vec<String> {
        self.which(&[Outcome::Worse])
    }

    fn open(&self) -> Vec<String> {
        self.which(&[Outcome::Open, Outcome::HeavyTailed])
    }

    /// `better on 3, worse on 1 of 4 scenes`.
    fn counted(&self) -> String {
        let counts =
            [("better on", self.better()), ("worse on", self.worse()), ("not decided on", self.open())];
        let told = counts.iter().filter(|(_, scenes)| !scenes.is_empty());
        let parts: Vec<_> = told.map(|(word, scenes)| format!("{word} {}", scenes.len())).collect();
        let n = self.all.len();
        format!("{} of {n} scene{}", parts.join(", "), if n == 1 { "" } else { "s" })
    }

    /// Smallest and largest ratio with their scenes; a single ratio if they coincide.
    fn range(&self) -> String {
        let by_ratio = |a: &&(&str, &Answer), b: &&(&str, &Answer)| a.1.ratio.mean.total_cmp(&b.1.ratio.mean);
        let ends = [self.all.iter().min_by(by_ratio), self.all.iter().max_by(by_ratio)];
        let mut told: Vec<String> = ends
            .into_iter()
            .flatten()
            .map(|(scene, answer)| format!("{} ({scene})", words::times(answer.ratio.mean)))
            .collect();
        told.dedup();
        told.join(" to ")
    }
}

/// Answer to the closing question of the report.
fn verdict(studies: &[SceneStudy]) -> String {
    const QUESTION: &str = "Should the null-scattering formulation be the default?";
    let Some((question, votes)) =
        TOPICS.first().and_then(|t| t.questions.first()).and_then(|q| Some((q, Votes::of(q, studies)?)))
    else {
        return format!("{QUESTION} This stays open: the two integrators did not run on the same scene.");
    };
    let (better, worse, open) = (votes.better(), votes.worse(), votes.open());
    let answer = match (better.is_empty(), worse.is_empty(), open.is_empty()) {
        (false, true, true) => "Yes, on every scene.",
        (false, true, false) => "Yes: no scene shows a loss, though not every interval is conclusive.",
        (true, false, true) => "No: it costs efficiency on every scene.",
        (true, false, false) => {
            "Not for its efficiency: no scene shows a gain, though not every interval is conclusive."
        }
        (false, false, _) => "This depends on the scene: some gain and some lose.",
        (true, true, _) => {
            "These numbers do not decide it: their intervals contain 1; longer or more runs are needed."
        }
    };
    let told: Vec<String> =
        [("more efficient on", better), ("less efficient on", worse), ("undecided on", open)]
            .into_iter()
            .filter(|(_, scenes)| !scenes.is_empty())
            .map(|(word, scenes)| format!("{word} {}", scenes.join(", ")))
            .collect();
    format!(
        "{QUESTION} {answer} Relative to the efficiency of {}, {} is {}.",
        name(question.against),
        name(question.variant),
        told.join("; ")
    )
}

/// One sentence per question of a topic; `None` if none has an answer.
fn paragraph(topic: &Topic, studies: &[SceneStudy]) -> Option<String> {
    let sentence = |question: &Question| {
        let votes = Votes::of(question, studies)?;
        let what = match question.criterion {
            Criterion::Efficiency => "times the efficiency",
            Criterion::Pace => "times the paths per second",
        };
        Some(format!(
            "{} has {} {what} of {}: {}.",
            name(question.variant),
            votes.range(),
            name(question.against),
            votes.counted()
        ))
    };
    let mut sentences: Vec<String> = topic.questions.iter().filter_map(sentence).collect();
    sentences.extend(lost(topic, studies));
    (!sentences.is_empty()).then(|| format!("{}. {}", topic.heading, sentences.join(" ")))
}

/// Sentences about lost paths of the variants of a topic, with the scene that has most.
fn lost(topic: &Topic, studies: &[SceneStudy]) -> Vec<String> {
    let sentence = |question: &Question| {
        let row = |s: &SceneStudy| {
            let row = s.rows.iter().find(|row| row.estimator == question.variant)?;
            (row.lost > 0.0).then_some((s.scene, row.lost))
        };
        let (scene, most) = studies.iter().filter_map(row).max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(format!(
            "{} loses up to {} % of its paths ({scene}) to non-finite values, which biases it.",
            name(question.variant),
            words::number(100.0 * most)
        ))
    };
    topic.questions.iter().filter_map(sentence).collect()
}

/// Sentences about variants that did not run.
fn missing(studies: &[SceneStudy]) -> Vec<String> {
    let mut found: Vec<((&str, &str), Vec<&str>)> = Vec::new();
    for study in studies {
        for out in &study.left_out {
            let key = (out.variant, out.reason.as_str());
            match found.iter_mut().find(|(known, _)| *known == key) {
                Some((_, scenes)) => scenes.push(study.scene),
                None => found.push((key, vec![study.scene])),
            }
        }
    }
    let sentence = |((variant, reason), scenes): ((&str, &str), Vec<&str>)| {
        format!("{} did not run on {}: {reason}.", name(variant), scenes.join(", "))
    };
    found.into_iter().map(sentence).collect()
}

fn caution(studies: &[SceneStudy]) -> String {
    let intervals: usize = studies.iter().map(|s| s.answers.len()).sum();
    let rows = || studies.iter().flat_map(|s| &s.rows);
    let repeats = rows().map(|row| row.repeats).min().unwrap_or(0);
    let heavy = rows().filter(|row| row.heavy_tailed).count();
    let mut text = format!(
        "Efficiency is 1/(relMSE · CPU seconds). Each of the {intervals} intervals has 95 % confidence, from {repeats} runs per \
         variant: about {} miss the true ratio by chance. The scenes are those of the figures; other scenes may differ.",
        (0.05 * intervals as f64).ceil()
    );
    if heavy > 0 {
        text += &format!(" In {heavy} rows one run has most of the error: these intervals are too narrow.");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::answer::tests::row;
    use super::super::{LeftOut, questions};
    use super::*;
    use crate::bench::Row;

    const EVEN: [f64; 4] = [0.10, 0.11, 0.09, 0.10];

    /// A scene in which variants have these errors, in a common unit, and these numbers of paths.
    fn study(scene: &'static str, variants: &[(&str, f64, u64)]) -> SceneStudy {
        let rows: Vec<Row> = variants
            .iter()
            .map(|(id, factor, paths)| row(scene, id, &EVEN.map(|e| factor * e), *paths))
            .collect();
        let answers = questions().filter_map(|q| q.answer(&rows)).collect();
        SceneStudy { scene, about: "a scene", rows, left_out: Vec::new(), answers }
    }

    fn about(paragraphs: &[String], start: &str) -> String {
        let found = paragraphs.iter().find(|p| p.starts_with(start));
        found.unwrap_or_else(|| panic!("{start}: {paragraphs:?}")).clone()
    }

    #[test]
    fn the_answer_follows_the_intervals_in_both_directions() {
        let answer = |a: f64, b: f64| {
            let scene = |name, old| study(name, &[("uni-nee-mis", 1.0, 100), ("mitsuba2-volpath", old, 100)]);
            conclusion(&[scene("one", a), scene("two", b)]).swap_remove(0)
        };
        for (old, said) in [
            ([4.0, 3.0], "Yes, on every scene."),
            ([4.0, 1.0], "Yes: no scene shows a loss"),
            ([4.0, 0.25], "depends on the scene"),
            ([0.25, 0.25], "No: it costs efficiency"),
            ([0.25, 1.0], "Not for its efficiency"),
            ([1.0, 1.0], "do not decide"),
        ] {
            let text = answer(old[0], old[1]);
            assert!(text.contains(said), "{said}: {text}");
        }
        // The ratios are stated.
        let text = answer(4.0, 0.25);
        assert!(text.contains("Uni+NEE MIS is more efficient on one 4.00 ["), "{text}");
        assert!(text.contains("; less efficient on two 0.25 ["), "{text}");
    }

    #[test]
    fn topics_state_ranges_counts_and_losses() {
        let scene = |name, analogue: f64, paths| {
            let variants = [
                ("uni-nee-mis", 1.0, 100),
                ("uni-nee-mis-analogue", analogue, 100),
                ("uni-nee-mis-apart-f32", 1.0, paths),
            ];
            study(name, &variants)
        };
        let text = conclusion(&[scene("one", 2.0, 80), scene("two", 1.0, 200)]);
        let price = about(&text, "Cost of tracking densities");
        assert!(price.contains("f32 has 0.80 (one) to 2.00 (two) times the paths per second"), "{price}");
        assert!(price.contains("better on 1, worse on 1 of 2 scenes"), "{price}");
        // One path of 80 is a larger fraction than one of 200.
        assert!(price.contains("loses up to 1.25 % of its paths (one)"), "{price}");
        let noise = about(&text, "Noise of absorption");
        assert!(noise.contains("0.50 (one) to 1.00 (two) times the efficiency of Uni+NEE MIS"), "{noise}");
        assert!(noise.contains("worse on 1, not decided on 1 of 2 scenes"), "{noise}");
        assert!(!noise.contains("loses"), "{noise}");
    }

    #[test]
    fn variants_that_did_not_run_are_stated() {
        let mut one = study("one", &[("uni-nee-mis", 1.0, 100), ("nee", 2.0, 100)]);
        one.left_out.push(LeftOut { variant: "mitsuba2-volpath", reason: "it is not there".into() });
        let text = conclusion(&[one]);
        assert!(text[0].contains("stays open"), "{}", text[0]);
        about(&text, "Mitsuba 2 volpath did not run on one: it is not there.");
        let buys = about(&text, "Benefit of combining techniques");
        assert!(
            buys.contains("has 2.00 (one) times the efficiency of NEE: better on 1 of 1 scene."),
            "{buys}"
        );
        assert!(
            text.last()
                .unwrap()
                .contains("Each of the 1 intervals has 95 % confidence, from 4 runs per variant")
        );
        assert!(conclusion(&[]).is_empty());
    }
}
