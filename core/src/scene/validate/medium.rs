//! Validation of combinations of values in the medium.

use super::Checker;
use crate::phase::{PhaseDoc, check_table};
use crate::scene::{CoefficientsDoc, MAX_MEDIA, MediumDoc, SceneDoc, Within};
use crate::spectrum::{Outside, SpectrumDoc};

pub(super) fn media(c: &mut Checker, doc: &SceneDoc) {
    let count = doc.media.len();
    c.check(count <= MAX_MEDIA, "medium", format!("holds {count} media: at most {MAX_MEDIA} are supported"));
    for (index, medium) in doc.media.iter().enumerate() {
        let path = doc.medium_path(index);
        let named = format!("{path}.name");
        let valid = !medium.name.is_empty() && !medium.name.contains(['.', '[', ']', '=']);
        c.check(valid, named.clone(), "is empty or contains one of `.`, `[`, `]`, `=`: choose another name");
        let taken = doc.media[..index].iter().any(|other| other.name == medium.name);
        c.check(!taken, named, format!("`{}` is the name of another medium: give each its own", medium.name));
        check_medium(c, doc, medium, &path);
    }
}

fn check_medium(c: &mut Checker, doc: &SceneDoc, medium: &MediumDoc, path: &str) {
    if medium.within == Within::Everywhere {
        let given_by_grid =
            !medium.is_uniform() || medium.emission.as_ref().is_some_and(|e| e.temperature.is_some());
        let message = "is `everywhere`, which needs uniform coefficients and temperature: choose `grid` for a medium given by grids";
        c.check(!given_by_grid, format!("{path}.within"), message);
    } else {
        let message = "has an effect within `everywhere` only: leave it out, or choose `everywhere`";
        c.check(medium.extent.is_none(), format!("{path}.extent"), message);
    }
    if let Within::Object(name) = &medium.within {
        check_object(c, doc, name, path);
    }
    if let Some(CoefficientsDoc::MeanFreePathColour { mean_free_path, .. }) = &medium.coefficients {
        // A mean free path of zero would be an infinite extinction.
        let vanishes = matches!(mean_free_path, SpectrumDoc::Points { outside: Outside::Zero, .. });
        c.check(
            !vanishes,
            format!("{path}.coefficients.mean_free_path"),
            "is zero beyond its points: leave `outside` out, which holds the last values",
        );
    }
    if let PhaseDoc::Tabulated { angle, points, file } = &medium.phase {
        if file.is_empty() {
            let problem = check_table(*angle, points).err();
            let message = problem.map(|e| e.to_string()).unwrap_or_default();
            c.check(problem.is_none(), format!("{path}.phase.points"), message);
        } else {
            c.check(
                points.is_empty(),
                format!("{path}.phase.file"),
                "and `points` are both given: leave one of the two out",
            );
        }
    }
}

/// Checks that the object that a medium fills exists and has an inside.
fn check_object(c: &mut Checker, doc: &SceneDoc, name: &str, path: &str) {
    let path = format!("{path}.within");
    let Some((_, object)) = doc.object_named(name) else {
        let closed = doc.objects.iter().filter(|o| o.shape.has_inside() && !o.name.is_empty());
        let names: Vec<_> = closed.map(|object| format!("`{}`", object.name)).collect();
        let objects = if names.is_empty() {
            "no closed object has a name".to_owned()
        } else {
            format!("closed objects are {}", names.join(", "))
        };
        c.check(false, path, format!("is `{name}`: choose `grid`, `everywhere` or an object; {objects}"));
        return;
    };
    let kind = object.shape.kind_name().to_lowercase();
    let message =
        format!("is `{name}`, a {kind}, which has no inside: choose a box, a sphere or a closed mesh");
    c.check(object.shape.has_inside(), path, message);
}
