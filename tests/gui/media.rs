//! The list of media, and the panels of the selected one.

use super::harness::{click, doc, lab, open, undo, wait};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use majorant::lab::LabApp;
use majorant_core::scene::Within;
use majorant_core::session::Status;

fn names(lab: &super::Lab) -> Vec<String> {
    doc(lab).media.iter().map(|medium| medium.name.clone()).collect()
}

fn finished(app: &LabApp) -> bool {
    app.state().status == Status::Finished
}

#[test]
fn media_are_added_edited_hidden_and_removed() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Media");
    assert_eq!(names(&lab), ["medium"]);
    click(&mut lab, Role::Button, "+  Add medium");
    click(&mut lab, Role::Button, "Fog everywhere");
    assert_eq!(names(&lab), ["medium", "fog"]);
    assert_eq!(doc(&lab).media[1].within, Within::Everywhere);
    wait(&mut lab, "rendering both", finished);

    // The new medium is selected: the panels below show and edit it.
    open(&mut lab, "Density");
    let scale = |lab: &super::Lab| doc(lab).media.iter().map(|medium| medium.scale).collect::<Vec<_>>();
    let at = lab.get_by_role_and_label(Role::SpinButton, "Density scale").rect().center();
    let by = egui::vec2(40.0, 0.0);
    super::drag(&mut lab, at, at + by, egui::PointerButton::Primary, egui::Modifiers::NONE);
    assert!(scale(&lab)[0] == 1.0 && scale(&lab)[1] > 1.0, "{:?}", scale(&lab));
    click(&mut lab, Role::Button, "Select medium");
    click(&mut lab, Role::Button, "Duplicate medium");
    assert_eq!(names(&lab), ["medium", "medium 2", "fog"]);
    click(&mut lab, Role::Button, "Move up fog");
    assert_eq!(names(&lab), ["medium", "fog", "medium 2"]);

    // A hidden medium is kept in the document, and not part of the picture.
    click(&mut lab, Role::CheckBox, "Enable fog");
    assert!(!doc(&lab).media[1].enabled);
    wait(&mut lab, "rendering without it", finished);
    let info = lab.state().state().scene.clone().expect("a scene");
    assert!(info.medium(1).is_none() && info.medium(2).is_some());

    for name in ["fog", "medium 2", "medium"] {
        click(&mut lab, Role::Button, &format!("Remove {name}"));
    }
    assert_eq!(doc(&lab).media, []);
    assert!(lab.query_by_role_and_label(Role::SpinButton, "Density scale").is_none());
    wait(&mut lab, "rendering the empty scene", finished);
    undo(&mut lab);
    assert_eq!(names(&lab), ["medium"]);
}
