//! Temporary: opens the window until main does.
use majorant::lab::{LabOptions, run};
use majorant::model::Source;
fn main() {
    let mut o = LabOptions::default();
    let mut args = std::env::args().skip(1);
    while let Some(a) = args.next() {
        match a.as_str() {
            "--screenshot" => o.screenshot = args.next().map(Into::into),
            "--after" => o.after_seconds = args.next().unwrap().parse().unwrap(),
            "--window" => {
                let w = args.next().unwrap();
                let (a, b) = w.split_once('x').unwrap();
                o.window = Some([a.parse().unwrap(), b.parse().unwrap()]);
            }
            "--light" => o.theme = Some(egui::Theme::Light),
            "--dark" => o.theme = Some(egui::Theme::Dark),
            x => o.open = Some(Source::from_argument(x)),
        }
    }
    if let Err(e) = run(o) {
        eprintln!("{e:?}: {e}");
        std::process::exit(3)
    }
}
