//! A path's books: f, p_uni and p_nee event by event, as they are defined.
//!
//! They are products over the events of the path (Miller, Georgiev and Jarosz 2019, section 4), kept here apart from the
//! estimator, in logarithms of double precision, so that what its weights say can be held against their definition:
//!
//! ```text
//!   with the balance heuristics, light adds   Le_j f_j / mean_i (p_uni,i + p_nee,i)
//! ```
//!
//! Beside them stand the numbers that the estimator keeps itself, rescaled or not, as they are after the same event.

use super::Recording;
use super::path_densities::PathDensities;
use super::product::{Product, times};
use super::step::{Branch, Step};
use crate::scene::Heuristics;
use crate::spectrum::{Carried, Lanes};
use crate::transport::{CollisionRecord, Event, Note, Technique, WeightRecord};
use glam::Vec3;

/// Light that is added to the estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Credit {
    /// What has found it.
    pub technique: Technique,
    /// Real vertices on the path: 0 for light that the camera sees.
    pub order: u32,
    /// Null collisions on the path.
    pub nulls: u32,
    /// Emitted radiance.
    pub emitted: Lanes,
    /// What the estimator adds, component by component.
    pub value: Lanes,
    /// The same as linear sRGB on the film.
    pub film: Vec3,
    /// What it should add by the definition of the balance heuristic; `None` for an estimator whose path has no density.
    pub by_definition: Option<Lanes>,
}

/// An event of a path, and its books after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Index of the recording's note.
    pub note: usize,
    /// Which part of the path.
    pub branch: Branch,
    /// What has happened.
    pub step: Step,
    /// Where, if it is anywhere.
    pub point: Option<Vec3>,
    /// The random numbers that have decided it.
    pub numbers: Vec<f32>,
    /// The medium there.
    pub found: Option<CollisionRecord>,
    /// What the path contributes.
    pub f: [Product; 4],
    /// How likely unidirectional sampling makes it.
    pub uni: [Product; 4],
    /// How likely next-event estimation makes it, but for the density of the light. It means something in a connection and from
    /// the turn at a vertex on: at a vertex that was only reached it is still that of the way there.
    pub nee: [Product; 4],
    /// On a branch by angle how likely its vertex, drawn by angle, makes the path; `None` elsewhere.
    pub eq: Option<[Product; 4]>,
    /// The numbers that the estimator keeps of this branch, after the event; `None` where it keeps none, as of a
    /// connection whose weight has no density.
    pub kept: Option<WeightRecord>,
    /// Light that is added.
    pub credit: Option<Credit>,
}

/// A path's events with their books.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    /// What the components are.
    pub carried: Carried,
    /// The events, in order.
    pub rows: Vec<Row>,
    /// The sum of all that was added.
    pub sum: Lanes,
    /// Linear sRGB, as the film has received it.
    pub film: Vec3,
}

/// The books of all branches of a path while its notes are read.
struct Bookkeeper {
    path: PathDensities,
    link: Option<PathDensities>,
    walk: Option<PathDensities>,
    by_angle: Option<PathDensities>,
    /// As they were where the path's ray begins.
    ray: PathDensities,
    carried: Carried,
    /// Whether light is shared by the balance heuristics, whose result can be written down.
    balanced: bool,
    found: Option<CollisionRecord>,
    /// The first row of the path's last ray.
    ray_row: usize,
    rows: Vec<Row>,
}

impl Ledger {
    /// The books of a recorded path.
    #[must_use]
    pub fn new(recording: &Recording) -> Self {
        let mut bookkeeper = Bookkeeper {
            path: PathDensities::CAMERA,
            link: None,
            walk: None,
            by_angle: None,
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
            bookkeeper.read(i, note);
        }
        Self { carried: bookkeeper.carried, rows: bookkeeper.rows, sum, film }
    }

    /// Light that is added, in order.
    pub fn credits(&self) -> impl Iterator<Item = &Credit> {
        self.rows.iter().filter_map(|row| row.credit.as_ref())
    }

    /// The sum of what is added, formed as the estimator forms it.
    #[must_use]
    pub fn added(&self) -> Lanes {
        let add = |sum: Lanes, entry: &Credit| std::array::from_fn(|i| sum[i] + entry.value[i]);
        self.credits().fold([0.0; 4], add)
    }
}

impl Bookkeeper {
    fn branch(&self) -> Branch {
        match (&self.link, &self.walk, &self.by_angle) {
            (_, _, Some(_)) => Branch::Angle,
            (Some(_), _, _) => Branch::Connection,
            (_, Some(_), _) => Branch::LightWalk,
            _ => Branch::Path,
        }
    }

    /// The books of the branch at hand.
    fn now(&mut self) -> &mut PathDensities {
        self.link.as_mut().or(self.walk.as_mut()).or(self.by_angle.as_mut()).unwrap_or(&mut self.path)
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
            eq: (branch == Branch::Angle).then_some(densities.eq),
            kept: densities.kept,
            credit: None,
        });
        let last = self.rows.len() - 1;
        &mut self.rows[last]
    }

    /// The row of an event after which the estimator keeps other numbers, which it has still to tell.
    fn event(&mut self, note: usize, step: Step, point: Option<Vec3>, numbers: &[f32]) -> &mut Row {
        let next = self.rows.len();
        let densities = self.now();
        (densities.kept, densities.awaiting) = (None, Some(next));
        self.row(note, step, point, numbers)
    }

    /// What the estimator keeps of the branch at hand, after the last event of it.
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

    /// The path goes on along a new ray.
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
            Note::Exit { passed, kept } => {
                self.now().pass(&passed);
                self.keeps(kept);
                self.row(i, Step::Exit, None, &[]);
            }
            Note::Weights(kept) => self.keeps(kept),
            Note::Drawn { event, u } => self.drawn(i, event, u),
            Note::DrawnForAll { event, u, density } => self.drawn_for_all(i, event, u, density),
            Note::Flight { scattered_at, weight } => {
                // Its collisions are behind that weight: on the way the path's own has not changed.
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
                    // Where roulette comes after the turn, the ray has its factor too.
                    self.begin_ray();
                } else {
                    self.row(i, Step::Die(q), None, &[u]);
                }
            }
            Note::Leave { ray, u, value, density } => {
                self.path.leave(value, density);
                self.event(i, Step::Leave(value, density), Some(ray.origin), &u.to_array());
                self.begin_ray();
            }
            Note::Connect { ray, value, walk_density, light_density, .. } => {
                let from = self.by_angle.unwrap_or(self.path);
                self.link = Some(from.connected(value, walk_density, light_density));
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
                    self.row(i, Step::Dark, None, &[]);
                    self.link = None;
                }
            }
            Note::LightWalk => self.walk = Some(self.path),
            Note::LightWalkEnds => self.walk = None,
            Note::EquiangularVertex => {
                self.by_angle = Some(self.path.set_out_by_angle());
                // From here on there is a third density.
                self.path.defined = false;
            }
            Note::VertexByAngle { found, density, choice, kept } => {
                self.now().scatter_by_angle(&found, density, choice);
                self.event(i, Step::Scatter, Some(found.point), &[]).found = Some(found);
                self.keeps(kept);
            }
            Note::EquiangularVertexEnds => (self.by_angle, self.link) = (None, None),
            Note::Credit { technique, emitted, other_density, value, film } => {
                self.credit(i, (technique, other_density), emitted, value, film);
            }
            Note::End { .. } => {}
        }
    }

    fn collide(&mut self, i: usize, found: CollisionRecord, kept: WeightRecord) {
        self.now().pass(&found.passed);
        self.keeps(kept);
        // Connections take every collision as null; walks draw.
        if matches!(self.branch(), Branch::Connection | Branch::Angle) {
            self.now().null(&found);
            self.event(i, Step::Null, Some(found.point), &[]).found = Some(found);
        } else {
            self.row(i, Step::Collision, Some(found.point), &[]).found = Some(found);
            self.found = Some(found);
        }
    }

    /// The outcome joins the row of its collision.
    fn drawn(&mut self, i: usize, event: Event, u: f32) {
        let Some(found) = self.found.take() else { return };
        match event {
            Event::Null => self.now().null(&found),
            Event::Scattering => self.now().scatter(&found),
            Event::Absorption => {}
        }
        self.outcome(i, event, u, found);
    }

    /// As [`Self::drawn`], with one density for all components: p_uni and p_nee have that, whichever is the hero.
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
        // A collision where the medium glows has its light between; else the outcome takes its row.
        if self.rows.last().is_some_and(|row| row.step == Step::Collision) {
            self.rows.pop();
        }
        let numbers = [u];
        let row = match event {
            // The path ends with what it had.
            Event::Absorption => self.row(note, step, Some(found.point), &numbers),
            Event::Null | Event::Scattering => self.event(note, step, Some(found.point), &numbers),
        };
        row.found = Some(found);
    }

    fn credit(
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
        let entry =
            Credit { technique, order: vertices, nulls: path.nulls, emitted, value, film, by_definition };
        self.row(i, Step::Credit, None, &[]).credit = Some(entry);
        if matches!(technique, Technique::Connection | Technique::Equiangular) {
            self.link = None;
        }
    }
}
