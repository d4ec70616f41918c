//! Validation of a comparison.

use super::{Checker, Problem, scene_problems};
use crate::scene::{MAX_VIEWS, MajorantDoc, ReferenceDoc, SceneDoc};

pub(super) fn compare(c: &mut Checker, doc: &SceneDoc) {
    let compare = &doc.compare;
    let count = doc.view_count();
    c.check(count <= MAX_VIEWS, "compare.views", format!("holds more than {} further views", MAX_VIEWS - 1));
    // A view's own settings have to satisfy the same rules as the scene's.
    let known = scene_problems(doc);
    for view in 1..count {
        let Some(seen) = doc.view_doc(view) else { continue };
        for problem in scene_problems(&seen).into_iter().filter(|p| !known.contains(p)) {
            c.problems.push(Problem { path: own_path(doc, view, &problem.path), ..problem });
        }
    }
    majorants_of_views(c, doc);
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

/// Checks that a view has a majorant of the only medium, or names media of the scene, each once.
fn majorants_of_views(c: &mut Checker, doc: &SceneDoc) {
    for (number, view) in doc.compare.views.iter().enumerate() {
        let path = format!("compare.views[{number}]");
        if doc.media.len() > 1 {
            let message = "addresses the only medium of a scene; this one has several: write media = [{ name = …, majorant = … }]";
            c.check(view.majorant == MajorantDoc::default(), format!("{path}.majorant"), message);
        } else {
            let message = "addresses one of several media; this scene has not: write majorant = …";
            c.check(view.media.is_empty(), format!("{path}.media"), message);
        }
        for (index, own) in view.media.iter().enumerate() {
            let path = format!("{path}.media[{index}].name");
            let known = doc.media.iter().any(|medium| medium.name == own.name);
            c.check(known, path.clone(), format!("`{}` is not a medium of the scene", own.name));
            let again = view.media[..index].iter().any(|other| other.name == own.name);
            c.check(!again, path, format!("`{}` is given twice", own.name));
        }
    }
}

/// Path of a view's own key that corresponds to the scene's key at `path`.
fn own_path(doc: &SceneDoc, view: usize, path: &str) -> String {
    let view_path = format!("compare.views[{}]", view - 1);
    let of_medium = path.strip_prefix("medium[").and_then(|rest| rest.split_once("]."));
    if let Some((index, rest)) = of_medium {
        let name =
            index.parse().ok().and_then(|index: usize| doc.media.get(index)).map(|medium| &medium.name);
        let media = doc.compare.views.get(view - 1).map(|own| own.media.as_slice()).unwrap_or_default();
        let index = media.iter().position(|own| Some(&own.name) == name).unwrap_or_default();
        return format!("{view_path}.media[{index}].{rest}");
    }
    let path = path.strip_prefix("medium.").or_else(|| path.strip_prefix("render.")).unwrap_or(path);
    format!("{view_path}.{path}")
}
