//! What the page's template is filled with: every number as text.

use crate::compare::curve::Axis;
use crate::compare::maps::{Map, Range};
use crate::compare::report::gather::{Gathered, Shown};
use crate::compare::report::{Formats, pictures, plot, reproduce, words};
use crate::compare::{Standing, Verdict};
use crate::io::scene_file;
use crate::measure::{self, MEASURES};
use crate::scene::{Absorption, Fairness, MajorantDoc, Mode, WhenExceeded};
use base64::Engine;
use serde::Serialize;

/// The whole page.
#[derive(Serialize)]
pub(super) struct Context {
    title: String,
    note: String,
    version: &'static str,
    size: String,
    against: String,
    fairness: &'static str,
    /// What every view had, if all had the same.
    budget: Option<String>,
    /// Pictures side by side, at most.
    columns: usize,
    threads: usize,
    region: Option<String>,
    summary: String,
    /// The measure that the comparison is about, unless the table has it anyway.
    other_measure: Option<&'static str>,
    ranking: Vec<Line>,
    layers: Vec<Layer>,
    plots: Vec<plot::Plot>,
    measure: &'static str,
    settings: Vec<Setting>,
    measures: Vec<Definition>,
    maps: Vec<Definition>,
    notes: Vec<String>,
    command: Option<String>,
    scene: String,
}

/// A line of the ranking.
#[derive(Serialize)]
struct Line {
    label: String,
    name: String,
    estimator: String,
    colour: String,
    spp: u32,
    seconds: String,
    lookups: String,
    relmse: String,
    measure: String,
    variance: String,
    chroma: String,
    efficiency: String,
    speedup: String,
    interval: Option<String>,
    verdict: String,
    /// `agrees`, `biased` or `undecided`.
    kind: String,
}

/// What of every view is shown at once.
#[derive(Serialize)]
struct Layer {
    id: String,
    name: String,
    formula: String,
    legend: Option<Legend>,
    images: Vec<Picture>,
}

#[derive(Serialize)]
struct Picture {
    /// A, B, C, … or R.
    view: String,
    name: String,
    alt: String,
    png: String,
    width: usize,
    height: usize,
}

/// A bar of colours with its numbers.
#[derive(Serialize)]
struct Legend {
    /// Colours in steps of equal width.
    gradient: String,
    ticks: Vec<Tick>,
}

#[derive(Serialize)]
struct Tick {
    percent: String,
    text: String,
}

/// What a view is made with.
#[derive(Serialize)]
struct Setting {
    label: String,
    name: String,
    mode: &'static str,
    absorption: &'static str,
    depth: String,
    roulette: String,
    majorant: String,
    seed: u64,
    spp: u32,
    against: String,
    command: Option<String>,
}

#[derive(Serialize)]
struct Definition {
    name: &'static str,
    formula: &'static str,
}

impl Context {
    pub fn of(gathered: &Gathered<'_>, what: &Formats) -> Result<Self, String> {
        let doc = &gathered.experiment.doc;
        let first = gathered.views.first().map(|v| &v.view.snapshot);
        let other_measure = (gathered.measure.id != "relmse").then_some(gathered.measure.name);
        Ok(Self {
            title: doc.title.clone(),
            note: doc.note.clone(),
            version: env!("CARGO_PKG_VERSION"),
            size: first.map_or_else(String::new, |s| format!("{} × {}", s.width, s.height)),
            against: gathered.held_against(),
            fairness: match doc.compare.fairness {
                Fairness::Time => "CPU seconds of path tracing",
                Fairness::Samples => "samples per pixel",
                Fairness::Lookups => "look-ups of the medium",
            },
            budget: budget(gathered),
            columns: columns(gathered.views.len() + usize::from(gathered.reference().is_some())),
            threads: first.map_or(0, |s| s.threads),
            region: doc.compare.region.map(|[x0, y0, x1, y1]| {
                format!("columns {x0} to {} and rows {y0} to {}", x1.saturating_sub(1), y1.saturating_sub(1))
            }),
            summary: summary(&gathered.standings),
            other_measure,
            ranking: ranking(gathered),
            layers: layers(gathered)?,
            plots: [Axis::Samples, Axis::Seconds]
                .into_iter()
                .filter_map(|a| plot::plot(gathered, a))
                .collect(),
            measure: gathered.measure.name,
            settings: gathered.views.iter().zip(&gathered.standings).map(|v| setting(gathered, v)).collect(),
            measures: measures(gathered),
            maps: gathered
                .maps
                .iter()
                .map(|(m, _)| Definition { name: m.name, formula: m.formula })
                .collect(),
            notes: what.notes.clone(),
            command: what.command.clone(),
            scene: scene_file::to_toml(doc),
        })
    }
}

fn budget(gathered: &Gathered<'_>) -> Option<String> {
    let first = gathered.standings.first()?;
    if gathered.standings.iter().all(|s| s.spp == first.spp) {
        return Some(format!("{} samples per pixel", first.spp));
    }
    gathered.experiment.doc.render.cpu_seconds.map(|s| format!("{} CPU seconds", words::tick(s.into())))
}

/// As few rows as leave the pictures large enough, and none of a single picture.
fn columns(pictures: usize) -> usize {
    match pictures {
        0 => 1,
        1..=4 => pictures,
        5 | 6 => 3,
        _ => 4,
    }
}

/// What came of it in a sentence or two.
fn summary(standings: &[Standing]) -> String {
    let those = |verdict: Verdict| standings.iter().filter(move |s| s.verdict() == verdict);
    let labels = |verdict| those(verdict).map(|s| s.label.as_str()).collect::<Vec<_>>().join(", ");
    // What is too noisy to tell may have missed its brightest paths, and with them most of its variance.
    let mut sure: Vec<&Standing> = those(Verdict::Agrees).collect();
    sure.sort_by(|a, b| b.efficiency.total_cmp(&a.efficiency));
    let mut sentences = Vec::new();
    match sure[..] {
        [best, next, ..] => sentences.push(format!(
            "{} (view {}) is the most efficient, {} times as efficient as the next, {} ({}).",
            best.name,
            best.label,
            words::times(best.efficiency / next.efficiency),
            next.name,
            next.label
        )),
        [only] => {
            sentences.push(format!("Of {} (view {}) alone it is sure that it agrees.", only.name, only.label))
        }
        [] => {}
    }
    for (verdict, text) in
        [(Verdict::Undecided, "Not decided:"), (Verdict::Differs, "Biased, and therefore ranked last:")]
    {
        let labels = labels(verdict);
        if !labels.is_empty() {
            sentences.push(format!("{text} {labels}."));
        }
    }
    sentences.join(" ")
}

/// The most efficient first, the biased last.
fn ranking(gathered: &Gathered<'_>) -> Vec<Line> {
    let mut order: Vec<(usize, &Standing)> = gathered.standings.iter().enumerate().collect();
    order.sort_by(|(_, a), (_, b)| {
        let biased = |s: &Standing| s.verdict() == Verdict::Differs;
        biased(a).cmp(&biased(b)).then(b.efficiency.total_cmp(&a.efficiency))
    });
    order
        .into_iter()
        .map(|(place, s)| Line {
            label: s.label.clone(),
            name: s.name.clone(),
            estimator: s.estimator.clone(),
            colour: plot::css_colour(place),
            spp: s.spp,
            seconds: words::number(s.cpu_seconds),
            lookups: words::number(s.lookups_per_path),
            relmse: error(s, "relmse"),
            measure: error(s, gathered.measure.id),
            variance: words::number(s.variance),
            chroma: words::percent(s.chroma_variance / s.variance),
            efficiency: words::number(s.efficiency),
            speedup: words::speedup(s),
            interval: words::interval(s),
            verdict: words::verdict(s),
            kind: s.verdict().to_string(),
        })
        .collect()
}

fn error(standing: &Standing, id: &str) -> String {
    standing.error(id).map_or_else(|| "–".into(), |m| words::quantity(m.corrected(), m.error))
}

fn layers(gathered: &Gathered<'_>) -> Result<Vec<Layer>, String> {
    let mut pictures = Vec::new();
    for (shown, standing) in gathered.views.iter().zip(&gathered.standings) {
        let alt =
            format!("The scene as {} has rendered it, {} samples per pixel", standing.name, standing.spp);
        pictures.push(picture(shown, standing, alt, pictures::picture(shown)?));
    }
    if let (Some(reference), Some(png)) = (gathered.reference(), pictures::reference(gathered)) {
        pictures.push(Picture {
            view: "R".into(),
            name: "Reference".into(),
            alt: format!("The reference: {}", reference.origin),
            png: base64(&png?),
            width: reference.width,
            height: reference.height,
        });
    }
    let formula = "as the scene is shown".into();
    let mut layers =
        vec![Layer { id: "picture".into(), name: "Picture".into(), formula, legend: None, images: pictures }];
    for (map, range) in &gathered.maps {
        layers.push(map_layer(gathered, map, range)?);
    }
    Ok(layers)
}

fn map_layer(gathered: &Gathered<'_>, map: &Map, range: &Range) -> Result<Layer, String> {
    let mut images = Vec::new();
    for (shown, standing) in gathered.views.iter().zip(&gathered.standings) {
        if let Some(png) = pictures::painted(shown, map, range) {
            let alt = format!("Map of {}, {}: {}", standing.name, map.name, map.formula);
            images.push(picture(shown, standing, alt, png?));
        }
    }
    let (id, name, formula) = (map.id.to_owned(), map.name.to_owned(), map.formula.to_owned());
    Ok(Layer { id, name, formula, legend: Some(legend(range)), images })
}

fn picture(shown: &Shown<'_>, standing: &Standing, alt: String, png: Vec<u8>) -> Picture {
    Picture {
        view: standing.label.clone(),
        name: standing.name.clone(),
        alt,
        png: base64(&png),
        width: shown.view.snapshot.width,
        height: shown.view.snapshot.height,
    }
}

fn base64(bytes: &[u8]) -> String {
    base64::engine::general_purpose::STANDARD.encode(bytes)
}

/// Steps of the gradient.
const STEPS: u8 = 32;

fn legend(range: &Range) -> Legend {
    let stops = (0..=STEPS).map(|i| {
        let [r, g, b] = range.colour(f32::from(i) / f32::from(STEPS));
        format!("#{r:02x}{g:02x}{b:02x}")
    });
    let at = [0.0, 0.25, 0.5, 0.75, 1.0];
    let tick = |position: &f32| Tick {
        percent: format!("{:.0}", 100.0 * position),
        text: words::tick(f64::from(range.value(*position))),
    };
    Legend { gradient: stops.collect::<Vec<_>>().join(", "), ticks: at.iter().map(tick).collect() }
}

fn setting(gathered: &Gathered<'_>, (shown, standing): (&Shown<'_>, &Standing)) -> Setting {
    let doc = &shown.view.doc;
    let estimator = &doc.estimator;
    Setting {
        label: standing.label.clone(),
        name: standing.name.clone(),
        mode: match estimator.mode {
            Mode::Spectral => "spectral",
            Mode::Rgb => "RGB",
        },
        absorption: match estimator.absorption {
            Absorption::Analogue => "analogue",
            Absorption::Weighted => "weighted",
        },
        depth: estimator.max_depth.map_or_else(|| "unlimited".into(), |d| d.to_string()),
        roulette: estimator.roulette_depth.map_or_else(|| "never".into(), |d| format!("after {d}")),
        majorant: majorant(&doc.medium.majorant),
        seed: doc.render.seed,
        spp: standing.spp,
        against: words::against(&standing.against),
        command: reproduce::command(shown, &gathered.experiment.doc),
    }
}

fn majorant(doc: &MajorantDoc) -> String {
    let mut text = format!("× {}", doc.factor);
    if doc.shared {
        text += ", shared by all components";
    }
    if doc.factor < 1.0 {
        text += match doc.when_exceeded {
            WhenExceeded::Clamp => ", clamped",
            WhenExceeded::Weighted => ", weighted where exceeded",
        };
    }
    text
}

/// The measures that the page shows.
fn measures(gathered: &Gathered<'_>) -> Vec<Definition> {
    let shown = ["relmse", gathered.measure.id];
    let shown = MEASURES.iter().filter(|m| shown.contains(&m.id));
    shown.map(|m: &measure::Measure| Definition { name: m.name, formula: m.formula }).collect()
}
