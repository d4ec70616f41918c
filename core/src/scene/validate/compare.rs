//! Validation of a comparison.

use super::{Checker, Problem, scene_problems};
use crate::scene::{MAX_VIEWS, ReferenceDoc, SceneDoc};

pub(super) fn compare(c: &mut Checker, doc: &SceneDoc) {
    let compare = &doc.compare;
    let count = doc.view_count();
    c.check(count <= MAX_VIEWS, "compare.views", format!("holds more than {} further views", MAX_VIEWS - 1));
    // A view's own settings have to satisfy the same rules as the scene's.
    let known = scene_problems(doc);
    for view in 1..count {
        let Some(seen) = doc.view_doc(view) else { continue };
        for problem in scene_problems(&seen).into_iter().filter(|p| !known.contains(p)) {
            c.problems.push(Problem { path: own_path(view, &problem.path), ..problem });
        }
    }
    c.check(
        compare.baseline < count,
        "compare.baseline",
        format!("is {}: views count from 0", compare.baseline),
    );
    if let ReferenceDoc::View { view } = compare.reference {
        c.check(view < count, "compare.reference.view", format!("is {view}: views count from 0"));
    }
    if let Some([x0, y0, x1, y1]) = compare.region {
        c.check(
            x0 < x1 && y0 < y1,
            "compare.region",
            "holds no pixel: write [x0, y0, x1, y1] with x0 < x1, y0 < y1",
        );
    }
}

/// Path of a view's own key that corresponds to the scene's key at `path`.
fn own_path(view: usize, path: &str) -> String {
    let path = path.strip_prefix("medium.").or_else(|| path.strip_prefix("render.")).unwrap_or(path);
    format!("compare.views[{}].{path}", view - 1)
}
