//! Tests of path inspection.
//!
//! The ledger of a path reproduces its sample bit for bit, the path weights stored by the estimators agree
//! with the definitions of f and p, and the contributions to an image sum to the image.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use majorant_core::estimator::{Axis, PathIndex, REGISTRY, Settings};
use majorant_core::inspect::{
    Branch, Ledger, Product, Recording, Row, Split, Step, Strategies, StrategyPlan,
};
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::material::Metal;
use majorant_core::math::{Sampler, SamplerKind};
use majorant_core::scene::keys;
use majorant_core::scene::{
    Absorption, Bookkeeping, DistanceSampling, EmissionDoc, GridRef, IorDoc, LightWalk, MaterialDoc, Mode,
    ObjectDoc, Scene, SceneDoc, ShapeDoc, SurfaceEmissionDoc, WhenExceeded, build,
};
use majorant_core::session::ViewId;
use majorant_core::transport::{CancelToken, Note, Technique};
use majorant_tests::session::{Watched, job};

/// Scenes that cover every kind of event: chromatic and achromatic media, grids, surfaces, emission and an
/// exceeded majorant.
fn scenes() -> Vec<(String, SceneDoc)> {
    let mut scenes: Vec<_> = embedded::SCENES
        .iter()
        .map(|s| (s.name.to_owned(), scene_file::parse(s.toml, s.name).unwrap()))
        .collect();
    let plume = scenes.iter().find(|(name, _)| name.contains("plume")).unwrap().1.clone();
    let mut vary = |name: &str, change: &dyn Fn(&mut SceneDoc)| {
        let mut doc = plume.clone();
        change(&mut doc);
        scenes.push((name.to_owned(), doc));
    };
    vary("rgb, analogue, separate walks", &|doc| {
        doc.estimator.mode = Mode::Rgb;
        doc.estimator.absorption = Absorption::Analogue;
        doc.estimator.light_walk = LightWalk::Separate;
    });
    vary("exceeded", &|doc| {
        doc.medium_mut().majorant.factor = 0.6;
        doc.medium_mut().majorant.when_exceeded = WhenExceeded::Weighted;
        doc.estimator.roulette_depth = Some(2);
    });
    vary("emissive, decomposed", &|doc| {
        let grid = GridRef { file: "embedded:plume.vdb".into(), grid: Some("temperature".into()) };
        doc.medium_mut().emission = Some(EmissionDoc { temperature: Some(grid), kelvin: 1.3, scale: 20.0 });
        doc.estimator.distances = DistanceSampling::Decomposition;
        doc.estimator.bookkeeping = Bookkeeping::Pairwise;
    });
    let objects = |doc: &mut SceneDoc| {
        let at = |center: [f32; 3], radius: f32| ShapeDoc::Sphere { center, radius };
        let mut add = |shape, material, emission| {
            doc.objects.push(ObjectDoc { material, emission, ..ObjectDoc::new(shape) });
        };
        let ior = || IorDoc::Cauchy { cauchy: [1.4, 0.01] };
        let metal = MaterialDoc::Conductor { preset: Some(Metal::Gold), eta: None, k: None, roughness: 0.3 };
        add(at([0.4, 0.2, 0.4], 0.25), MaterialDoc::Dielectric { ior: ior(), roughness: 0.0 }, None);
        add(at([-0.3, 0.3, 0.5], 0.2), MaterialDoc::Dielectric { ior: ior(), roughness: 0.3 }, None);
        let size = [0.3, 0.5, 0.3];
        add(ShapeDoc::Box { center: [0.0, -0.3, 0.6], size, rotate_deg: [0.0, 30.0, 0.0] }, metal, None);
        let lamp = Some(SurfaceEmissionDoc::default());
        let tilt = [10.0, 0.0, 20.0];
        let lamp_box = ShapeDoc::Box { center: [0.5, 0.6, 0.3], size: [0.2; 3], rotate_deg: tilt };
        add(lamp_box, MaterialDoc::default(), lamp);
    };
    vary("glass, metal and a lamp, spectral", &objects);
    vary("glass, metal and a lamp, rgb", &|doc| {
        objects(doc);
        doc.estimator.mode = Mode::Rgb;
        doc.estimator.light_walk = LightWalk::Separate;
    });
    for (_, doc) in &mut scenes {
        (doc.film.width, doc.film.height) = (64, 48);
    }
    scenes
}

fn frozen(doc: &SceneDoc) -> Scene {
    build(doc, &mut Library::default()).unwrap()
}

/// Checks a thousand random paths per estimator and scene: the sample has the same bits with and without an
/// observer, the sum of the ledger equals the sample, and every contribution follows from the densities.
#[test]
fn ledger_reproduces_the_sample_bit_for_bit() {
    let (mut defined, mut entries, mut equiangular) = ([0u32; 16], 0u32, 0u32);
    for (name, doc) in scenes() {
        let scene = frozen(&doc);
        let settings = Settings::new(&doc.estimator, doc.render.seed);
        for (which, entry) in REGISTRY.iter().enumerate() {
            let mut random = Sampler::new(17, which as u64, 0);
            for _ in 0..1000 {
                let place = random.next_2d();
                let (x, y) = ((place.x * 64.0) as u32, (place.y * 48.0) as u32);
                let at = PathIndex { x, y, sample: u64::from((random.next_1d() * 64.0) as u32) };
                let alone = (entry.kernel)(&scene, &settings, at, CancelToken::NEVER.into());
                let recording = Recording::new(&scene, entry.kernel, &settings, at, CancelToken::NEVER);
                let bits = |rgb: [f32; 3]| rgb.map(f32::to_bits);
                let what = format!("{name}, {}, {at:?}", entry.id);
                assert_eq!(
                    bits(recording.estimate.rgb.to_array()),
                    bits(alone.rgb.to_array()),
                    "observed: {what}"
                );
                assert_eq!(recording.estimate.lookups, alone.lookups, "{what}");
                let ledger = Ledger::new(&recording);
                assert_eq!(bits(ledger.film.to_array()), bits(alone.rgb.to_array()), "film: {what}");
                assert_eq!(ledger.added().map(f32::to_bits), ledger.sum.map(f32::to_bits), "sum: {what}");
                for contribution in ledger.contributions() {
                    entries += 1;
                    let Some(by_definition) = contribution.by_definition else { continue };
                    defined[which] += 1;
                    equiangular += u32::from(contribution.technique == Technique::Equiangular);
                    let largest = contribution.value.iter().fold(0.0f32, |l, v| l.max(v.abs()));
                    for (value, defined) in contribution.value.iter().zip(by_definition) {
                        let tolerance = 2e-3 * value.abs() + 1e-5 * largest + 1e-30;
                        assert!((value - defined).abs() <= tolerance, "{what}: {contribution:?}");
                    }
                }
            }
        }
    }
    assert!(entries > 20_000, "{entries}");
    // The density of equiangular sampling is recorded for contributions of an equiangular vertex, not for
    // those of the other techniques.
    assert!(equiangular > 500, "{equiangular}");
    for (entry, defined) in REGISTRY.iter().zip(defined) {
        let has = entry.id != "mitsuba2-volpath";
        assert_eq!(defined > 1500, has, "{}: {defined}", entry.id);
    }
}

/// Path weight of component `i` at a row by the definitions of f and the densities, under the estimator's
/// name for it; `None` for a weight without a definition.
///
/// At a vertex just reached, p_nee is still the density of the segment that leads there, and so is its
/// divisor: `vertex` holds the factors of the vertex itself.
fn kept_by_definition(row: &Row, name: &str, i: usize, vertex: AtVertex) -> Option<f64> {
    // The hero's density under the technique that samples the branch.
    let made_with = match (row.branch, row.eq) {
        (Branch::Connection, _) => row.nee[0].ln(),
        (_, Some(eq)) => eq[0].ln(),
        _ => row.uni[0].ln(),
    };
    let by_contribution = |density: Product, f: Product| density.over(f.ln()) * f.over(f.ln()).signum();
    Some(match name {
        "f/P" => row.f[i].over(made_with),
        "p_uni/P" => row.uni[i].over(made_with),
        "p_nee/P" => row.nee[i].over(made_with - vertex.density),
        "f" => row.f[i].over(0.0),
        "p_uni" => row.uni[i].over(0.0),
        "p_nee" => row.nee[i].over(0.0),
        "p_uni/f1" => by_contribution(row.uni[i], row.f[0]),
        "p_nee/f1" => by_contribution(row.nee[i], row.f[0]) * vertex.contribution.exp(),
        "p_uni1/f" => by_contribution(row.uni[0], row.f[i]),
        // Throughput over density; free flights enter f as weights already divided by their density.
        "φ" => row.f[i].over(row.uni[0].ln()),
        _ => return None,
    })
}

/// Logarithms of a vertex's factors for the hero, which p_nee does not contain until a new direction is
/// sampled.
#[derive(Clone, Copy, Default)]
struct AtVertex {
    density: f64,
    contribution: f64,
}

impl AtVertex {
    fn of(row: &Row, note: &Note) -> Self {
        let ln = |x: f32| f64::from(x).ln();
        match (note, row.found) {
            (Note::EquiangularVertexSampled { density, found, .. }, _) => {
                Self { density: ln(*density), contribution: ln(found.scattering[0]) }
            }
            (Note::Drawn { .. }, Some(found)) => {
                Self { density: ln(found.scattering_density[0]), contribution: ln(found.scattering[0]) }
            }
            (Note::Surface { albedo, .. }, _) => Self { density: 0.0, contribution: ln(albedo[0]) },
            _ => Self::default(),
        }
    }
}

/// At every event of a thousand random paths per estimator and scene, the stored path weights equal their
/// definitions after that event: not before it, and not on another branch.
#[test]
fn stored_weights_match_their_definitions_after_every_event() {
    let mut scenes = scenes();
    let plume = scenes.iter().find(|(name, _)| name.contains("plume")).unwrap().1.clone();
    for bookkeeping in [Bookkeeping::ApartF32, Bookkeeping::ApartF64, Bookkeeping::Pairwise] {
        let mut doc = plume.clone();
        doc.estimator.bookkeeping = bookkeeping;
        doc.estimator.roulette_depth = Some(1);
        scenes.push((format!("{bookkeeping:?}"), doc));
    }
    let mut estimated = plume;
    estimated.estimator.transmittance = "residual-ratio".into();
    estimated.estimator.roulette_depth = Some(1);
    scenes.push(("transmittance estimated".into(), estimated));

    let mut checked = [0u32; 16];
    for (name, doc) in scenes {
        let scene = frozen(&doc);
        let settings = Settings::new(&doc.estimator, doc.render.seed);
        for (which, entry) in REGISTRY.iter().enumerate() {
            let throughput = entry.id == "mitsuba2-volpath";
            let mut random = Sampler::new(23, which as u64, 0);
            for _ in 0..1000 {
                let place = random.next_2d();
                let (x, y) = ((place.x * 64.0) as u32, (place.y * 48.0) as u32);
                let at = PathIndex { x, y, sample: u64::from((random.next_1d() * 64.0) as u32) };
                let recording = Recording::new(&scene, entry.kernel, &settings, at, CancelToken::NEVER);
                let ledger = Ledger::new(&recording);
                let count = ledger.carried.count();
                // Factors of scattering at the current vertex, on the path and on an equiangular branch.
                let (mut on_path, mut equiangular) = (AtVertex::default(), AtVertex::default());
                let mut turned = false;
                for (i, row) in ledger.rows.iter().enumerate() {
                    let what = format!("{name}, {}, {at:?}, row {i}: {row:?}", entry.id);
                    if row.branch == Branch::Path {
                        equiangular = AtVertex::default();
                    }
                    let note = &recording.notes[row.note];
                    match (row.branch, row.step, row.eq) {
                        (Branch::Path, Step::Direction(..), _) => on_path = AtVertex::default(),
                        (Branch::Path, Step::Scatter | Step::Reflect, _) => on_path = AtVertex::of(row, note),
                        (_, Step::Scatter, Some(_)) => equiangular = AtVertex::of(row, note),
                        (_, Step::Connect(..), Some(_)) => equiangular = AtVertex::default(),
                        _ => {}
                    }
                    turned |= row.branch == Branch::Path && matches!(row.step, Step::Direction(..));
                    let vertex = match row.branch {
                        Branch::Path => on_path,
                        Branch::Equiangular => equiangular,
                        _ => AtVertex::default(),
                    };
                    if throughput && row.branch != Branch::Path {
                        assert_eq!(row.kept, None, "{what}");
                        continue;
                    }
                    // A separate light walk ends at a scattering event: it adds no contribution and stores no
                    // weights.
                    if row.branch == Branch::LightWalk && row.step == Step::Scatter {
                        continue;
                    }
                    let kept = row.kept.unwrap_or_else(|| panic!("no weights stored: {what}"));
                    let on_a_flight = matches!(row.step, Step::Collision | Step::Null | Step::Absorb)
                        || !matches!(recording.notes[row.note], Note::Flight { .. })
                            && matches!(row.step, Step::Scatter | Step::Exit);
                    if throughput && on_a_flight {
                        continue;
                    }
                    for (number, values) in kept.names.iter().zip(&kept.values) {
                        // Before the first new direction no connection can sample the path; some estimators
                        // store zero for p_nee.
                        if number.contains("nee") && !turned && values.iter().all(|value| *value == 0.0) {
                            continue;
                        }
                        let expected: Vec<_> =
                            (0..count).filter_map(|c| kept_by_definition(row, number, c, vertex)).collect();
                        let largest = expected.iter().fold(0.0f64, |l, v| l.max(v.abs()));
                        for (value, expected) in values.iter().zip(expected) {
                            let (value, expected) = (f64::from(*value), expected);
                            // Values outside the range of single precision are not compared.
                            if !(1e-30..1e30).contains(&largest) || !largest.is_finite() {
                                continue;
                            }
                            checked[which] += 1;
                            let tolerance = 3e-3 * expected.abs() + 1e-5 * largest;
                            let off = (value - expected).abs();
                            assert!(off <= tolerance, "{number} is {value}, should be {expected}: {what}");
                        }
                    }
                }
            }
        }
    }
    for (entry, checked) in REGISTRY.iter().zip(checked) {
        assert!(checked > 20_000, "{}: {checked}", entry.id);
    }
}

/// Bits of the origin and direction of every ray that leaves a vertex of a path.
fn turns(recording: &Recording) -> Vec<[u32; 6]> {
    let turn = |note: &Note| match note {
        Note::Direction { ray, .. } | Note::Boundary { ray, .. } => {
            let [x, y, z] = ray.origin.to_array().map(f32::to_bits);
            let [a, b, c] = ray.direction.to_array().map(f32::to_bits);
            Some([x, y, z, a, b, c])
        }
        _ => None,
    };
    recording.notes.iter().filter_map(turn).collect()
}

/// Estimators whose hero draws the events trace the same path from the same random numbers, whichever
/// contributions they add: the vertices coincide bit for bit, also under different settings of connections
/// and weights.
#[test]
fn estimators_walk_the_same_path() {
    // Axes that affect the sampling of the walk; every other axis affects only connections and weights.
    let of_the_walk = [Axis::Absorption, Axis::Distances, Axis::Tracking, Axis::Fault];
    let (mut vertices, mut walks) = (0, 0);
    let names = ["plume", "cloud"];
    let docs = scenes().into_iter().filter(|(name, _)| names.iter().any(|part| name.contains(part)));
    let samplers = [SamplerKind::Independent, SamplerKind::Lattice, SamplerKind::Sobol];
    for ((name, mut doc), sampler) in docs.flat_map(|scene| samplers.map(|by| (scene.clone(), by))) {
        doc.estimator.sampler = sampler;
        doc.estimator.roulette_depth = None;
        doc.estimator.max_depth = Some(12);
        let scene = frozen(&doc);
        let mut variants = vec![("unchanged".to_owned(), doc.clone())];
        for axis in Axis::ALL.into_iter().filter(|axis| !of_the_walk.contains(axis)) {
            let key = keys::find(axis.key(), None).unwrap();
            for value in key.values() {
                let mut tree = toml::Table::try_from(&doc).unwrap();
                let (folders, name) = axis.key().rsplit_once('.').unwrap();
                let folders = folders.split('.').map(str::to_owned);
                let table = folders.fold(&mut tree, |table, folder| {
                    table.entry(folder).or_insert(toml::Table::new().into()).as_table_mut().unwrap()
                });
                table.insert(name.into(), value.into());
                let varied: SceneDoc = tree.try_into().unwrap();
                // Values that are invalid in this document are skipped.
                if majorant_core::estimator::validate(&varied).is_empty() {
                    variants.push((format!("{} = {value}", key.path), varied));
                }
            }
        }
        assert!(variants.len() > 20, "{}", variants.len());
        for path in 0..60u32 {
            let at = PathIndex { x: 16 + path * 7 % 32, y: 12 + path * 11 % 24, sample: u64::from(path % 5) };
            let mut expected = None;
            for entry in REGISTRY.iter().filter(|entry| entry.hero_draws()) {
                for (what, doc) in &variants {
                    let settings = Settings::new(&doc.estimator, doc.render.seed);
                    let recording = Recording::new(&scene, entry.kernel, &settings, at, CancelToken::NEVER);
                    let turns = turns(&recording);
                    walks += 1;
                    let expected: &Vec<_> = expected.get_or_insert_with(|| {
                        vertices += turns.len();
                        turns.clone()
                    });
                    assert_eq!(turns, *expected, "{name}, {}, {sampler:?}, {what}, {at:?}", entry.id);
                }
            }
        }
    }
    assert!(vertices > 500 && walks > 50_000, "{vertices} vertices, {walks} walks");
}

/// After one sample per pixel, the film holds the totals of the ledgers of its paths.
#[test]
fn film_equals_the_ledgers_of_its_paths() {
    let (_, mut doc) = scenes().remove(0);
    doc.render.spp = Some(1);
    for entry in REGISTRY {
        doc.estimator.id = entry.id.into();
        let session = Watched::new();
        session.submit(ViewId(0), job(&doc, false));
        let film = session.wait_finished(ViewId(0));
        let probe = session.state(ViewId(0)).probe.unwrap();
        for (i, mean) in film.mean.iter().enumerate() {
            let at = PathIndex { x: (i % 64) as u32, y: (i / 64) as u32, sample: 0 };
            let ledger = Ledger::new(&probe.record(at, CancelToken::NEVER));
            assert_eq!(ledger.film.to_array(), *mean, "{} {at:?}", entry.id);
        }
    }
}

/// Under every split, the contributions sum to the image and their shares of its variance to one.
#[test]
fn contributions_sum_to_the_image() {
    for (name, mut doc) in scenes() {
        (doc.film.width, doc.film.height) = (16, 12);
        let scene = frozen(&doc);
        let settings = Settings::new(&doc.estimator, 3);
        for entry in REGISTRY {
            let kernel = entry.kernel;
            let image: Vec<[f64; 3]> = (0..16 * 12)
                .map(|i| {
                    let paths = (0..8).map(|sample| PathIndex { x: i % 16, y: i / 16, sample });
                    let sum = paths
                        .map(|at| kernel(&scene, &settings, at, CancelToken::NEVER.into()).rgb.as_dvec3())
                        .sum::<glam::DVec3>();
                    (sum / 8.0).to_array()
                })
                .collect();
            for split in Split::ALL {
                let plan = StrategyPlan::whole(&scene, kernel, &settings, (0, 8));
                let parts = Strategies::render(&plan, split, CancelToken::NEVER).unwrap();
                for (i, whole) in image.iter().enumerate() {
                    for (c, channel) in whole.iter().enumerate() {
                        let sum: f64 = parts.layers.iter().map(|l| f64::from(l.mean[i][c])).sum();
                        let size: f64 = parts.layers.iter().map(|l| f64::from(l.mean[i][c]).abs()).sum();
                        let what = format!("{name}, {}, by {}", entry.id, split.name());
                        assert!((sum - channel).abs() <= 1e-5 * size + 1e-12, "{what}: {sum} {channel}");
                    }
                }
                let shares = parts.variance_shares(|_, _| true).unwrap();
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-6, "{shares:?}");
            }
        }
    }
}

#[test]
fn contributions_are_named_by_their_split() {
    let (_, mut doc) = scenes().into_iter().find(|(name, _)| name.contains("plume")).unwrap();
    doc.estimator.max_depth = Some(2);
    (doc.film.width, doc.film.height) = (16, 12);
    let scene = frozen(&doc);
    let settings = Settings::new(&doc.estimator, 3);
    let names = |id: &str, split| -> Vec<String> {
        let kernel = majorant_core::estimator::find(id).unwrap().kernel;
        let plan = StrategyPlan::whole(&scene, kernel, &settings, (0, 64));
        let parts = Strategies::render(&plan, split, CancelToken::NEVER).unwrap();
        parts.layers.into_iter().map(|l| l.name).collect()
    };
    assert_eq!(names("uni-nee-mis", Split::Order), ["0", "1"]);
    assert_eq!(names("spectral-mis", Split::Technique), ["unidirectional"]);
    assert_eq!(names("uni-nee-mis", Split::Technique), ["unidirectional", "next-event"]);
    assert!(names("equiangular-mis", Split::Technique).contains(&"next-event".to_owned()));
    assert!(names("nee", Split::Nulls).len() > 3);
    let heroes = names("independent", Split::Hero);
    assert!(heroes.len() >= 8 && heroes.iter().all(|name| name.ends_with("nm")), "{heroes:?}");
}
