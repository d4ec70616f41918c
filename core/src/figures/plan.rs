//! Documents that a figure renders.

use super::figure::{Panel, REPORT, Strip};
use super::{FiguresError, Options, volume};
use crate::estimator::validate;
use crate::io::{embedded, scene_file};
use crate::scene::{CompareDoc, Fairness, Limits, SceneDoc};

impl Strip {
    /// The scene with its own settings, at the requested size and with the requested volume.
    ///
    /// # Errors
    /// When the scene is missing, or the size or volume is invalid.
    pub fn scene_doc(&self, options: &Options) -> Result<SceneDoc, FiguresError> {
        let (figure, scene) = (self.name, self.scene);
        let found = embedded::find(scene).ok_or(FiguresError::NoScene { figure, scene })?;
        let mut doc = scene_file::parse(found.toml, scene)?;
        doc.compare = CompareDoc::default();
        [doc.film.width, doc.film.height] = options.size.unwrap_or(self.size);
        doc.render.threads = options.threads;
        if let Some(own) = options.volume(self.stage) {
            volume::replace(&mut doc, &own.file)?;
        }
        match validate(&doc).into_iter().next() {
            Some(problem) => Err(FiguresError::Invalid { figure, problem }),
            None => Ok(doc),
        }
    }

    /// The panels as views of one scene, with the settings of the report and a different seed each.
    ///
    /// # Errors
    /// When a setting does not apply.
    pub fn panels_doc(&self, scene: &SceneDoc, options: &Options) -> Result<SceneDoc, FiguresError> {
        let mut docs = self.panels.iter().map(|panel| with(scene, panel, REPORT));
        let mut doc = docs.next().transpose()?.unwrap_or_else(|| scene.clone());
        for panel in docs {
            let Some(mut view) = panel?.view_overrides(0) else { continue };
            view.seed = doc.free_seed();
            doc.compare.views.push(view);
        }
        doc.compare.fairness = Fairness::Samples;
        doc.render.set_limits(Limits::samples(options.spp));
        Ok(doc)
    }

    /// The reference, with the settings of the scene, which have the same expectation and less noise, and
    /// with random numbers that no panel uses.
    ///
    /// # Errors
    /// When a setting does not apply.
    pub fn reference_doc(&self, scene: &SceneDoc, options: &Options) -> Result<SceneDoc, FiguresError> {
        /// Seed far from those of panels and study.
        const SEED: u64 = 0x5eed_0000;
        let mut doc = with(scene, &self.reference, &["estimator.absorption=weighted"])?.unbiased();
        doc.render.seed = SEED;
        doc.render.set_limits(Limits::samples(options.reference_spp));
        Ok(doc)
    }
}

/// A scene with the estimator of a panel, the settings of `first`, and then those of the panel.
fn with(scene: &SceneDoc, panel: &Panel, first: &[&str]) -> Result<SceneDoc, FiguresError> {
    let mut edits = vec![format!("estimator.id={:?}", panel.estimator)];
    edits.extend(first.iter().chain(panel.set).map(|edit| (*edit).to_owned()));
    Ok(scene_file::override_keys(scene, &edits)?)
}

#[cfg(test)]
mod tests {
    use crate::estimator::{self, validate};
    use crate::figures::{Cell, FIGURES, Options, find};
    use crate::scene::Absorption;
    use crate::spectrum::WavelengthSampling;

    #[test]
    fn every_figure_is_made_of_documents_that_render_and_of_cells_that_exist() {
        let options = Options::default();
        let strips: Vec<_> = FIGURES.iter().flat_map(|f| f.strips).collect();
        for strip in &strips {
            let scene = strip.scene_doc(&options).unwrap();
            let panels = strip.panels_doc(&scene, &options).unwrap();
            let reference = strip.reference_doc(&scene, &options).unwrap();
            assert_eq!((validate(&panels), validate(&reference)), (vec![], vec![]), "{}", strip.name);
            let docs = panels.view_docs();
            assert_eq!(docs.len(), strip.panels.len(), "{}", strip.name);
            for (doc, panel) in docs.iter().zip(strip.panels) {
                let entry = estimator::find(panel.estimator).unwrap();
                assert_eq!((entry.bias(doc), doc.render.spp), (None, Some(64)), "{}", strip.name);
                assert_eq!(doc.estimator.wavelengths, WavelengthSampling::Uniform);
                assert_eq!(doc.medium().majorant.resolution, Some(1));
                // Panels and reference converge to the same image.
                assert_eq!(doc.target_part(), reference.target_part(), "{}", strip.name);
                assert_ne!(doc.render.seed, reference.render.seed);
            }
            assert_eq!(reference.render.spp, Some(1024));
            assert!(strip.cells.iter().all(|c| match c {
                Cell::Panel(panel) => *panel < strip.panels.len(),
                Cell::Reference => true,
            }));
            // Images keep the aspect ratio of the scene.
            let full = crate::io::embedded::find(strip.scene).unwrap();
            let film = crate::io::scene_file::parse(full.toml, strip.scene).unwrap().film;
            assert_eq!(strip.size[0] * film.height, strip.size[1] * film.width, "{}", strip.name);
        }
        let mut names: Vec<_> = strips.iter().map(|s| s.name).collect();
        names.dedup();
        assert_eq!(names.len(), strips.len());
        assert!(find("5").is_none() && FIGURES.iter().all(|f| find(f.id).is_some()));
    }

    #[test]
    fn figure_4_differs_in_absorption_only() {
        let options = Options::default();
        let strip = find("4").unwrap().strips[0];
        let doc = strip.panels_doc(&strip.scene_doc(&options).unwrap(), &options).unwrap();
        let [mut weighted, analogue] = <[_; 2]>::try_from(doc.view_docs()).unwrap();
        assert_eq!(weighted.estimator.absorption, Absorption::Weighted);
        weighted.estimator.absorption = Absorption::Analogue;
        weighted.render.seed = analogue.render.seed;
        assert_eq!(weighted, analogue);
    }
}
