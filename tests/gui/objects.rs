//! Objects of every kind, media within them, and meshes that are dropped into the window.

use super::harness::{click, doc, drop_file, lab, open, undo, wait};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use majorant::lab::LabApp;
use majorant_core::material::Metal;
use majorant_core::scene::{MaterialDoc, ObjectDoc, ShapeDoc, Within};
use majorant_core::session::Status;

fn finished(app: &LabApp) -> bool {
    app.state().status == Status::Finished
}

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn a_medium_fills_an_object_and_follows_its_name() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Media");
    open(&mut lab, "Objects");
    click(&mut lab, Role::Button, "+  Add object");
    click(&mut lab, Role::Button, "Sphere");
    assert_eq!(doc(&lab).objects[0].name, "sphere");
    click(&mut lab, Role::ComboBox, "Object 1 material");
    click(&mut lab, Role::Button, "Interface");
    assert_eq!(doc(&lab).objects[0].material, MaterialDoc::Interface {});
    assert!(lab.query_by_role_and_label(Role::CheckBox, "Object 1 emits").is_none());

    click(&mut lab, Role::ComboBox, "Within");
    click(&mut lab, Role::Button, "Object: sphere");
    assert_eq!(doc(&lab).media[0].within, Within::Object("sphere".into()));
    wait(&mut lab, "rendering the ball", finished);
    let info = lab.state().state().scene.clone().expect("a scene");
    // The default template is a ball of radius 0.3 about (0.8, −0.2, 0).
    assert!((info.world_min[0] - 0.5).abs() < 1e-5 && (info.world_max[1] - 0.1).abs() < 1e-5, "{info:?}");

    // The name is edited; the medium refers to the object by the new one.
    let field = |lab: &super::Lab| lab.get_by_role_and_label(Role::TextInput, "Object 1 name").focus();
    field(&lab);
    lab.run_steps(2);
    lab.event(egui::Event::Text(" of glass".into()));
    lab.run_steps(2);
    lab.key_press(egui::Key::Enter);
    lab.run_steps(3);
    assert_eq!(doc(&lab).objects[0].name, "sphere of glass");
    assert_eq!(doc(&lab).media[0].within, Within::Object("sphere of glass".into()));
    wait(&mut lab, "rendering again", finished);

    click(&mut lab, Role::Button, "Remove object 1");
    assert_eq!((doc(&lab).objects.len(), &doc(&lab).media[0].within), (0, &Within::Grid));
    wait(&mut lab, "rendering its own box", finished);
    undo(&mut lab);
    assert_eq!(doc(&lab).objects.len(), 1);
}

#[test]
fn every_material_can_be_chosen_and_rendered() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Objects");
    click(&mut lab, Role::Button, "+  Add object");
    click(&mut lab, Role::Button, "Sphere");
    for (kind, template) in MaterialDoc::templates() {
        click(&mut lab, Role::ComboBox, "Object 1 material");
        click(&mut lab, Role::Button, kind);
        assert_eq!(doc(&lab).objects[0].material, template, "{kind}");
        wait(&mut lab, kind, finished);
        match kind {
            "Conductor" => {
                click(&mut lab, Role::ComboBox, "Object 1 metal");
                click(&mut lab, Role::Button, "n and k");
                wait(&mut lab, "n and k", finished);
                click(&mut lab, Role::ComboBox, "Object 1 metal");
                click(&mut lab, Role::Button, "Silver");
                let material = &doc(&lab).objects[0].material;
                assert!(matches!(material, MaterialDoc::Conductor { preset: Some(Metal::Silver), .. }));
            }
            "Dielectric" => {
                click(&mut lab, Role::Button, "Object 1 index: Cauchy");
                wait(&mut lab, "Cauchy", finished);
                let priority = lab.get_by_role_and_label(Role::SpinButton, "Object 1 priority");
                priority.set_value_accesskit(3.0);
                lab.run_steps(3);
                assert_eq!(doc(&lab).objects[0].priority, 3);
            }
            _ => {}
        }
        wait(&mut lab, kind, finished);
    }
}

#[test]
fn every_object_can_be_added_and_emit() {
    let (mut lab, directory) = lab();
    std::fs::write(directory.path().join("a.obj"), TETRAHEDRON).expect("a mesh");
    open(&mut lab, "Objects");
    for (number, (kind, _)) in (1..).zip(ObjectDoc::templates()) {
        click(&mut lab, Role::Button, "+  Add object");
        click(&mut lab, Role::Button, kind);
        if kind == "Mesh" {
            let path = directory.path().join("a.obj");
            lab.get_by_label("Path").set_text_value_accesskit(&path.to_string_lossy());
            lab.run_steps(3);
            click(&mut lab, Role::Button, "Open");
            assert!(
                matches!(&doc(&lab).objects[number - 1].shape, ShapeDoc::Mesh { file, .. } if file == "a.obj")
            );
        }
        if kind != "Ground plane" {
            click(&mut lab, Role::CheckBox, &format!("Object {number} emits"));
            assert!(doc(&lab).objects[number - 1].emission.is_some());
        }
        wait(&mut lab, kind, finished);
    }
    let info = lab.state().state().scene.clone().expect("a scene");
    assert_eq!(info.objects.last().map(|mesh| (mesh.triangles, mesh.vertices)), Some((4, 4)));
}

#[test]
fn a_dropped_mesh_becomes_an_object() {
    let (mut lab, directory) = lab();
    let path = directory.path().join("stone.obj");
    std::fs::write(&path, TETRAHEDRON).expect("a mesh");
    drop_file(&mut lab, path.clone());
    assert_eq!(doc(&lab).objects[0].name, "stone");
    wait(&mut lab, "rendering the mesh", finished);
    // A damaged file is named with key and line.
    let other = directory.path().join("other.obj");
    std::fs::write(&other, "v 0 0 0\nf 1 2 3\n").expect("a mesh");
    drop_file(&mut lab, other);
    wait(&mut lab, "the message", |app| matches!(app.state().status, Status::Failed(_)));
    let Status::Failed(message) = lab.state().state().status.clone() else { return };
    assert!(message.contains("objects[1].file") && message.contains("other.obj: line 2"), "{message}");
}
