//! Suggestions against noise: rules over measured shares of the variance.
//!
//! The shares are measured, the rules are empirical. Each suggestion states its evidence, and is a document
//! that can be rendered next to the current one for comparison.

use super::{Heaviest, Split, Strategies, StrategyPlan};
use crate::math::SamplerKind;
use crate::phase::Phase;
use crate::scene::{Absorption, DirectionSampling, LightSampling, LightSelection, Mode, SceneDoc};
use crate::spectrum::WavelengthSampling;
use crate::transport::CancelToken;

/// Share of each layer in the variance of one sample, in decreasing order.
#[derive(Clone, Debug, PartialEq)]
pub struct Shares {
    /// Property by which contributions are separated.
    pub split: Split,
    /// Names and shares of the layers; the shares sum to one.
    pub parts: Vec<(String, f64)>,
}

/// Measurements of the noise in a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Shares by every split.
    pub shares: Vec<Shares>,
    /// Share of the variance that is perpendicular to grey, if known.
    pub chroma: Option<f64>,
    /// Distribution of the variance over the samples.
    pub heaviest: Heaviest,
}

impl Evidence {
    /// Measures the samples of a plan by every split, and their weights; `None` if the variance is zero, or
    /// after cancellation.
    #[must_use]
    pub fn measure(plan: &StrategyPlan<'_>, chroma: Option<f64>, cancel: CancelToken<'_>) -> Option<Self> {
        let mut shares = Vec::new();
        for split in Strategies::render_all(plan, &Split::ALL, cancel)? {
            let of = split.variance_shares(|_, _| true)?;
            let mut parts: Vec<_> = split.layers.into_iter().map(|layer| layer.name).zip(of).collect();
            parts.sort_by(|a, b| b.1.total_cmp(&a.1));
            shares.push(Shares { split: split.split, parts });
        }
        Some(Self { shares, chroma, heaviest: Heaviest::measure(plan, cancel)? })
    }

    /// Share of a layer, by its name; zero if there is none.
    #[must_use]
    pub fn share(&self, split: Split, name: &str) -> f64 {
        let parts =
            self.shares.iter().filter(|shares| shares.split == split).flat_map(|shares| &shares.parts);
        parts.filter(|(known, _)| known == name).map(|(_, share)| share).sum()
    }
}

/// Suggested change.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// Evidence.
    pub because: String,
    /// Description of the change.
    pub change: &'static str,
    /// Document after the change.
    pub doc: SceneDoc,
}

/// Suggestions to reduce the noise of a document's image, the most likely first; empty if no rule applies.
#[must_use]
pub fn advise(doc: &SceneDoc, evidence: &Evidence) -> Vec<Advice> {
    let mut advice = Vec::new();
    let mut propose = |because: String, change: &'static str, edit: &dyn Fn(&mut SceneDoc)| {
        let mut changed = doc.clone();
        edit(&mut changed);
        if changed != *doc && crate::estimator::validate(&changed).is_empty() {
            advice.push(Advice { because, change, doc: changed });
        }
    };
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let estimator = &doc.estimator;
    let is = |id: &str| estimator.id == id;
    let walk = evidence.share(Split::Technique, "unidirectional");
    let connected = evidence.share(Split::Technique, "next-event");

    if let Some(chroma) = evidence.chroma.filter(|chroma| *chroma > 0.3) {
        let because = format!("{} of the variance is colour noise", percent(chroma));
        if is("independent") {
            propose(because, "Combine all components on each path: spectral MIS", &|doc| {
                "spectral-mis".clone_into(&mut doc.estimator.id);
            });
        } else if estimator.mode == Mode::Spectral && estimator.wavelengths == WavelengthSampling::Uniform {
            propose(because, "Sample wavelengths by the sensor's response", &|doc| {
                doc.estimator.wavelengths = WavelengthSampling::Sensor;
            });
        }
    }
    if estimator.absorption == Absorption::Analogue {
        let because = "absorption is sampled as an event that ends paths".to_owned();
        propose(because, "Multiply the weight by the albedo in place of sampling absorption", &|doc| {
            doc.estimator.absorption = Absorption::Weighted
        });
    }
    if walk > 0.6 && connected == 0.0 && !is("uni-nee-mis") {
        let because =
            format!("{} of the variance comes from walks that reach lights by chance", percent(walk));
        propose(because, "Connect to the lights as well: Uni+NEE MIS", &|doc| {
            "uni-nee-mis".clone_into(&mut doc.estimator.id);
        });
    }
    if connected > 0.6 && is("nee") {
        let because = format!("{} of the variance comes from connections", percent(connected));
        propose(because, "Combine connections with walks: Uni+NEE MIS", &|doc| {
            "uni-nee-mis".clone_into(&mut doc.estimator.id);
        });
    }
    if walk > 0.5 && connected > 0.0 && estimator.directions == DirectionSampling::Phase {
        let because = format!(
            "{} of the variance comes from walks that reach lights, despite connections",
            percent(walk)
        );
        propose(because, "Sample directions from the product of phase function and lights", &|doc| {
            doc.estimator.directions = DirectionSampling::Product;
            doc.estimator.light_sampling = LightSampling::Product;
        });
    }
    if connected > 0.5
        && estimator.directions == DirectionSampling::Phase
        && doc.enabled_media().any(|medium| Phase::new(&medium.phase).mean_cosine() > 0.7)
    {
        let because = format!(
            "{} of the variance comes from connections with strongly forward scattering",
            percent(connected)
        );
        propose(because, "Sample some directions towards the lights", &|doc| {
            doc.estimator.directions = DirectionSampling::TowardsLights;
        });
    }
    if connected > 0.5 && doc.lights.len() > 1 && estimator.lights == LightSelection::Uniform {
        let because = format!(
            "{} of the variance comes from connections to one of {} lights",
            percent(connected),
            doc.lights.len()
        );
        propose(because, "Select lights by their contribution", &|doc| {
            doc.estimator.lights = LightSelection::Contribution;
        });
    }
    let first: f64 = ["0", "1", "2"].iter().map(|order| evidence.share(Split::Order, order)).sum();
    if first > 0.6 && estimator.sampler == SamplerKind::Independent {
        let because = format!("{} of the variance is from the first two scattering orders", percent(first));
        propose(because, "Use a low-discrepancy sequence for the first decisions", &|doc| {
            doc.estimator.sampler = SamplerKind::Sobol;
        });
    }
    let tail = evidence.heaviest.held_by(1e-3);
    let heaviest = evidence.heaviest.named.first();
    if tail > 0.3
        && !is("equiangular-mis")
        && heaviest.is_some_and(|heavy| heavy.technique == "next-event" && heavy.order == "1")
    {
        let because = format!(
            "{} of the variance is in one sample of a thousand; the heaviest scattered once, near a light",
            percent(tail)
        );
        propose(because, "Add equiangular sampling of distances: equiangular MIS", &|doc| {
            "equiangular-mis".clone_into(&mut doc.estimator.id);
        });
    }
    let late = evidence.share(Split::Order, "8 and more");
    if late > 0.3 && estimator.roulette_depth.is_some_and(|depth| depth < 8) {
        let because = format!(
            "{} of the variance comes from eight or more scattering events, where roulette begins early",
            percent(late)
        );
        propose(because, "Begin Russian roulette later", &|doc| doc.estimator.roulette_depth = Some(32));
    }
    if doc.enabled_media().any(|medium| medium.majorant.factor < 1.0) {
        let because = "the extinction exceeds the majorant, and weights grow".to_owned();
        propose(because, "Raise the majorant to the bound of the extinction", &|doc| {
            for medium in &mut doc.media {
                medium.majorant.factor = medium.majorant.factor.max(1.0);
            }
        });
    }
    if is("mitsuba2-volpath") || is("spectral-tracking") {
        let because = "its paths have no densities that MIS could combine".to_owned();
        propose(because, "Combine techniques and components: Uni+NEE MIS", &|doc| {
            "uni-nee-mis".clone_into(&mut doc.estimator.id);
        });
    }
    advice
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evidence(technique: &[(&str, f64)], order: &[(&str, f64)], chroma: f64) -> Evidence {
        let named = |parts: &[(&str, f64)]| parts.iter().map(|(n, s)| ((*n).to_owned(), *s)).collect();
        let shares = vec![
            Shares { split: Split::Technique, parts: named(technique) },
            Shares { split: Split::Order, parts: named(order) },
        ];
        Evidence { shares, chroma: Some(chroma), heaviest: Heaviest::even(1000) }
    }

    fn changes(doc: &SceneDoc, evidence: &Evidence) -> Vec<&'static str> {
        let advice = advise(doc, evidence);
        assert!(advice.iter().all(|a| a.doc != *doc && crate::estimator::validate(&a.doc).is_empty()));
        advice.into_iter().map(|a| a.change).collect()
    }

    #[test]
    fn advice_follows_from_what_was_measured() {
        let mut doc = SceneDoc::default();
        let chance = evidence(&[("unidirectional", 1.0)], &[("8 and more", 0.9)], 0.9);
        doc.estimator.id = "independent".into();
        assert!(changes(&doc, &chance)[0].contains("spectral MIS"));
        doc.estimator.id = "spectral-mis".into();
        assert!(changes(&doc, &chance).iter().any(|c| c.contains("Connect to the lights")));
        doc.estimator.id = "uni-nee-mis".into();
        let quiet = evidence(&[("unidirectional", 0.4), ("next-event", 0.4)], &[("8 and more", 0.2)], 0.1);
        assert_eq!(changes(&doc, &quiet), [""; 0]);
        let beside_a_light = Heaviest::one(1000, "next-event", "1");
        let near = Evidence { heaviest: beside_a_light, ..quiet.clone() };
        assert!(changes(&doc, &near)[0].contains("equiangular"));
        doc.estimator.absorption = Absorption::Analogue;
        doc.medium_mut().majorant.factor = 0.5;
        let said = changes(&doc, &quiet);
        assert!(
            said.len() == 2 && said[0].contains("absorption") && said[1].contains("majorant"),
            "{said:?}"
        );
    }
}
