//! Scene files: round trips, and error messages with line and column.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use majorant_core::io::embedded::SCENES;
use majorant_core::io::scene_file::{load, override_keys, parse, save, to_toml};
use majorant_core::math::SamplerKind;
use majorant_core::medium::{Interpolation, Precision};
use majorant_core::scene::{
    Absorption, Angle, Bookkeeping, CameraDoc, CoefficientsDoc, CompareDoc, DensityDoc, DirectionSampling,
    DistanceSampling, EmissionDoc, EstimatorDoc, Fairness, Fault, FilmDoc, GridRef, Heuristic, Heuristics,
    IorDoc, LightDoc, LightSampling, LightSelection, LightWalk, MajorantDoc, MaterialDoc, MeasureId,
    MediumDoc, MediumOverrides, Mode, ObjectDoc, PhaseDoc, PlacementDoc, ReferenceDoc, RenderDoc, SceneDoc,
    ShapeDoc, SurfaceEmissionDoc, ToneCurve, Tracking, ViewDoc, ViewOverrides, WhenExceeded, Within,
};
use majorant_core::spectrum::{ControlPoint, Outside, SpectrumDoc, WavelengthSampling};

/// Objects of every kind, with names, materials, placement and emission.
fn objects() -> Vec<ObjectDoc> {
    let mut objects: Vec<ObjectDoc> = ObjectDoc::templates().into_iter().map(|(_, object)| object).collect();
    for (number, object) in objects.iter_mut().enumerate() {
        object.name = format!("object {number}");
        object.enabled = number != 2;
        if number % 2 == 1 {
            let emission = SurfaceEmissionDoc { scale: 3.0, visible: false, ..SurfaceEmissionDoc::default() };
            object.emission = Some(emission);
            object.material = MaterialDoc::Diffuse { albedo: SpectrumDoc::Rgb([0.1, 0.2, 0.3]) };
        }
        if let ShapeDoc::Mesh { file, placement } = &mut object.shape {
            *file = "lantern.obj".into();
            placement.fit = Some(2.0);
        }
    }
    let sphere = ShapeDoc::Sphere { center: [1.0, 2.0, 3.0], radius: 0.5 };
    let materials = MaterialDoc::templates().into_iter().map(|(_, material)| material);
    let constants = MaterialDoc::Conductor {
        preset: None,
        eta: Some(SpectrumDoc::Constant(0.2)),
        k: Some(SpectrumDoc::Rgb([3.0, 2.0, 1.0])),
        roughness: 0.5,
    };
    let glass = MaterialDoc::Dielectric { ior: IorDoc::Cauchy { cauchy: [1.5, 0.004] }, roughness: 0.1 };
    for (number, material) in (1..).zip(materials.chain([constants, glass])) {
        let priority = number;
        objects.push(ObjectDoc { material, priority, ..ObjectDoc::new(sphere.clone()) });
    }
    objects
}

/// A document in which every key differs from its default.
fn everything() -> SceneDoc {
    SceneDoc {
        majorant: 2,
        title: "All \"keys\"".into(),
        note: "two\nlines".into(),
        camera: CameraDoc {
            origin: [1.0, 2.5, -3.0],
            target: [0.1, 0.2, 0.3],
            up: [0.0, 0.0, 1.0],
            fov_deg: 21.5,
            mirror: true,
        },
        film: FilmDoc { width: 123, height: 45 },
        media: vec![
            MediumDoc {
                name: "smoke".into(),
                enabled: false,
                within: Within::Grid,
                extent: None,
                scale: 3.5,
                extinction: SpectrumDoc::Points {
                    points: vec![
                        ControlPoint { lambda_nm: 400.5, value: 1.25 },
                        ControlPoint { lambda_nm: 700.0, value: 0.1 },
                    ],
                    outside: Outside::Zero,
                },
                albedo: SpectrumDoc::Rgb([0.1, 0.2, 0.3]),
                coefficients: Some(CoefficientsDoc::AbsorptionScattering {
                    absorption: SpectrumDoc::Constant(0.25),
                    scattering: SpectrumDoc::Rgb([1.0, 2.0, 3.0]),
                }),
                albedo_grid: Some(GridRef { file: "a.vol".into(), grid: None }),
                density: DensityDoc::Grid(GridRef { file: "d.vdb".into(), grid: Some("smoke".into()) }),
                precision: Precision::F16,
                interpolation: Interpolation::Stochastic,
                placement: PlacementDoc {
                    fit: Some(2.0),
                    scale: [1.0, 2.0, 3.0],
                    rotate_deg: [10.0, 20.0, 30.0],
                    translate: [4.0, 5.0, 6.0],
                    matrix: Some([[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0]]),
                },
                majorant: MajorantDoc {
                    factor: 0.7,
                    shared: true,
                    when_exceeded: WhenExceeded::Clamp,
                    resolution: Some(24),
                },
                emission: Some(EmissionDoc {
                    temperature: Some(GridRef { file: "hot.vdb".into(), grid: None }),
                    kelvin: 1.5,
                    scale: 2.0,
                }),
                phase: PhaseDoc::TwoLobe { g_forward: 0.8, g_backward: -0.2, forward: 0.6 },
            },
            MediumDoc {
                name: "fog".into(),
                within: Within::Everywhere,
                extent: Some(12.5),
                ..MediumDoc::default()
            },
        ],
        lights: LightDoc::templates()
            .into_iter()
            .map(|(_, light)| light)
            .filter(|l| !matches!(l, LightDoc::EnvironmentMap { .. }))
            .collect(),
        objects: objects(),
        estimator: EstimatorDoc {
            id: "nee".into(),
            mode: Mode::Rgb,
            sampler: SamplerKind::Lattice,
            wavelengths: WavelengthSampling::Uniform,
            distances: DistanceSampling::Decomposition,
            directions: DirectionSampling::TowardsLights,
            absorption: Absorption::Analogue,
            heuristics: Heuristics { components: Heuristic::Power, techniques: Heuristic::Maximum },
            bookkeeping: Bookkeeping::ApartF64,
            tracking: Tracking::Average,
            fault: Fault::NullCap,
            light_walk: LightWalk::Separate,
            lights: LightSelection::Contribution,
            light_sampling: LightSampling::Product,
            transmittance: "power-series".into(),
            max_depth: Some(7),
            roulette_depth: Some(3),
        },
        render: RenderDoc {
            spp: None,
            seconds: Some(12.5),
            cpu_seconds: Some(25.0),
            relative_error: Some(0.01),
            seed: 42,
            threads: Some(3),
        },
        view: ViewDoc { exposure_ev: -1.5, tone: ToneCurve::Reinhard, gamma: Some(2.2) },
        compare: CompareDoc {
            views: vec![ViewOverrides {
                estimator: EstimatorDoc {
                    max_depth: Some(2),
                    roulette_depth: None,
                    ..EstimatorDoc::default()
                },
                majorant: MajorantDoc::default(),
                media: vec![MediumOverrides {
                    name: "fog".into(),
                    majorant: MajorantDoc { factor: 1.5, ..MajorantDoc::default() },
                }],
                seed: 7,
                camera: Some(CameraDoc { fov_deg: 12.0, ..CameraDoc::default() }),
                view: Some(ViewDoc { exposure_ev: 2.0, ..ViewDoc::default() }),
            }],
            fairness: Fairness::Lookups,
            reference: ReferenceDoc::Render {
                estimator: "spectral-mis".into(),
                spp: Some(1024),
                relative_error: Some(0.01),
            },
            baseline: 1,
            measure: MeasureId("mse".into()),
            region: Some([1, 2, 30, 40]),
            ..CompareDoc::default()
        },
        window: toml::from_str("own_zoom = true\nof_a_later_version = 3").unwrap(),
    }
}

fn with(edit: impl FnOnce(&mut MediumDoc)) -> SceneDoc {
    let mut doc = SceneDoc::default();
    edit(doc.medium_mut());
    doc
}

/// Every kind of phase function, with numbers other than those of the templates.
fn phases() -> Vec<PhaseDoc> {
    let mut phases = PhaseDoc::templates();
    for phase in &mut phases {
        for (parameter, value) in phase.parameters_mut() {
            *value = 0.7 * *value + 0.1 * parameter.range[1].min(1.0);
        }
        if let PhaseDoc::Tabulated { angle, points, .. } = phase {
            *angle = Angle::Cosine;
            *points = vec![[-0.75, 0.125], [0.1, 3.0], [1.0, 1e-3]];
        }
    }
    phases.push(PhaseDoc::Tabulated { angle: Angle::Degrees, points: Vec::new(), file: "lobe.csv".into() });
    phases
}

fn coefficients() -> Vec<CoefficientsDoc> {
    let text = "430:8, 540:0.5";
    let points =
        SpectrumDoc::Points { points: SpectrumDoc::parse_points(text).unwrap(), outside: Outside::Hold };
    vec![
        CoefficientsDoc::AbsorptionScattering {
            absorption: points.clone(),
            scattering: SpectrumDoc::Preset("report-plume".into()),
        },
        CoefficientsDoc::MeanFreePathColour {
            mean_free_path: points,
            colour: SpectrumDoc::Rgb([0.9, 0.5, 0.2]),
        },
    ]
}

#[test]
fn documents_read_back_as_they_were_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let mut docs = vec![everything(), SceneDoc::default()];
    docs.extend(phases().into_iter().map(|phase| with(|medium| medium.phase = phase)));
    docs.extend(coefficients().into_iter().map(|way| with(|medium| medium.coefficients = Some(way))));
    docs.extend(SCENES.iter().map(|s| parse(s.toml, s.name).unwrap()));
    for doc in docs {
        save(&path, &doc).unwrap();
        assert_eq!(load(&path).unwrap(), doc, "{}", to_toml(&doc));
    }
}

#[test]
fn every_spectrum_form_is_understood() {
    for (form, expected) in [
        ("0.5", SpectrumDoc::Constant(0.5)),
        ("1", SpectrumDoc::Constant(1.0)),
        ("\"report-plume\"", SpectrumDoc::Preset("report-plume".into())),
        ("{ rgb = [1, 0.5, 0.0] }", SpectrumDoc::Rgb([1.0, 0.5, 0.0])),
    ] {
        let doc = parse(&format!("majorant = 1\n[medium]\nextinction = {form}\n"), "x").unwrap();
        assert_eq!(doc.medium().extinction, expected, "{form}");
    }
}

/// Each mistake with its line, column, and a word of the message; 0 for a position that is not checked.
#[test]
fn mistakes_are_named_with_line_and_column() {
    for (text, line, column, word) in [
        ("majorant = 1\n[medium]\nalbdo = 0.9\n", 3, 1, "albdo"),
        ("majorant = 1\n\n[medium]\n  scale = \"thick\"\n", 4, 11, "string"),
        ("majorant = 1\n[camera\n", 2, 8, ""),
        ("[medium]\nscale = 1.0\n", 1, 1, "majorant"),
        ("majorant = 9\n", 1, 12, "format"),
        ("majorant = 1\n[camera]\nfov_rad = 0.5\n", 3, 1, "fov_deg"),
        ("majorant = 1\n[medium]\nscale = 1.0\nalbedo = 1.5\n", 4, 10, "medium.albedo"),
        ("majorant = 1\n[medium]\nextinction = \"0.43:8, 0.54:40\"\n", 3, 14, "nanometres"),
        ("majorant = 1\n[medium]\nextinction = \"430:8 540:40\"\n", 3, 14, "430:8"),
        ("majorant = 1\n[medium]\nextinction = \"540:40, 430:8\"\n", 3, 14, "increase"),
        ("majorant = 1\n[medium]\nextinction = \"purple\"\n", 3, 14, "purple"),
        (
            "majorant = 1\n[[lights]]\nkind = \"environment\"\n[[lights]]\nkind = \"sphere\"\ncenter = [0.0, 0.0, 0.0]\nradius = -1.0\n",
            7,
            10,
            "lights[1].radius",
        ),
        (
            "majorant = 1\n[[lights]]\nkind = \"sun\"\ntoward = [0.0, 1.0, 0.0]\ndiameter = 3.0\n",
            5,
            1,
            "diameter",
        ),
        ("majorant = 1\n[[lights]]\nkind = \"lamp\"\n", 0, 0, "lamp"),
        ("majorant = 1\n[film]\nwidth = 0\n", 3, 0, "film"),
        ("majorant = 1\n[estimator]\nid = \"magic\"\n", 3, 6, "uni-nee-mis"),
        ("majorant = 1\n[medium]\nscale = nan\n", 3, 9, "medium.scale"),
        ("majorant = 1\n[medium.phase]\nkind = \"isotropic\"\ng = 0.9\n", 4, 1, "`g`"),
        ("majorant = 1\n[medium.density]\nkind = \"uniform\"\nscale = 3\n", 4, 1, "`scale`"),
        (
            "majorant = 1\n[medium.phase]\nkind = \"draine\"\ng = 0.5\nalpha = -1.0\n",
            5,
            9,
            "medium.phase.alpha",
        ),
        ("majorant = 1\n[medium.phase]\nkind = \"mie\"\ndiameter_um = 60.0\n", 4, 15, "0.001 to 50"),
        ("majorant = 1\n[medium.phase]\nkind = \"mie\"\ndiameter = 6.0\n", 4, 1, "diameter"),
        (
            "majorant = 1\n[medium.phase]\nkind = \"tabulated\"\npoints = [[0.5, 1.0]]\n",
            4,
            10,
            "at least two",
        ),
        (
            "majorant = 1\n[medium.coefficients]\nkind = \"absorption-scattering\"\nabsorption = 1.0\nscattering = -2.0\n",
            5,
            14,
            "medium.coefficients.scattering",
        ),
        (
            "majorant = 1\n[medium.coefficients]\nkind = \"absorption-scattering\"\nabsorption = 1.0\n",
            2,
            0,
            "scattering",
        ),
        (
            "majorant = 1\n[[lights]]\nkind = \"environment\"\nscale = 2.0\nradiance = -3.0\n",
            5,
            12,
            "lights[0].radiance",
        ),
    ] {
        let message = parse(text, "scene.toml").unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
        let mut parts = message.split(':');
        assert_eq!(parts.next(), Some("scene.toml"), "{message}");
        let place: Vec<usize> = parts.take(2).map(|p| p.parse().unwrap()).collect();
        if line > 0 {
            assert_eq!(place[0], line, "{message}");
        }
        if column > 0 {
            assert_eq!(place[1], column, "{message}");
        }
    }
}

/// A file of version 1 has one medium in a table, or none, which is the default; it is saved as version 2.
#[test]
fn files_of_version_1_are_read_and_saved_as_version_2() {
    let old = "majorant = 1\n[medium]\nscale = 3.0\n[medium.phase]\nkind = \"rayleigh\"\n";
    let new = "majorant = 2\n[[medium]]\nscale = 3.0\n[medium.phase]\nkind = \"rayleigh\"\n";
    let doc = parse(old, "old.toml").unwrap();
    assert_eq!(doc, parse(new, "new.toml").unwrap());
    assert_eq!((doc.majorant, doc.media.len(), doc.media[0].name.as_str()), (2, 1, "medium"));
    let saved = to_toml(&doc);
    assert!(saved.starts_with("majorant = 2\n") && saved.contains("[[media]]"), "{saved}");
    assert_eq!(parse("majorant = 1\n", "old.toml").unwrap().media.len(), 1);
    assert_eq!(parse("majorant = 2\n", "new.toml").unwrap().media, []);
    let message = parse("majorant = 3\n", "later.toml").unwrap_err().to_string();
    assert!(message.contains("scene format 3") && message.contains("1 to 2"), "{message}");
}

const SEVERAL: &str = "majorant = 2
[[media]]
name = \"cloud\"
[[media]]
name = \"fog\"
within = \"everywhere\"
extent = 5.0
";

#[test]
fn overrides_address_media_by_their_names() {
    let doc = parse(SEVERAL, "several").unwrap();
    let set = |assignment: &str| override_keys(&doc, &[assignment.to_owned()]);
    assert_eq!(set("media.fog.scale=0.5").unwrap().media[1].scale, 0.5);
    assert_eq!(set("media.cloud.majorant.factor=2").unwrap().media[0].majorant.factor, 2.0);
    assert_eq!(set("medium.1.scale=0.5").unwrap().media[1].scale, 0.5);
    for (bad, words) in [
        ("medium.scale=2", "the scene has 2 media: write media.NAME.KEY with one of the names cloud, fog"),
        ("media.mist.scale=2", "no medium is named `mist`"),
        ("media.fog.name=cloud", "is the name of another medium"),
    ] {
        let message = set(bad).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
    // The only medium has both addresses.
    let only = parse(SCENES[0].toml, "first-light").unwrap();
    for key in ["medium.scale=2", "media.medium.scale=2"] {
        assert_eq!(override_keys(&only, &[key.to_owned()]).unwrap().medium().scale, 2.0);
    }
    let none = parse("majorant = 2\n", "none").unwrap();
    assert!(override_keys(&none, &["medium.scale=2".to_owned()]).is_err());
}

/// Objects of version 1 have an albedo; later ones a material, a name and an emission.
#[test]
fn objects_of_both_versions_are_read_and_saved_with_their_material() {
    let old = "majorant = 1\n[[objects]]\nkind = \"ground\"\nalbedo = 0.25\n";
    let doc = parse(old, "old.toml").unwrap();
    let saved = to_toml(&doc);
    assert!(saved.contains("[objects.material]\nkind = \"diffuse\"\nalbedo = 0.25"), "{saved}");
    assert_eq!(parse(&saved, "saved.toml").unwrap(), doc);
    let set = override_keys(&doc, &["objects.0.albedo=0.75".to_owned()]).unwrap();
    let same = override_keys(&doc, &["objects.0.material.albedo=0.75".to_owned()]).unwrap();
    assert_eq!(set, same);
    assert_ne!(set, doc);
    let filled = "majorant = 2\n[[media]]\nwithin = \"ball\"\n[[objects]]\nname = \"ball\"\nkind = \"sphere\"\n\
                  center = [0.0, 0.0, 0.0]\nradius = 1.0\nmaterial = { kind = \"interface\" }\n";
    let mut doc = parse(filled, "filled.toml").unwrap();
    assert_eq!(parse(&to_toml(&doc), "saved.toml").unwrap(), doc);
    doc.rename_object(0, "marble".into());
    assert_eq!(doc.media[0].within, Within::Object("marble".into()));
    doc.remove_object(0);
    assert_eq!(doc.media[0].within, Within::Grid);
}

/// Invalid combinations of objects and media: line and a word of the message.
#[test]
fn objects_that_do_not_fit_are_rejected_where_they_stand() {
    let sphere = "kind = \"sphere\"\ncenter = [0.0, 0.0, 0.0]\nradius = 1.0\n";
    for (text, line, word) in [
        ("[[media]]\nwithin = \"ball\"\n".to_owned(), 3, "no closed object has a name"),
        (
            format!("[[media]]\nwithin = \"bal\"\n[[objects]]\nname = \"ball\"\n{sphere}"),
            3,
            "closed objects are `ball`",
        ),
        ("[[media]]\nwithin = \"g\"\n[[objects]]\nname = \"g\"\nkind = \"ground\"\n".into(), 3, "no inside"),
        (
            format!("[[objects]]\nname = \"a\"\n{sphere}[[objects]]\nname = \"a\"\n{sphere}"),
            8,
            "another object",
        ),
        (format!("[[objects]]\nname = \"grid\"\n{sphere}"), 3, "name of a region"),
        ("[[objects]]\nkind = \"ground\"\nemission = { radiance = 1.0 }\n".into(), 4, "infinite plane"),
        (
            format!(
                "[[objects]]\n{sphere}material = {{ kind = \"interface\" }}\nemission = {{ radiance = 1.0 }}\n"
            ),
            7,
            "no surface that emits",
        ),
        ("[[objects]]\nkind = \"mesh\"\nfile = \"\"\n".into(), 4, "names no mesh"),
        (format!("[[objects]]\n{sphere}normal = [0.0, 1.0, 0.0]\n"), 6, "unknown field"),
        (format!("[[objects]]\n{sphere}material = {{ kind = \"velvet\" }}\n"), 6, "velvet"),
        (format!("[[objects]]\n{sphere}material = {{ kind = \"conductor\" }}\n"), 6, "needs a `preset`"),
        (
            format!("[[objects]]\n{sphere}material = {{ kind = \"conductor\", preset = \"tin\" }}\n"),
            6,
            "expected one of `aluminium`",
        ),
        (format!("[[objects]]\n{sphere}material = {{ kind = \"dielectric\", ior = 0.5 }}\n"), 6, "1 to 4"),
        (
            format!(
                "[[objects]]\n{sphere}material = {{ kind = \"dielectric\", ior = {{ cauchy = [1.0, -0.1] }} }}\n"
            ),
            6,
            "outside 1 to 4",
        ),
        (
            "[[objects]]\nkind = \"ground\"\nmaterial = { kind = \"dielectric\" }\n".into(),
            4,
            "needs a closed shape",
        ),
        (format!("[[objects]]\n{sphere}material = {{ kind = \"diffuse\", albedo = 1.5 }}\n"), 6, "0 to 1"),
    ] {
        let message = parse(&format!("majorant = 2\n{text}"), "scene.toml").unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
        let at: usize = message.split(':').nth(1).unwrap().parse().unwrap();
        assert_eq!(at, line, "{message}");
    }
}

/// Invalid combinations of media: line, column and a word of the message.
#[test]
fn media_that_do_not_fit_together_are_rejected_where_they_stand() {
    for (text, line, word) in [
        ("[[media]]\nname = \"a\"\n[[media]]\nname = \"a\"\n", 5, "another medium"),
        ("[[media]]\nname = \"a.b\"\n", 3, "choose another name"),
        ("[[media]]\n[[media]]\nname = \"b\"\nscale = -1.0\n", 5, "medium[1].scale"),
        ("[[media]]\nextent = 3.0\n", 3, "within `everywhere` only"),
        (
            "[[media]]\nwithin = \"everywhere\"\ndensity = { kind = \"grid\", file = \"a.vdb\" }\n",
            3,
            "needs uniform coefficients",
        ),
        (
            "[[media]]\nwithin = \"everywhere\"\nemission = { temperature = { file = \"a.vdb\" } }\n",
            3,
            "needs uniform coefficients",
        ),
        ("[[media]]\nwithin = \"nowhere\"\n", 3, "everywhere"),
        ("[[media]]\n[[compare.views]]\nmedia = [{ name = \"b\" }]\n", 4, "this scene has not"),
        (
            "[[media]]\n[[media]]\nname = 'b'\n[[compare.views]]\nmedia = [{ name = 'c' }]\n",
            6,
            "not a medium of the scene",
        ),
        ("[[media]]\n[[media]]\nname = 'b'\n[[compare.views]]\nmajorant = { factor = 2.0 }\n", 6, "several"),
    ] {
        let message = parse(&format!("majorant = 2\n{text}"), "scene.toml").unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
        assert!(message.starts_with(&format!("scene.toml:{line}:")), "{message}");
    }
}

#[test]
fn overrides_reach_every_key() {
    let doc = parse(SCENES[0].toml, "first-light").unwrap();
    let set = |assignments: &[&str]| {
        let owned: Vec<String> = assignments.iter().map(|s| (*s).to_owned()).collect();
        override_keys(&doc, &owned)
    };
    let changed = set(&[
        "medium.majorant.factor=2",
        "lights.0.scale=3.5",
        "estimator.id=nee",
        "medium.phase={ kind = \"henyey-greenstein\", g = 0.5 }",
        "medium.phase.g=0.7",
        "estimator.max_depth=4",
        "medium.extinction=430:1, 600:2",
        "camera.origin.1=5",
    ])
    .unwrap();
    assert_eq!(changed.medium().majorant.factor, 2.0);
    assert_eq!(changed.medium().phase, PhaseDoc::HenyeyGreenstein { g: 0.7 });
    assert_eq!(changed.estimator.id, "nee");
    assert_eq!(changed.estimator.max_depth, Some(4));
    assert_eq!(changed.camera.origin[1], 5.0);
    assert!(matches!(&changed.medium().extinction, SpectrumDoc::Points { points, .. } if points.len() == 2));
    let LightDoc::Rectangle { scale, .. } = &changed.lights[0] else { panic!("a rectangle") };
    assert_eq!(*scale, 3.5);
    for bad in
        ["medium.majorant.fctor=2", "lights.9.scale=1", "medium", "medium.albedo=2", "camera.fov_deg=wide"]
    {
        let message = set(&[bad]).unwrap_err().to_string();
        assert!(message.contains(bad), "{message}");
    }
}
