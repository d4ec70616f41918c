//! Cache of the majorant grids of a field, computed on first use.

use super::{Grid, Interpolation, MajorantGrid};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Maximum number of cells per axis.
pub const MAX_MAJORANT_CELLS: u32 = 128;

/// Cost of crossing a majorant cell, in density look-ups.
const CELL_COST: f32 = 0.12;

/// Majorant grids of one field, by resolution. Edits of scale, spectra or albedo only select among them;
/// voxels are read once per resolution.
#[derive(Debug)]
pub struct Majorants<const C: usize> {
    grid: Arc<Grid<C>>,
    trilinear: GridCache<C>,
    stochastic: GridCache<C>,
}

/// Cached grids for one kind of look-up.
#[derive(Debug)]
struct GridCache<const C: usize> {
    /// Powers of two, the coarsest first.
    levels: OnceLock<Vec<Arc<MajorantGrid<C>>>>,
    others: Mutex<BTreeMap<u32, Arc<MajorantGrid<C>>>>,
}

impl<const C: usize> Default for GridCache<C> {
    fn default() -> Self {
        Self { levels: OnceLock::new(), others: Mutex::default() }
    }
}

impl<const C: usize> Majorants<C> {
    /// Creates an empty cache for a field.
    #[must_use]
    pub fn new(grid: Arc<Grid<C>>) -> Self {
        Self { grid, trilinear: GridCache::default(), stochastic: GridCache::default() }
    }

    fn cache(&self, interpolation: Interpolation) -> &GridCache<C> {
        match interpolation {
            Interpolation::Trilinear => &self.trilinear,
            Interpolation::Stochastic => &self.stochastic,
        }
    }

    /// Grids from one cell to about one cell per two samples, at most [`MAX_MAJORANT_CELLS`] per axis.
    fn levels(&self, interpolation: Interpolation) -> &[Arc<MajorantGrid<C>>] {
        self.cache(interpolation).levels.get_or_init(|| {
            let longest = self.grid.size().into_iter().fold(1, usize::max) as u32;
            let finest = (longest.next_power_of_two() / 2).clamp(1, MAX_MAJORANT_CELLS);
            let mut level = MajorantGrid::new(&self.grid, finest as usize, interpolation);
            let mut levels = Vec::new();
            while let Some(half) = level.halved() {
                levels.push(Arc::new(std::mem::replace(&mut level, half)));
            }
            levels.push(Arc::new(level));
            levels.reverse();
            levels
        })
    }

    /// Returns the grid with `cells` per axis, for one kind of look-up.
    #[must_use]
    pub fn at(&self, cells: u32, interpolation: Interpolation) -> Arc<MajorantGrid<C>> {
        let cells = cells.clamp(1, MAX_MAJORANT_CELLS);
        let same = |level: &&Arc<MajorantGrid<C>>| level.cells() == cells as usize;
        if let Some(level) = self.levels(interpolation).iter().find(same) {
            return Arc::clone(level);
        }
        let cache = self.cache(interpolation);
        let mut others = cache.others.lock().unwrap_or_else(PoisonError::into_inner);
        let make = || Arc::new(MajorantGrid::new(&self.grid, cells as usize, interpolation));
        Arc::clone(others.entry(cells).or_insert_with(make))
    }

    /// Returns the grid with the lowest cost of free flights, where a field value of 1 corresponds to an
    /// optical depth of `extinction` across the box: finer cells cost more steps, coarser cells more null
    /// collisions.
    #[must_use]
    pub fn cheapest(&self, extinction: f32, interpolation: Interpolation) -> Arc<MajorantGrid<C>> {
        let cost = |level: &MajorantGrid<C>| {
            // A line through the box crosses up to three faces per cell and axis, half of that on average.
            CELL_COST * 1.5 * level.cells() as f32 + level.mean_bound() * extinction
        };
        let best = self.levels(interpolation).iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
        best.map_or_else(|| self.at(1, interpolation), Arc::clone)
    }
}
