//! Free flight: distances to tentative collisions, which follow the majorant, and to the first real one,
//! which follow the extinction.

#[path = "flight/line.rs"]
mod line;

use glam::Vec3;
use line::Line;
use majorant_core::io::{Library, scene_file};
use majorant_core::math::{BoxRay, Ray, Sampler};
use majorant_core::medium::{AnyMedium, Coefficients, LocalMedium, MajorantSegment, Medium, One};
use majorant_core::scene::{Absorption, DistanceSampling, Scene, build};
use majorant_core::spectrum::{Components, RgbChannels, Sampled, WavelengthSampling, Wavelengths};
use majorant_core::transport::{CancelToken, Event, EventRule, PathWeights, Trace, Walk, WalkWeights};
use majorant_tests::chi2::Family;

const WALKS: u64 = 30_000;
const BY: WavelengthSampling = WavelengthSampling::Uniform;
/// Extinction of density 1, by channel and by wavelength.
const RGB: [f64; 3] = [1.0, 3.0, 6.0];
const POINTS: [(f64, f64); 4] = [(400.0, 0.5), (500.0, 6.0), (560.0, 2.0), (700.0, 4.0)];

/// Expected distribution: optical depths from the origin as functions of distance, and the end of the walk.
struct Truth<'a> {
    majorant: &'a dyn Fn(f64) -> f64,
    extinction: &'a dyn Fn(f64) -> f64,
    end: f64,
}

/// Cumulative distribution of a free flight that starts at optical depth `before` and ends before `end`.
fn arrived(depth: &dyn Fn(f64) -> f64, before: f64, t: f64, end: f64) -> f64 {
    let by = |t: f64| -(before - depth(t)).exp_m1();
    (by(t) / by(end)).min(1.0)
}

/// Samples many walks along one ray, each until its first real collision.
fn fly<L: LocalMedium<N>, const N: usize>(
    family: &mut Family,
    name: &str,
    truth: &Truth,
    (medium, scene): (L, &Scene),
    (ray, t_max): (&Ray, f32),
) {
    let media = One { medium, placed: &scene.media[0].placed };
    let by = |absorption, distances| EventRule { absorption, distances };
    for (stream, rule) in [
        by(Absorption::Analogue, DistanceSampling::Delta),
        by(Absorption::Weighted, DistanceSampling::Delta),
        by(Absorption::Roulette, DistanceSampling::Delta),
        by(Absorption::Analogue, DistanceSampling::Decomposition),
        by(Absorption::Weighted, DistanceSampling::Decomposition),
    ]
    .into_iter()
    .enumerate()
    {
        let name = format!("{name}, {:?}, {:?}", rule.absorption, rule.distances);
        let (mut first, mut second, mut real) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..WALKS {
            let mut trace = Trace::new(Sampler::new(9, i, stream as u64), CancelToken::NEVER);
            let mut walk = Walk::new(&media, ray, t_max, rule);
            let mut weights = PathWeights::CAMERA;
            let mut before = Vec::new();
            while let Some(collision) = walk.next_collision(&mut trace, &mut weights) {
                let t = (collision.point - ray.origin).as_dvec3().dot(ray.direction.as_dvec3());
                match before[..] {
                    [] => first.push(arrived(truth.majorant, 0.0, t, truth.end)),
                    [last] => second.push(arrived(truth.majorant, (truth.majorant)(last), t, truth.end)),
                    _ => {}
                }
                before.push(t);
                if collision.draw_event(&mut trace) != Event::Null {
                    real.push(arrived(truth.extinction, 0.0, t, truth.end));
                    break;
                }
            }
        }
        for (what, depth, shares) in
            [("first", truth.majorant, first), ("first real", truth.extinction, real)]
        {
            let (count, passing) = (shares.len() as u64, (-depth(truth.end)).exp());
            family.counts(&format!("{name}: {what}"), &[count, WALKS - count], &[1.0 - passing, passing]);
            family.uniform(&format!("{name}: {what} distance"), shares);
        }
        // With a tight majorant in a homogeneous medium every collision is real, and there is no second.
        if second.len() > 1000 {
            family.uniform(&format!("{name}: second distance"), second);
        }
    }
}

fn scene(grid: bool, extinction: &str, factor: f64, cells: u32) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    line::write(folder.path());
    let density = if grid {
        format!("kind = \"grid\", file = \"{}\"", line::FILE)
    } else {
        "kind = \"uniform\"".into()
    };
    let text = format!(
        "majorant = 1
        [medium]
        extinction = {extinction}
        albedo = 0.7
        density = {{ {density} }}
        placement = {}
        majorant = {{ factor = {factor:?}, resolution = {cells} }}
        [[lights]]
        kind = \"environment\"",
        line::PLACEMENT
    );
    let doc = scene_file::parse(&text, "flight").unwrap_or_else(|e| panic!("{e}"));
    build(&doc, &mut Library::default().with_base(folder.path())).unwrap_or_else(|e| panic!("{e}"))
}

/// Tests one set of components, whose hero has extinction `hero` at density 1.
fn fly_at<C: Components<N>, const N: usize>(
    family: &mut Family,
    name: &str,
    (scene, line): (&Scene, &Line),
    (components, hero, factor): (&C, f64, f64),
    end: f64,
) {
    let ray = (&line.ray, end as f32);
    let global = hero * line.max_density * factor;
    let global = |t: f64| global * (t - line.enter);
    let extinction = |t: f64| hero * line.column(t);
    let truth = |majorant| Truth { majorant, extinction: &extinction, end: end.min(line.exit) };
    match &scene.media[0].placed.medium {
        AnyMedium::Homogeneous(m) => fly(family, name, &truth(&global), (m.local(components), scene), ray),
        AnyMedium::DensityGrid(m) if m.bounds.cells() == 1 => {
            fly(family, name, &truth(&global), (m.local(components), scene), ray);
        }
        AnyMedium::DensityGrid(m) => {
            let local = m.local(components);
            let depth = depth_by_cells(&local, scene, line);
            assert!(depth(line.exit) < 0.9 * global(line.exit), "local majorants are not tighter");
            fly(family, name, &truth(&depth), (local, scene), ray);
        }
        AnyMedium::RgbGrids(_) => panic!("there is no RGB grid"),
    }
}

/// Optical depth of the hero's local majorants, from the entry of the line into the box.
fn depth_by_cells<L: LocalMedium<N>, const N: usize>(
    medium: &L,
    scene: &Scene,
    line: &Line,
) -> impl Fn(f64) -> f64 + use<L, N> {
    let entry = line.ray.at(line.enter as f32);
    let ray = Ray { origin: entry, direction: line.ray.direction };
    let (_, ray) = BoxRay::enter(&ray, scene.media[0].medium_from_world(), f32::INFINITY).unwrap();
    let cells: Vec<_> = medium.segments(&ray).collect();
    let enter = line.enter;
    move |t| {
        let spent = cells.iter().map(|cell| {
            let (from, to) = (f64::from(cell.t0), f64::from(cell.t1));
            ((t - enter).min(to) - from).max(0.0) * f64::from(cell.majorant.hero())
        });
        spent.sum()
    }
}

fn between_points(lambda_nm: f64) -> f64 {
    let i = POINTS.windows(2).position(|w| lambda_nm < w[1].0).unwrap();
    let ((a, va), (b, vb)) = (POINTS[i], POINTS[i + 1]);
    va + (vb - va) * (lambda_nm - a) / (b - a)
}

#[test]
fn flights_follow_the_majorant_and_real_collisions_the_extinction() {
    let mut family = Family::default();
    let points: Vec<_> = POINTS.iter().map(|(nm, value)| format!("{nm}:{value}")).collect();
    let uniform = [1.0, 1.7, 10.0].map(|factor| (false, factor, 1));
    let cells = [(true, 1.0, 1), (true, 1.7, 1), (true, 10.0, 1), (true, 1.0, 5), (true, 1.7, 16)];
    for (grid, factor, cells) in uniform.into_iter().chain(cells) {
        let line = Line::new(grid);
        let name = format!("{} × {factor}, {cells}³", if grid { "grid" } else { "homogeneous" });
        let rgb = scene(grid, &format!("{{ rgb = {RGB:?} }}"), factor, cells);
        for (u, hero) in [0.2, 0.5, 0.8].into_iter().zip(RGB) {
            let set = RgbChannels::<3>::sample(u, Some(BY));
            fly_at(&mut family, &format!("{name}, {set:?}"), (&rgb, &line), (&set, hero, factor), 9.0);
        }
        let spectral = scene(grid, &format!("\"{}\"", points.join(", ")), factor, cells);
        for u in [0.12, 0.3, 0.55] {
            let set = Wavelengths::<4>::sample(u, Some(BY));
            let hero = between_points(f64::from(set.lambda_nm[0]));
            fly_at(&mut family, &format!("{name}, {set:?}"), (&spectral, &line), (&set, hero, factor), 9.0);
        }
        // The distance to a surface inside the box.
        let (set, end) = (RgbChannels::<1>::sample(0.5, Some(BY)), 0.4 * line.enter + 0.6 * line.exit);
        fly_at(&mut family, &format!("{name}, cut short"), (&rgb, &line), (&set, RGB[1], factor), end);
    }
    family.judge();
}

/// A medium of segments with different majorants, one of them zero for the hero. The extinction is a constant
/// fraction of the majorant.
struct Stretches {
    hero: usize,
}

const CUTS: [f32; 5] = [0.0, 0.15, 0.4, 0.5, 1.0];
const MAJORANTS: [[f32; 3]; 4] = [[2.0, 9.0, 0.5], [0.0, 1.0, 4.0], [7.0, 0.0, 1.0], [1.5, 3.0, 0.0]];
const EXTINGUISHED: f32 = 0.625;

impl LocalMedium<3> for Stretches {
    type Segments<'a> = std::vec::IntoIter<MajorantSegment<3>>;

    fn coefficients(&self, _point: Vec3, segment: &MajorantSegment<3>) -> Coefficients<3> {
        Coefficients::new(segment.majorant * EXTINGUISHED, Sampled::splat(0.5), segment)
    }

    fn segments<'a>(&'a self, ray: &BoxRay) -> Self::Segments<'a> {
        let at = |cut: f32| ray.t_end * cut;
        let stretch = |(cut, m): (&[f32], [f32; 3])| {
            let majorant = Sampled(std::array::from_fn(|i| m[(self.hero + i) % 3]));
            MajorantSegment { t0: at(cut[0]), t1: at(cut[1]), majorant, clamp_null: false, watched: false }
        };
        CUTS.windows(2).zip(MAJORANTS).map(stretch).collect::<Vec<_>>().into_iter()
    }
}

#[test]
fn one_optical_depth_is_spent_over_many_stretches() {
    let mut family = Family::default();
    let (scene, line) = (scene(false, "1.0", 1.0, 1), Line::new(false));
    for hero in 0..3 {
        let majorant = |t: f64| -> f64 {
            let place = (t - line.enter) / (line.exit - line.enter);
            let stretches = CUTS.windows(2).zip(MAJORANTS);
            let depths = stretches.map(|(cut, m)| {
                let [from, to] = [f64::from(cut[0]), f64::from(cut[1])];
                (place.min(to) - from).max(0.0) * f64::from(m[hero])
            });
            depths.sum::<f64>() * (line.exit - line.enter)
        };
        let extinction = |t: f64| f64::from(EXTINGUISHED) * majorant(t);
        let truth = Truth { majorant: &majorant, extinction: &extinction, end: line.exit };
        fly(&mut family, &format!("hero {hero}"), &truth, (Stretches { hero }, &scene), (&line.ray, 9.0));
    }
    family.judge();
}
