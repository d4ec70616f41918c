//! Path weights of a recorded path: f, p_uni and p_nee after every event, from their definition.
//!
//! They are products over the events of the path (Miller, Georgiev and Jarosz 2019, section 4). They are
//! computed independently of the estimator, as logarithms in double precision, so that the estimator's
//! weights can be compared with their definition:
//!
//! ```text
//!   with the balance heuristics, a contribution is   Le_j f_j / mean_i (p_uni,i + p_nee,i)
//! ```
//!
//! Each row also has the numbers that the estimator itself stores, rescaled or not, after the same event.

use super::Recording;
use super::path_densities::PathDensities;
use super::product::{Product, times};
use super::step::{Branch, Step};
use crate::scene::Heuristics;
use crate::spectrum::{Carried, Lanes};
use crate::transport::{CollisionRecord, Event, Note, Technique, WeightRecord};
use glam::Vec3;

/// Contribution to the estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contribution {
    /// Technique that sampled it.
    pub technique: Technique,
    /// Number of real vertices on the path: 0 for light seen directly by the camera.
    pub order: u32,
    /// Number of null collisions on the path.
    pub nulls: u32,
    /// Emitted radiance.
    pub emitted: Lanes,
    /// Contribution computed by the estimator, per component.
    pub value: Lanes,
    /// Contribution as linear sRGB on the film.
    pub film: Vec3,
    /// Contribution by the definition of the balance heuristic; `None` if the path has no density under the
    /// estimator.
    pub by_definition: Option<Lanes>,
}

/// Event of a path, with its path weights after the event.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Index of the note in the recording.
    pub note: usize,
    /// Part of the path.
    pub branch: Branch,
    /// Kind of event.
    pub step: Step,
    /// Position, if the event has one.
    pub point: Option<Vec3>,
    /// Random numbers that determined the event.
    pub numbers: Vec<f32>,
    /// Coefficients of the medium at the event.
    pub found: Option<CollisionRecord>,
    /// Contribution f, per component.
    pub f: [Product; 4],
    /// Density of the path under unidirectional sampling.
    pub uni: [Product; 4],
    /// Density of the path under next-event estimation, without the density of the light. Valid within
    /// connections, and from the new direction at a vertex on; at a vertex just reached it is still the
    /// density of the segment that leads there.
    pub nee: [Product; 4],
    /// Density under equiangular sampling of the vertex, on an equiangular branch; `None` elsewhere.
    pub eq: Option<[Product; 4]>,
    /// Path weights stored by the estimator for this branch, after the event; `None` where it stores none, as
    /// for a connection whose transmittance has no density.
    pub kept: Option<WeightRecord>,
    /// Contribution added by the event.
    pub contribution: Option<Contribution>,
}

/// Events of a path with their path weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    /// Components of the path.
    pub carried: Carried,
    /// The events, in order.
    pub rows: Vec<Row>,
    /// Sum of all contributions, per component.
    pub sum: Lanes,
    /// Estimate as linear sRGB, as added to the film.
    pub film: Vec3,
}

/// Path weights of all branches of a path while its notes are read.
struct LedgerBuilder {
    path: PathDensities,
    link: Option<PathDensities>,
    walk: Option<PathDensities>,
    equiangular: Option<PathDensities>,
    /// Factors of f and p_uni of the connection that starts next.
    adjusted: Option<(Lanes, Lanes)>,
    /// Path weights at the start of the current ray.
    ray: PathDensities,
    carried: Carried,
    /// Whether both heuristics are the balance heuristic, for which contributions can be computed by
    /// definition.
    balanced: bool,
    found: Option<CollisionRecord>,
    /// First row of the current ray.
    ray_row: usize,
    rows: Vec<Row>,
}

impl Ledger {
    /// Computes the path weights of a recorded path.
    #[must_use]
    pub fn new(recording: &Recording) -> Self {
        let mut builder = LedgerBuilder {
            path: PathDensities::CAMERA,
            link: None,
            walk: None,
            equiangular: None,
            adjusted: None,
            ray: PathDensities::CAMERA,
            carried: Carried::Grey,
            balanced: recording.settings.path.heuristics == Heuristics::default(),
            found: None,
            ray_row: 0,
            rows: Vec::new(),
        };
        let (mut sum, mut film) = ([0.0; 4], Vec3::ZERO);
        for (i, note) in recording.notes.iter().enumerate() {
            if let Note::End { sum: all, film: rgb } = note {
                (sum, film) = (*all, *rgb);
            }
            builder.read(i, note);
        }
        Self { carried: builder.carried, rows: builder.rows, sum, film }
    }

    /// Contributions, in order.
    pub fn contributions(&self) -> impl Iterator<Item = &Contribution> {
        self.rows.iter().filter_map(|row| row.contribution.as_ref())
    }

    /// Sum of the contributions, in the estimator's order of summation.
    #[must_use]
    pub fn added(&self) -> Lanes {
        let add = |sum: Lanes, entry: &Contribution| std::array::from_fn(|i| sum[i] + entry.value[i]);
        self.contributions().fold([0.0; 4], add)
    }
}

impl LedgerBuilder {
    fn branch(&self) -> Branch {
        match (&self.link, &self.walk, &self.equiangular) {
            (_, _, Some(_)) => Branch::Equiangular,
            (Some(_), _, _) => Branch::Connection,
            (_, Some(_), _) => Branch::LightWalk,
            _ => Branch::Path,
        }
    }

    /// Path weights of the current branch.
    fn now(&mut self) -> &mut PathDensities {
        self.link.as_mut().or(self.walk.as_mut()).or(self.equiangular.as_mut()).unwrap_or(&mut self.path)
    }

    fn row(&mut self, note: usize, step: Step, point: Option<Vec3>, numbers: &[f32]) -> &mut Row {
        let (branch, densities) = (self.branch(), *self.now());
        self.rows.push(Row {
            note,
            branch,
            step,
            point,
            numbers: numbers.to_vec(),
            found: None,
            f: densities.f,
            uni: densities.uni,
            nee: densities.nee,
            eq: (branch == Branch::Equiangular).then_some(densities.eq),
            kept: densities.kept,
            contribution: None,
        });
        let last = self.rows.len() - 1;
        &mut self.rows[last]
    }

    /// Adds the row of an event whose path weights the estimator has yet to report.
    fn event(&mut self, note: usize, step: Step, point: Option<Vec3>, numbers: &[f32]) -> &mut Row {
        let next = self.rows.len();
        let densities = self.now();
        (densities.kept, densities.awaiting) = (None, Some(next));
        self.row(note, step, point, numbers)
    }

    /// Stores the path weights that the estimator reports for the current branch after its last event.
    fn keeps(&mut self, kept: WeightRecord) {
        let densities = self.now();
        densities.kept = Some(kept);
        let Some(row) = densities.awaiting.take() else { return };
        if self.ray.awaiting == Some(row) {
            (self.ray.kept, self.ray.awaiting) = (Some(kept), None);
        }
        if let Some(row) = self.rows.get_mut(row) {
            row.kept = Some(kept);
        }
    }

    /// Starts a new ray of the path.
    fn begin_ray(&mut self) {
        (self.ray, self.ray_row) = (self.path, self.rows.len());
    }

    fn read(&mut self, i: usize, note: &Note) {
        match *note {
            Note::Camera { ray, jitter, u, carried } => {
                self.carried = carried;
                self.event(i, Step::Camera, Some(ray.origin), &[jitter.x, jitter.y, u]);
                self.begin_ray();
            }
            Note::Collision(found, kept) => self.collide(i, found, kept),
            Note::Exit { passed, weight_record: kept } => {
                self.now().pass(&passed);
                self.keeps(kept);
                self.row(i, Step::Exit, None, &[]);
            }
            Note::Weights(kept) => self.keeps(kept),
            Note::Drawn { event, u } => self.drawn(i, event, u),
            Note::DrawnForAll { event, u, density } => self.drawn_for_all(i, event, u, density),
            Note::Flight { scattered_at, weight } => {
                // The weight includes all collisions of the flight; the path's own weight has not changed on
                // the way.
                for row in self.rows.iter_mut().skip(self.ray_row).filter(|row| row.branch == Branch::Path) {
                    row.kept = self.ray.kept;
                }
                self.path = PathDensities { defined: false, order: self.path.order, ..self.ray };
                times(&mut self.path.f, &weight);
                let step = if scattered_at.is_some() { Step::Scatter } else { Step::Exit };
                self.event(i, step, scattered_at, &[]);
            }
            Note::Surface { point, albedo } => {
                times(&mut self.now().f, &albedo);
                self.event(i, Step::Reflect, Some(point), &[]);
            }
            Note::Vertex(kept) => {
                self.path.order += 1;
                self.keeps(kept);
            }
            Note::Roulette { u, q } => {
                if u < q {
                    times(&mut self.path.f, &[1.0 / q; 4]);
                    self.event(i, Step::Survive(q), None, &[u]);
                    // If roulette comes after the new direction, its factor belongs to the ray, too.
                    self.begin_ray();
                } else {
                    self.row(i, Step::Terminate(q), None, &[u]);
                }
            }
            Note::Direction { ray, u, value, density } => {
                self.path.choose_direction(value, density);
                self.event(i, Step::Direction(value, density), Some(ray.origin), &u.to_array());
                self.begin_ray();
            }
            Note::Boundary { ray, u, value, density, is_specular } => {
                self.path.leave(&value, &density, !is_specular);
                self.event(i, Step::Direction(value[0], density[0]), Some(ray.origin), &u.to_array());
                self.begin_ray();
            }
            Note::Adjusted { value, density } => self.adjusted = Some((value, density)),
            Note::Connect { ray, value, walk_density, light_density, .. } => {
                let from = self.equiangular.unwrap_or(self.path);
                let mut link = from.connected(value, walk_density, light_density);
                if let Some((value, density)) = self.adjusted.take() {
                    link.adjust(&value, &density);
                }
                self.link = Some(link);
                let step = Step::Connect(value, walk_density, light_density);
                self.event(i, step, Some(ray.origin), &[]);
            }
            Note::Transmittance { estimate } => {
                let densities = self.now();
                densities.defined = false;
                times(&mut densities.f, &estimate);
                self.event(i, Step::Transmittance, None, &[]);
            }
            Note::Connected { arrives } => {
                if !arrives {
                    self.row(i, Step::NoContribution, None, &[]);
                    self.link = None;
                }
            }
            Note::LightWalk => self.walk = Some(self.path),
            Note::LightWalkEnds => self.walk = None,
            Note::EquiangularVertex => {
                self.equiangular = Some(self.path.begin_equiangular());
                // From here on there is a third density.
                self.path.defined = false;
            }
            Note::EquiangularVertexSampled { found, density, choice, weight_record } => {
                self.now().scatter_equiangular(&found, density, choice);
                self.event(i, Step::Scatter, Some(found.point), &[]).found = Some(found);
                self.keeps(weight_record);
            }
            Note::EquiangularVertexEnds => (self.equiangular, self.link) = (None, None),
            Note::Contribution { technique, emitted, other_density, value, film } => {
                self.contribution(i, (technique, other_density), emitted, value, film);
            }
            Note::End { .. } => {}
        }
    }

    fn collide(&mut self, i: usize, found: CollisionRecord, kept: WeightRecord) {
        self.now().pass(&found.passed);
        self.keeps(kept);
        // Connections treat every collision as null; walks sample the type.
        if matches!(self.branch(), Branch::Connection | Branch::Equiangular) {
            self.now().null(&found);
            self.event(i, Step::Null, Some(found.point), &[]).found = Some(found);
        } else {
            self.row(i, Step::Collision, Some(found.point), &[]).found = Some(found);
            self.found = Some(found);
        }
    }

    /// Merges the sampled event into the row of its collision.
    fn drawn(&mut self, i: usize, event: Event, u: f32) {
        let Some(found) = self.found.take() else { return };
        match event {
            Event::Null => self.now().null(&found),
            Event::Scattering => self.now().scatter(&found),
            Event::Absorption => {}
        }
        self.outcome(i, event, u, found);
    }

    /// As [`Self::drawn`], with one density for all components, which p_uni and p_nee share for any hero.
    fn drawn_for_all(&mut self, i: usize, event: Event, u: f32, density: f32) {
        let Some(found) = self.found.take() else { return };
        let densities = self.now();
        let factor = match event {
            Event::Null => Some(found.null),
            Event::Scattering => Some(found.scattering),
            Event::Absorption => None,
        };
        densities.nulls += u32::from(event == Event::Null);
        if let Some(factor) = factor {
            times(&mut densities.f, &factor);
            times(&mut densities.uni, &[density; 4]);
            times(&mut densities.nee, &[density; 4]);
        }
        self.outcome(i, event, u, found);
    }

    fn outcome(&mut self, note: usize, event: Event, u: f32, found: CollisionRecord) {
        let step = match event {
            Event::Null => Step::Null,
            Event::Scattering => Step::Scatter,
            Event::Absorption => Step::Absorb,
        };
        // The event replaces the row of its collision, unless a contribution of emission lies between them.
        if self.rows.last().is_some_and(|row| row.step == Step::Collision) {
            self.rows.pop();
        }
        let numbers = [u];
        let row = match event {
            // Absorption ends the path and leaves the weights unchanged.
            Event::Absorption => self.row(note, step, Some(found.point), &numbers),
            Event::Null | Event::Scattering => self.event(note, step, Some(found.point), &numbers),
        };
        row.found = Some(found);
    }

    fn contribution(
        &mut self,
        i: usize,
        (technique, other_density): (Technique, f32),
        emitted: Lanes,
        value: Lanes,
        film: Vec3,
    ) {
        let (count, grey) = (self.carried.count(), self.carried == Carried::Grey);
        let mut path = *self.now();
        path.defined &= self.balanced;
        let by_definition = match technique {
            Technique::Walk => {
                let mut nee = path.nee;
                times(&mut nee, &[other_density; 4]);
                let densities = if other_density > 0.0 { &[&path.uni, &nee][..] } else { &[&path.uni] };
                path.value(&emitted, densities, count, grey)
            }
            Technique::Connection => {
                let densities = if other_density > 0.0 { &[&path.nee, &path.uni][..] } else { &[&path.nee] };
                path.value(&emitted, densities, count, grey)
            }
            Technique::Emission => self.found.and_then(|found| {
                times(&mut path.f, &found.absorption);
                times(&mut path.uni, &found.tentative);
                path.value(&emitted, &[&path.uni], count, grey)
            }),
            Technique::Equiangular => path.value(&emitted, &[&path.uni, &path.nee, &path.eq], count, grey),
        };
        let vertices = path.order + u32::from(technique == Technique::Equiangular);
        let entry = Contribution {
            technique,
            order: vertices,
            nulls: path.nulls,
            emitted,
            value,
            film,
            by_definition,
        };
        self.row(i, Step::Contribution, None, &[]).contribution = Some(entry);
        if matches!(technique, Technique::Connection | Technique::Equiangular) {
            self.link = None;
        }
    }
}
