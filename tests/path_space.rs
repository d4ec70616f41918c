//! Contributions of all heroes and techniques to one path sum to its integrand.
//!
//! ```text
//!   (1/C) Σ_{h,t} P_{h,t} v_{h,t,j} = f_j
//! ```
//!
//! P is the density with which hero h and technique t sample the path, computed here in double precision from
//! the *sampled* quantities (free flights, the part of the medium, the event for a random number,
//! directions). v is the estimator's contribution, from the walk's weights for unidirectional sampling and
//! from the connection's weights for next-event estimation. f is the integrand, from the coefficients. With
//! the balance heuristic this states that the weights of one path sum to one: an error on one side only that
//! changes the mean of an image by one per cent causes the same deviation here, without noise.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use glam::Vec3;
use majorant_core::estimator::Settings;
use majorant_core::io::{Library, scene_file};
use majorant_core::light::LightPoint;
use majorant_core::math::{Ray, Sampler};
use majorant_core::medium::{
    AnyMedium, LocalMedia, LocalMedium, MajorantSegment, Medium, Member, One, PlacedMedium, Several,
    Traversal,
};
use majorant_core::scene::{
    Absorption, DirectionSampling, DistanceSampling, Heuristic, Heuristics, LightSampling, LightSelection,
    Scene, SceneDoc, build,
};
use majorant_core::spectrum::{Components, RgbChannels, Sampled, WavelengthSampling, Wavelengths};
use majorant_core::transport::{
    Collision, DirectionSample, EquiangularWeights, Event, EventRule, LightDensities, Part, Passage,
    PathWeights, Place, Reached, ScatteringPoint, Vertex, WalkWeights, Weights, WeightsApart,
    WeightsPairwise, World,
};
use majorant_tests::fixture::npy;

/// Relative rounding error of a product of a dozen factors in single precision.
const ROUNDING: f64 = 2e-4;

/// Collision on a ray: its distance and event.
#[derive(Clone, Copy, Debug)]
struct Step {
    t: f32,
    event: Event,
    /// Whether the collision is with the control, if the medium is decomposed into control and residual.
    control: bool,
    /// Number that selects the medium, where several overlap.
    label: f32,
}

/// Segment of a path, up to a scattering vertex or a light.
#[derive(Clone, Debug)]
struct Stretch {
    ray: Ray,
    /// Collisions in order; all are null except the last one of a segment that ends in scattering.
    steps: Vec<Step>,
    /// Distance to the light, for a segment that ends there.
    end: f32,
}

impl Stretch {
    /// The end of the segment as a point of a light that is not a mesh.
    fn light_point(&self) -> LightPoint {
        LightPoint { direction: self.ray.direction, distance: self.end, triangle: 0 }
    }
}

/// Majorant optical depth from `from` to `to` along a ray, per component.
fn majorant_depth<M: LocalMedia<N>, C: Components<N>, const N: usize>(
    world: &World<'_, M, C, N>,
    ray: &Ray,
    (from, to): (f32, f32),
) -> [f64; N] {
    let mut depth = [0.0; N];
    let Some((t0, traversal)) = world.media.traverse(ray, f32::INFINITY) else { return depth };
    for segment in traversal {
        let a = (t0 + segment.t0).max(from);
        let b = (t0 + segment.t1).min(to);
        for (d, m) in depth.iter_mut().zip(segment.majorant.0) {
            *d += f64::from(m) * f64::from((b - a).max(0.0));
        }
    }
    depth
}

/// A collision on a ray with one of the media.
struct Found<'w, M: LocalMedia<N> + 'w, const N: usize> {
    traversal: M::Traversal<'w>,
    point: Vec3,
    member: Member<N>,
    /// Segment with the sum of all majorants.
    whole: MajorantSegment<N>,
}

/// The collision at a distance, with the medium that `label` selects: the same one for every hero. `None` in
/// empty space.
fn found_at<'w, M: LocalMedia<N>, C: Components<N>, const N: usize>(
    world: &'w World<'_, M, C, N>,
    ray: &Ray,
    (t, label): (f32, f32),
) -> Option<Found<'w, M, N>> {
    let (t0, mut traversal) = world.media.traverse(ray, f32::INFINITY)?;
    let local = t - t0;
    let whole = traversal.by_ref().find(|s| s.t0 <= local && local < s.t1)?;
    let member = traversal.draw(local, &whole, |_| 1.0, || label);
    Some(Found { traversal, point: ray.at(t), member, whole })
}

/// Probability of an event at a collision, found by bisection of the sampling routine.
fn probability<const N: usize>(collision: &Collision<N>, event: Event) -> f64 {
    let order = |e: Event| match e {
        Event::Absorption => 0,
        Event::Scattering => 1,
        Event::Null => 2,
    };
    let total = collision.tentative.hero();
    let at = |u: f64| order(collision.event_at((u * f64::from(total)) as f32));
    // Upper end of the random numbers that yield an event no later than `last` in the order.
    let up_to = |last: i32| {
        if at(1.0 - 1e-7) <= last {
            return 1.0;
        }
        let (mut low, mut high) = (0.0f64, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if at(middle) <= last { low = middle } else { high = middle }
        }
        if low == 0.0 { 0.0 } else { high }
    };
    let k = order(event);
    up_to(k) - up_to(k - 1)
}

/// Running products of the path density and the integrand.
struct Term<const N: usize> {
    /// Density under the sampling hero and technique.
    p: f64,
    /// Integrand, per component.
    f: [f64; N],
}

impl<const N: usize> Term<N> {
    fn scale(&mut self, by: [f64; N]) {
        for (f, by) in self.f.iter_mut().zip(by) {
            *f *= by;
        }
    }
}

/// Updates P, f and the estimator's weights for a segment sampled by the walk: P from the sampling
/// probabilities, f from the coefficients. Returns `None` if this hero cannot sample the segment.
fn walk<M: LocalMedia<N>, C: Components<N>, W: WalkWeights<N>, const N: usize>(
    world: &World<'_, M, C, N>,
    stretch: &Stretch,
    term: &mut Term<N>,
    weights: &mut W,
) -> Option<()> {
    let rule = EventRule::from(&world.settings);
    let mut t = 0.0;
    for step in &stretch.steps {
        pass(world, &stretch.ray, (t, step.t), term, weights);
        t = step.t;
        let Found { traversal, point, member, whole } = found_at(world, &stretch.ray, (t, step.label))?;
        let (medium, segment) = (traversal.medium(&member), member.segment);
        let place = Place::of(point, &member);
        let (part, p_part) = match place.control(medium, rule) {
            None => (Part::Whole, 1.0),
            Some((c, albedo)) => {
                let share = f64::from(c.hero()) / f64::from(segment.majorant.hero());
                if step.control {
                    (Part::Control(c, albedo), share)
                } else {
                    (Part::Rest(c, albedo), 1.0 - share)
                }
            }
        };
        let collision = place.collide(medium, rule, part).in_medium(&member);
        // The hero draws the distance from the sum of all majorants, and then the medium.
        let p_medium = f64::from(segment.majorant.hero()) / f64::from(whole.majorant.hero());
        let p_event = probability(&collision, step.event);
        term.p *= f64::from(whole.majorant.hero()) * p_medium * p_part * p_event;
        let all = medium.coefficients(member.inside, &segment);
        let of = |s: Sampled<N>| s.0.map(f64::from);
        let (absorbed, scattered, majorant) = (of(all.absorption), of(all.scattering), of(segment.majorant));
        match step.event {
            Event::Null => {
                term.scale(std::array::from_fn(|j| majorant[j] - absorbed[j] - scattered[j]));
                if term.p > 0.0 {
                    weights.null(&collision);
                }
            }
            Event::Scattering => {
                let share = match part {
                    Part::Whole => scattered,
                    Part::Control(c, albedo) => of(c * albedo),
                    Part::Rest(c, albedo) => {
                        let control = of(c * albedo);
                        std::array::from_fn(|j| scattered[j] - control[j])
                    }
                };
                term.scale(share);
                if term.p > 0.0 {
                    weights.scatter(&collision);
                }
            }
            Event::Absorption => unreachable!(),
        }
        if term.p <= 0.0 {
            return None;
        }
    }
    if stretch.steps.last().is_none_or(|s| s.event == Event::Null) {
        pass(world, &stretch.ray, (t, stretch.end), term, weights);
    }
    Some(())
}

fn pass<M: LocalMedia<N>, C: Components<N>, W: WalkWeights<N>, const N: usize>(
    world: &World<'_, M, C, N>,
    ray: &Ray,
    between: (f32, f32),
    term: &mut Term<N>,
    weights: &mut W,
) {
    let depth = majorant_depth(world, ray, between);
    term.p *= (-depth[0]).exp();
    term.scale(depth.map(|d| (-d).exp()));
    weights.pass(Sampled(depth.map(|d| d as f32)));
}

/// Updates the terms for a connection, where ratio tracking treats every tentative collision as null.
fn by_ratio<M: LocalMedia<N>, C: Components<N>, W: WalkWeights<N>, const N: usize>(
    world: &World<'_, M, C, N>,
    (ray, steps, end): (&Ray, &[Step], f32),
    term: &mut Term<N>,
    weights: &mut W,
) -> Option<()> {
    let mut t = 0.0;
    for step in steps {
        pass(world, ray, (t, step.t), term, weights);
        t = step.t;
        let Found { traversal, point, member, .. } = found_at(world, ray, (t, step.label))?;
        let segment = member.segment;
        let all = traversal.medium(&member).coefficients(member.inside, &segment);
        term.p *= f64::from(segment.majorant.hero());
        term.scale(std::array::from_fn(|j| {
            f64::from(segment.majorant[j]) - f64::from(all.absorption[j]) - f64::from(all.scattering[j])
        }));
        let collision = Collision::new(point, all, EventRule::from(&world.settings));
        weights.null_by_ratio(&collision.in_medium(&member));
    }
    pass(world, ray, (t, end), term, weights);
    Some(())
}

fn outgoing<const N: usize, W: WalkWeights<N>>(
    outgoing: &DirectionSample,
    term: &mut Term<N>,
    weights: &mut W,
) {
    term.p *= f64::from(outgoing.density);
    term.scale([f64::from(outgoing.value); N]);
    weights.choose_direction(outgoing);
}

/// Sum of the contributions of all heroes and techniques to a path, and its integrand, per component in the
/// order of hero 0.
struct Sums<const N: usize> {
    sums: [f64; N],
    f: [f64; N],
}

impl<const N: usize> Sums<N> {
    fn new() -> Self {
        Self { sums: [0.0; N], f: [f64::NAN; N] }
    }

    fn add(&mut self, hero: usize, term: &Term<N>, value: Sampled<N>) {
        for j in 0..N {
            // Component j of hero 0 is component j − hero of this hero.
            let own = (j + N - hero) % N;
            self.sums[j] += term.p * f64::from(value[own]) / N as f64;
            self.f[j] = term.f[own];
        }
    }

    /// Asserts that the sums equal the integrand; a path that no hero can sample is skipped.
    fn assert(&self, what: &str) {
        if self.f.iter().any(|f| f.is_nan()) {
            return;
        }
        let largest = self.f.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        for (sum, f) in self.sums.iter().zip(self.f) {
            assert!(
                (sum - f).abs() <= ROUNDING * (f.abs() + 1e-2 * largest),
                "{what}: {:?}, should be {:?}",
                self.sums,
                self.f
            );
        }
    }
}

/// Path to a light at the end of its last segment.
struct Path {
    stretches: Vec<Stretch>,
    light: usize,
    u: f32,
}

/// Media of a scene that are evaluated at the components of a path.
trait Media {
    type Local<'a, const N: usize>: LocalMedia<N>
    where
        Self: 'a;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> Self::Local<'_, N>;
}

/// The only medium of a scene.
struct Alone<'a, M>(&'a M, &'a PlacedMedium);

impl<M: Medium> Media for Alone<'_, M> {
    type Local<'a, const N: usize>
        = One<'a, M::Local<'a, N>>
    where
        Self: 'a;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> Self::Local<'_, N> {
        One { medium: self.0.local(components), placed: self.1 }
    }
}

/// All media of a scene.
struct All<'a>(&'a Scene);

impl Media for All<'_> {
    type Local<'a, const N: usize>
        = Several<'a, N>
    where
        Self: 'a;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> Several<'_, N> {
        Several::new(self.0.media.iter().map(|medium| &medium.placed), components, false)
    }
}

struct Setup<'a, M> {
    scene: &'a Scene,
    media: M,
    settings: Settings,
}

impl<M: Media> Setup<'_, M> {
    /// World whose hero is component `hero` of the path.
    fn world<C: Components<N>, const N: usize>(
        &self,
        path: &Path,
        hero: usize,
    ) -> World<'_, M::Local<'_, N>, C, N> {
        let u = (path.u + hero as f32 / N as f32).fract();
        let components = C::sample(u, Some(WavelengthSampling::Sensor));
        World {
            scene: self.scene,
            media: self.media.local(&components),
            components,
            settings: self.settings.path,
        }
    }

    /// Checks unidirectional sampling, next-event estimation, and their combination.
    fn two_techniques<W: Weights<N>, C: Components<N>, const N: usize>(&self, path: &Path, what: &str) {
        let (mut uni, mut nee, mut both) = (Sums::<N>::new(), Sums::<N>::new(), Sums::<N>::new());
        let heuristics = self.settings.path.heuristics;
        for hero in 0..N {
            let world = self.world::<C, N>(path, hero);
            let mut term = Term { p: 1.0, f: [1.0; N] };
            let mut weights = W::starting(&world.settings);
            let (last, before) = path.stretches.split_last().unwrap();
            let mut vertex = None;
            let mut possible = true;
            for (i, stretch) in before.iter().enumerate() {
                possible = possible && walk(&world, stretch, &mut term, &mut weights).is_some();
                let here = world.scattering_vertex(end_of(&world, stretch), &stretch.ray);
                if possible && i + 1 < before.len() {
                    let towards = world.directions(&here).towards(&here, path.stretches[i + 1].ray.direction);
                    outgoing(&towards, &mut term, &mut weights);
                }
                vertex = Some(here);
            }
            // A path whose start this hero cannot sample is sampled by the other heroes only.
            if !possible {
                continue;
            }
            let vertex: Vertex = vertex.unwrap();
            let towards = world.directions(&vertex).towards(&vertex, last.ray.direction);
            let light = world.aim_density(&vertex, path.light, &last.light_point());
            let after = (&last.ray, last.steps.as_slice(), last.end);

            let mut link_term = Term { p: term.p * f64::from(light), f: term.f };
            link_term.scale([f64::from(towards.value); N]);
            let mut link = weights.connect(&towards, light);
            by_ratio(&world, after, &mut link_term, &mut link).unwrap();
            nee.add(hero, &link_term, link.connected_only(Sampled::ONE, heuristics));
            both.add(hero, &link_term, link.connected_combined(Sampled::ONE, heuristics));

            outgoing(&towards, &mut term, &mut weights);
            if walk(&world, last, &mut term, &mut weights).is_some() {
                uni.add(hero, &term, weights.unidirectional(Sampled::ONE, heuristics));
                both.add(hero, &term, weights.combined(Sampled::ONE, light, heuristics));
            }
        }
        for (sums, name) in [(nee, "next event"), (both, "both")] {
            sums.assert(&format!("{what}, {name}"));
        }
        // Without MIS over heroes, a component whose own hero cannot sample the path gets no contribution.
        if heuristics.components == Heuristic::Balance {
            uni.assert(&format!("{what}, unidirectional"));
        }
    }

    /// Checks the combination with a third technique, equiangular sampling of the last vertex.
    fn three_techniques<C: Components<N>, const N: usize>(&self, path: &Path, what: &str) {
        let mut all = Sums::<N>::new();
        let heuristics = self.settings.path.heuristics;
        for hero in 0..N {
            let world = self.world::<C, N>(path, hero);
            let mut term = Term { p: 1.0, f: [1.0; N] };
            let mut weights = EquiangularWeights::<N>::starting(&world.settings);
            let (last, before) = path.stretches.split_last().unwrap();
            let (scattering, before) = before.split_last().unwrap();
            let mut possible = true;
            for (i, stretch) in before.iter().enumerate() {
                possible = possible && walk(&world, stretch, &mut term, &mut weights).is_some();
                let here = world.scattering_vertex(end_of(&world, stretch), &stretch.ray);
                if possible {
                    outgoing(
                        &world.directions(&here).towards(&here, path.stretches[i + 1].ray.direction),
                        &mut term,
                        &mut weights,
                    );
                }
            }
            if !possible {
                continue;
            }
            let passage = Passage::through(&world.media, &scattering.ray, f32::INFINITY);
            let step = scattering.steps.last().unwrap();
            let at = end_of(&world, scattering);
            let point = at.point;
            let vertex = world.scattering_vertex(at, &scattering.ray);
            let towards = world.directions(&vertex).towards(&vertex, last.ray.direction);
            let nee = world.aim_density(&vertex, path.light, &last.light_point());
            let reached = Reached::through(passage, at);
            let light: LightDensities = reached.light_densities(&world, path.light, point, nee);
            let after = (&last.ray, last.steps.as_slice(), last.end);

            // Equiangular sampling.
            if let Some(pivot) = self.scene.lights[path.light].center() {
                let nulls = &scattering.steps[..scattering.steps.len() - 1];
                let mut term = Term { p: term.p, f: term.f };
                let mut link = weights;
                by_ratio(&world, (&scattering.ray, nulls, step.t), &mut term, &mut link).unwrap();
                let choice =
                    |at| self.scene.light_choice.probability(path.light, at, self.settings.path.lights);
                let Found { traversal, member, whole, .. } =
                    found_at(&world, &scattering.ray, (step.t, step.label)).unwrap();
                // The medium is drawn by the mean of its majorant over the components.
                let share = member.segment.majorant.mean() / whole.majorant.mean();
                let by_angle =
                    passage.unwrap().density(pivot, step.t) * choice(scattering.ray.origin) * share;
                let rule = EventRule::from(&world.settings);
                let collision =
                    Place::of(point, &member).collide(traversal.medium(&member), rule, Part::Whole);
                let collision = collision.in_medium(&member);
                link.scatter_equiangular(&collision, by_angle);
                let aim = nee / choice(point);
                let densities = LightDensities { nee, eq: aim };
                let mut link = link.connect_equiangular(&towards, densities);
                term.p *= f64::from(by_angle) * f64::from(aim);
                term.scale(collision.coefficients.scattering.0.map(f64::from));
                term.scale([f64::from(towards.value); N]);
                by_ratio(&world, after, &mut term, &mut link).unwrap();
                all.add(hero, &term, link.connected_equiangular(Sampled::ONE, heuristics));
            }
            if walk(&world, scattering, &mut term, &mut weights).is_none() {
                continue;
            }
            let mut link_term = Term { p: term.p * f64::from(nee), f: term.f };
            link_term.scale([f64::from(towards.value); N]);
            let mut link = weights.connect(&towards, light);
            by_ratio(&world, after, &mut link_term, &mut link).unwrap();
            all.add(hero, &link_term, link.connected(Sampled::ONE, heuristics));

            outgoing(&towards, &mut term, &mut weights);
            if walk(&world, last, &mut term, &mut weights).is_some() {
                all.add(hero, &term, weights.combined(Sampled::ONE, light, heuristics));
            }
        }
        all.assert(&format!("{what}, equiangular"));
    }

    /// Returns a random path with one or two scattering vertices; `None` if a collision lies in empty space
    /// or a coefficient is too close to its bound.
    fn random_path<C: Components<N>, const N: usize>(&self, random: &mut Sampler) -> Option<Path> {
        let mut path = Path { stretches: Vec::new(), light: 0, u: random.next_1d() };
        let world = self.world::<C, N>(&path, 0);
        let mut ray =
            Ray { origin: Vec3::new(0.3, 0.2, 2.0), direction: (Vec3::new(0.05, -0.04, -2.0)).normalize() };
        let vertices = 1 + usize::from(random.next_1d() < 0.6);
        for vertex in 0..=vertices {
            let (t0, traversal) = world.media.traverse(&ray, f32::INFINITY)?;
            let length = traversal.t_end().min(20.0);
            let to_light = vertex == vertices;
            let last = if to_light { 1.0 } else { 0.2 + 0.7 * random.next_1d() };
            let nulls = (random.next_1d() * 3.0) as usize;
            let mut ts: Vec<f32> = (0..nulls).map(|_| t0 + length * last * random.next_1d()).collect();
            ts.sort_by(f32::total_cmp);
            let labels = [(); 4].map(|()| random.next_1d());
            let step =
                |(i, t): (usize, f32), event, control| Step { t, event, control, label: labels[i % 4] };
            let mut steps: Vec<_> =
                ts.into_iter().enumerate().map(|at| step(at, Event::Null, false)).collect();
            if !to_light {
                let at = (3, t0 + length * last);
                steps.push(step(at, Event::Scattering, random.next_1d() < 0.5));
            }
            for s in &mut steps {
                let Found { traversal, point, member, .. } = found_at(&world, &ray, (s.t, s.label))?;
                let (medium, segment) = (traversal.medium(&member), member.segment);
                let extinction = medium.coefficients(member.inside, &segment).extinction();
                // Where a bound is tight, the difference to it is mostly rounding error.
                let tight = |rest: Sampled<N>, whole: Sampled<N>| {
                    rest.abs().zip(whole, |r, w| if r < 1e-2 * w { 1.0 } else { 0.0 }).max_component() > 0.0
                };
                if s.event == Event::Null && tight(segment.majorant - extinction, segment.majorant) {
                    return None;
                }
                let place = Place::of(point, &member);
                let control = place.control(medium, EventRule::from(&world.settings));
                if let (Event::Scattering, Some((control, _))) = (s.event, control) {
                    s.control |= tight(extinction - control, extinction);
                }
            }
            let end = path.stretches.len();
            path.stretches.push(Stretch { ray, steps, end: f32::INFINITY });
            if to_light {
                let last: &mut Stretch = &mut path.stretches[end];
                let surface = world.nearest_surface(&last.ray, false);
                path.light = world.arrivals(&last.ray, &surface, false).last()?.index;
                last.end = surface.t();
            } else {
                let stretch = &path.stretches[end];
                let origin = stretch.ray.at(stretch.steps.last()?.t);
                // Towards the lamp, with probability 1/2.
                let lamp = Vec3::new(0.9, 1.1, 0.2);
                let direction = if random.next_1d() < 0.5 {
                    let u = random.next_2d();
                    lamp + 0.3 * Vec3::new(u.x - 0.5, u.y - 0.5, random.next_1d() - 0.5) - origin
                } else {
                    let u = random.next_2d();
                    let z = 2.0 * u.x - 1.0;
                    let (sin, cos) = (std::f32::consts::TAU * u.y).sin_cos();
                    Vec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + Vec3::Z * z
                };
                ray = Ray { origin, direction: direction.normalize() };
            }
        }
        Some(path)
    }

    fn check<C: Components<N>, const N: usize>(&self, paths: usize, what: &str) -> usize {
        let mut random = Sampler::new(29, paths as u64, 0);
        let mut found = 0;
        for _ in 0..paths * 12 {
            let Some(path) = self.random_path::<C, N>(&mut random) else { continue };
            found += 1;
            if found > paths {
                break;
            }
            let what = format!("{what}, path {found}");
            self.two_techniques::<PathWeights<N>, C, N>(&path, &format!("{what}, rescaled"));
            self.two_techniques::<WeightsApart<f64, N>, C, N>(&path, &format!("{what}, apart"));
            if self.settings.path.heuristics == Heuristics::default() {
                self.two_techniques::<WeightsPairwise<N>, C, N>(&path, &format!("{what}, pairwise"));
            }
            if self.settings.path.distances == DistanceSampling::Delta {
                self.three_techniques::<C, N>(&path, &what);
            }
        }
        found
    }
}

/// Point at which a segment that ends in scattering ends.
fn end_of<M: LocalMedia<N>, C: Components<N>, const N: usize>(
    world: &World<'_, M, C, N>,
    stretch: &Stretch,
) -> ScatteringPoint {
    let step = stretch.steps.last().unwrap();
    let Found { point, member, .. } = found_at(world, &stretch.ray, (step.t, step.label)).unwrap();
    ScatteringPoint { point, medium: member.index, share: member.share }
}

/// A second medium: chromatic in another way, with another phase function, half beside the first.
const BESIDE: &str = "
        [[media]]
        name = 'beside'
        extinction = '430:0.7, 540:2.5, 620:1'
        albedo = '430:0.3, 620:0.95'
        phase = { kind = 'henyey-greenstein', g = -0.5 }
        placement = { scale = [0.8, 0.7, 1.4], translate = [0.1, 0.2, -0.3] }";

/// A third medium, without a grid and beyond the others.
const AROUND: &str = "
        [[media]]
        name = 'around'
        extinction = '430:0.2, 620:0.1'
        albedo = 0.8
        within = 'everywhere'
        extent = 3.0";

/// Names and TOML of the media.
fn grids() -> Vec<(&'static str, String)> {
    let rough = "density = { kind = 'grid', file = 'rough.npy' }\nplacement = { fit = 1.0 }";
    let colours = "density = { kind = 'rgb-grid', file = 'colours.npy' }\nplacement = { fit = 1.0 }";
    vec![
        ("uniform", "density = { kind = 'uniform' }".to_owned()),
        ("constant", rough.replace("rough", "constant")),
        ("rough", rough.to_owned()),
        ("colours", colours.to_owned()),
        (
            "rough and uniform",
            format!(
                "{rough}
{BESIDE}"
            ),
        ),
        (
            "colours, uniform and a ball",
            format!(
                "{colours}
{BESIDE}
{AROUND}"
            ),
        ),
    ]
}

fn files() -> Library {
    let rough: Vec<f32> = (0..64).map(|i| 0.3 + 0.7 * ((i * 37 % 64) as f32 / 64.0)).collect();
    let colours: Vec<f32> = (0..192).map(|i| 0.5 + 2.0 * ((i * 53 % 192) as f32 / 192.0)).collect();
    Library::default()
        .with_volume("constant.npy", npy([4, 4, 4], 1, &[1.0; 64]))
        .with_volume("rough.npy", npy([4, 4, 4], 1, &rough))
        .with_volume("colours.npy", npy([4, 4, 4], 3, &colours))
}

fn document(grid: &str, mode: &str) -> SceneDoc {
    let toml = format!(
        "majorant = 2
        [[media]]
        extinction = \"430:3, 540:1.2, 620:2\"
        albedo = \"430:0.9, 620:0.5\"
        phase = {{ kind = \"henyey-greenstein\", g = 0.4 }}
        {grid}
        [[lights]]
        kind = \"environment\"
        scale = 0.5
        [[lights]]
        kind = \"sphere\"
        center = [0.9, 1.1, 0.2]
        radius = 0.25
        scale = 6.0
        [estimator]
        mode = \"{mode}\""
    );
    scene_file::parse(&toml, "path space").unwrap()
}

/// Checks all distance and event sampling methods × tight, loose and exceeded majorants × grids × forms of
/// the path weights × heuristics × light sampling × direction sampling.
#[test]
fn contributions_of_all_heroes_and_techniques_sum_to_the_integrand() {
    let heuristics = [Heuristic::Balance, Heuristic::Power, Heuristic::Maximum, Heuristic::HeroOnly];
    let (mut setups, mut paths) = (0usize, 0);
    for (name, grid) in grids() {
        for mode in ["spectral", "rgb"] {
            for distances in
                [DistanceSampling::Delta, DistanceSampling::WeightedDelta, DistanceSampling::Decomposition]
            {
                for factor in [0.5f32, 1.0, 1.7] {
                    for absorption in [Absorption::Weighted, Absorption::Analogue] {
                        let mut doc = document(&grid, mode);
                        doc.estimator.distances = distances;
                        for medium in &mut doc.media {
                            medium.majorant.factor = factor;
                        }
                        doc.estimator.absorption = absorption;
                        // The remaining settings cycle, so that each of their values occurs with all of the
                        // above.
                        for medium in &mut doc.media {
                            medium.majorant.shared = setups % 5 == 1;
                        }
                        doc.estimator.heuristics.components = heuristics[setups % 4];
                        doc.estimator.heuristics.techniques = heuristics[setups / 4 % 3];
                        if setups % 2 == 0 {
                            doc.estimator.heuristics = Heuristics::default();
                        }
                        doc.estimator.lights =
                            [LightSelection::Uniform, LightSelection::Power, LightSelection::Contribution]
                                [setups % 3];
                        if setups % 7 < 3 {
                            doc.estimator.light_sampling = LightSampling::Product;
                        }
                        doc.estimator.directions = [
                            DirectionSampling::Phase,
                            DirectionSampling::TowardsLights,
                            DirectionSampling::Product,
                        ][setups / 2 % 3];
                        setups += 1;
                        let scene = build(&doc, &mut files()).unwrap();
                        let settings = Settings::new(&doc.estimator, 0);
                        let what = format!(
                            "{name}, {mode}, {distances:?}, factor {factor}, {absorption:?}, {:?}, shared {}",
                            doc.estimator.heuristics, doc.media[0].majorant.shared
                        );
                        paths += match &*scene.media {
                            [only] => match &only.placed.medium {
                                AnyMedium::Homogeneous(m) => {
                                    check(&scene, Alone(m, &only.placed), settings, &what)
                                }
                                AnyMedium::DensityGrid(m) => {
                                    check(&scene, Alone(m, &only.placed), settings, &what)
                                }
                                AnyMedium::RgbGrids(_) => check(&scene, All(&scene), settings, &what),
                            },
                            _ => check(&scene, All(&scene), settings, &what),
                        };
                    }
                }
            }
        }
    }
    assert!(setups == 216 && paths > 40 * setups, "{paths} paths in {setups} setups");
}

fn check(scene: &Scene, media: impl Media, settings: Settings, what: &str) -> usize {
    let setup = Setup { scene, media, settings };
    match settings.mode {
        majorant_core::scene::Mode::Spectral => setup.check::<Wavelengths<4>, 4>(50, what),
        majorant_core::scene::Mode::Rgb => setup.check::<RgbChannels<3>, 3>(50, what),
    }
}
