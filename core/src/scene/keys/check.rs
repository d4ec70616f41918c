//! Validation of values against the ranges of their keys.

use super::part::Leaf;
use super::{DIRECTION, Range, Type, part};
use crate::scene::{Problem, ReferenceDoc, SceneDoc};
use crate::spectrum::SpectrumDoc;
use toml::Value;

/// Problems of all values outside the range of their key, in the order of the table. Further views are
/// checked by [`crate::scene::validate`], as the documents they render.
pub(in crate::scene) fn check(doc: &SceneDoc) -> Vec<Problem> {
    let mut doc = doc.clone();
    doc.compare.views.clear();
    let mut problems = Vec::new();
    // An unsigned number beyond the range of a scene file is one problem, and must not stop the check of
    // other keys.
    let mut fits = |path: &str, number: u64| {
        let fits = i64::try_from(number).is_ok();
        if !fits {
            let message = "is above 2^63 − 1, the largest number that a scene file holds".into();
            problems.push(Problem { path: path.into(), message });
        }
        fits
    };
    if !fits("render.seed", doc.render.seed) {
        doc.render.seed = 0;
    }
    doc.render.spp = doc.render.spp.filter(|spp| fits("render.spp", *spp));
    if let ReferenceDoc::Render { spp, .. } = &mut doc.compare.reference {
        *spp = spp.filter(|spp| fits("compare.reference.spp", *spp));
    }
    match part::leaves(&doc) {
        Ok(leaves) => problems.extend(leaves.iter().filter_map(problem)),
        Err(error) => problems.push(Problem { path: String::new(), message: error.to_string() }),
    }
    problems
}

fn problem(leaf: &Leaf) -> Option<Problem> {
    let key = leaf.key();
    let mut message = wrong(&leaf.value, key.value)?;
    if !key.cure.is_empty() {
        message = format!("{message}: {}", key.cure);
    }
    Some(Problem { path: leaf.path.clone(), message })
}

/// Problem with a value. Values of another type were already rejected when the file was read.
fn wrong(value: &Value, wanted: Type) -> Option<String> {
    match wanted {
        Type::Number(range) => {
            let number = single(value)?;
            (!range.holds(number)).then(|| format!("is {number}, outside {}", words(range)))
        }
        Type::Integer(range) | Type::IntegerOr(range, _) => {
            let number = value.as_integer()?;
            (!range.holds_integer(number)).then(|| format!("is {number}, outside {}", words(range)))
        }
        Type::Vector(_, range) | Type::Matrix(range) => {
            let found = numbers(value).into_iter().find(|x| !range.holds(*x))?;
            Some(format!("holds {found}, outside {}", words(range)))
        }
        Type::Integers(_, range) => {
            let found = value.as_array()?.iter().filter_map(Value::as_integer);
            let found = found.into_iter().find(|x| !range.holds_integer(*x))?;
            Some(format!("holds {found}, outside {}", words(range)))
        }
        Type::Direction => {
            let components = numbers(value);
            let long = components.iter().any(|x| x.abs() > 1e-9);
            let good = long && components.iter().all(|x| DIRECTION.holds(*x));
            (!good).then(|| format!("is {:?}, which has no direction", numbers(value)))
        }
        Type::Spectrum(range) => spectrum(value, range),
        Type::Choice(values) => {
            let word = value.as_str()?;
            (!values.contains(&word)).then(|| format!("is `{word}`: choose {}", values.join(", ")))
        }
        Type::Bool | Type::Pairs | Type::Id(_) | Type::File | Type::Text => None,
    }
}

fn spectrum(value: &Value, range: Range) -> Option<String> {
    let doc: SpectrumDoc = value.clone().try_into().ok()?;
    if let Some(found) = doc.values().into_iter().find(|x| !range.holds(*x)) {
        return Some(format!("holds {found}; values from {} make sense here", words(range)));
    }
    let points = doc.control_points().unwrap_or_default().0;
    let far = points.iter().find(|p| !(100.0..=10_000.0).contains(&p.lambda_nm))?;
    Some(format!(
        "has a control point at {}; wavelengths are in nanometres, 360 to 830 is visible",
        far.lambda_nm
    ))
}

fn single(value: &Value) -> Option<f32> {
    value.as_float().map(|x| x as f32).or_else(|| value.as_integer().map(|x| x as f32))
}

/// All numbers of a nested array, row by row.
fn numbers(value: &Value) -> Vec<f32> {
    match value {
        Value::Array(entries) => entries.iter().flat_map(numbers).collect(),
        other => single(other).into_iter().collect(),
    }
}

/// Text of a range.
pub(super) fn words(range: Range) -> String {
    let end = |x: f64| match x.abs() {
        large if large >= f64::from(f32::MAX) => "any finite number".to_owned(),
        large if large == i64::MAX as f64 => "2^63 − 1".to_owned(),
        large if large >= 1e7 => format!("{x:e}"),
        _ => (x as f32).to_string(),
    };
    let [low, high] = [end(range.min), end(range.max)];
    match range.open {
        [false, false] => format!("{low} to {high}"),
        [true, false] => format!("{low} (exclusive) to {high}"),
        [false, true] => format!("{low} to {high} (exclusive)"),
        [true, true] => format!("{low} to {high}, ends excluded"),
    }
}
