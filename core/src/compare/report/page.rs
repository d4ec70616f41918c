//! HTML page of a comparison: one self-contained file.

mod context;
mod gallery;
mod ranking;
mod settings;

use super::gather::Gathered;
use super::{Formats, ReportError};
use minijinja::Environment;
use std::path::Path;

/// Template with style and script; every inserted value is escaped.
const TEMPLATE: &str = include_str!("../../../../assets/report.html");

/// Renders the page.
pub(super) fn render(gathered: &Gathered<'_>, what: &Formats) -> Result<String, ReportError> {
    let failed = |e: &dyn std::fmt::Display| ReportError::write(Path::new("index.html"), e);
    let mut environment = Environment::new();
    // The extension of the template name enables escaping.
    environment.add_template("report.html", TEMPLATE).map_err(|e| failed(&e))?;
    let context = context::Context::of(gathered, what).map_err(|e| failed(&e))?;
    let context = minijinja::Value::from(minijinja::value::Serde(context));
    let page = environment.get_template("report.html").and_then(|t| t.render(context));
    // The chain of causes contains the template error.
    page.map_err(|e| failed(&format!("{e:#}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::report::{fixture, words};
    use base64::Engine;

    const TITLE: &str = "<script>alert(\"x\")</script> & cloud";

    fn page() -> (crate::compare::Experiment, String) {
        let experiment = fixture::experiment(TITLE);
        let what = Formats { command: Some("majorant compare x --set 'a=<b>'".into()), ..Formats::all() };
        let page = render(&Gathered::of(&experiment), &what).unwrap();
        (experiment, page)
    }

    /// Values of an attribute throughout the page.
    fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
        let opening = format!(" {name}=\"");
        page.split(&opening).skip(1).filter_map(|rest| rest.split('"').next()).collect()
    }

    #[test]
    fn it_needs_no_network_and_escapes_user_text() {
        let (_, page) = page();
        for name in ["src", "href", "srcset", "data", "action"] {
            for value in attributes(&page, name) {
                assert!(value.starts_with("data:image/png;base64,") || value.starts_with('#'), "{value}");
            }
        }
        for loads in ["@import", "url(", "fetch(", "XMLHttpRequest", "<link", "<iframe", "import("] {
            assert!(!page.contains(loads), "{loads}");
        }
        assert!(!page.contains("<script>alert"), "the title is not escaped");
        assert!(page.contains("&lt;script&gt;alert"));
        assert!(page.contains("a=&lt;b&gt;"));
        assert_eq!(page.matches("<script>").count(), 1);
    }

    #[test]
    fn its_numbers_are_the_standings_and_its_pictures_decode() {
        let (experiment, page) = page();
        let gathered = Gathered::of(&experiment);
        for standing in &gathered.standings {
            assert!(page.contains(&format!("data-view=\"{}\"", standing.label)));
            for text in [
                words::number(standing.efficiency),
                words::number(standing.variance),
                words::number(standing.cpu_seconds),
                words::number(standing.lookups_per_path),
                words::speedup(standing),
                words::interval(standing).unwrap_or_default(),
            ] {
                assert!(page.contains(&text), "{text}");
            }
            let relmse = standing.error("relmse").unwrap();
            assert!(page.contains(&words::quantity(relmse.corrected(), relmse.uncertainty())));
        }
        let images: Vec<&str> = attributes(&page, "src");
        // Three images and the reference, and every map of every view.
        let maps: usize = gathered.views.iter().map(|v| v.maps.len()).sum();
        assert_eq!(images.len(), 4 + maps);
        assert!(maps >= 3 * 9);
        for image in images {
            let bytes =
                base64::engine::general_purpose::STANDARD.decode(image.split_once(',').unwrap().1).unwrap();
            let decoded = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png).unwrap();
            assert_eq!((decoded.width(), decoded.height()), (24, 16));
        }
        // Every image has an alternative text.
        assert_eq!(page.matches("<img ").count(), attributes(&page, "alt").len());
        assert!(attributes(&page, "alt").iter().all(|alt| alt.len() > 10));
        assert!(page.matches("<svg").count() >= 2 && page.contains("−1"));
    }
}
