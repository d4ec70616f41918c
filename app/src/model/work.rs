//! Work that an edit requires, determined by comparing documents instead of by widgets.

use majorant_core::scene::SceneDoc;
use majorant_core::scene::keys::{self, Affects, Key};

/// Minimum work that updates an image after an edit of its document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Work {
    /// The image is up to date; at most its display changes.
    None,
    /// Only limits changed: rendering continues or stops, and all samples are kept.
    Limits,
    /// The estimate changed: rendering restarts.
    Render,
}

/// Work required by the edit from `before` to `after`.
#[must_use]
pub fn work_after(before: &SceneDoc, after: &SceneDoc) -> Work {
    if before == after {
        return Work::None;
    }
    // A document that cannot be serialised has no keys to compare.
    let Some(changed) = keys::changed(before, after) else { return Work::Render };
    let work = |key: &Key| match key.affects {
        // Other views have separate images.
        _ if key.path.starts_with("compare.") => Work::None,
        Affects::Scene | Affects::Estimate => Work::Render,
        // No sample depends on the thread count, but it takes effect only when a render starts.
        Affects::Limits if key.path == "render.threads" => Work::Render,
        Affects::Limits => Work::Limits,
        Affects::View => Work::None,
    };
    changed.into_iter().map(work).max().unwrap_or(Work::None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::scene::ToneCurve;

    #[test]
    fn only_what_changes_the_estimate_renders_again() {
        let doc = SceneDoc::default();
        let after = |edit: fn(&mut SceneDoc)| {
            let mut edited = doc.clone();
            edit(&mut edited);
            work_after(&doc, &edited)
        };
        assert_eq!(after(|_| ()), Work::None);
        assert_eq!(after(|d| d.view.exposure_ev += 1.0), Work::None);
        assert_eq!(after(|d| d.view.tone = ToneCurve::Linear), Work::None);
        assert_eq!(after(|d| d.title = "x".into()), Work::None);
        assert_eq!(after(|d| d.render.spp = None), Work::Limits);
        assert_eq!(after(|d| d.render.seconds = Some(3.0)), Work::Limits);
        assert_eq!(after(|d| d.render.seed = 7), Work::Render);
        assert_eq!(after(|d| d.render.threads = Some(1)), Work::Render);
        assert_eq!(after(|d| d.medium_mut().majorant.factor = 2.0), Work::Render);
        assert_eq!(after(|d| d.lights.clear()), Work::Render);
        assert_eq!(after(|d| d.camera.fov_deg = 20.0), Work::Render);
    }
}
