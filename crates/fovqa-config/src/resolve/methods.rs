//! `[[method]]`: the tests of each scene.

use std::path::Path;

use super::placeholders::Placeholders;
use super::placeholders::path;
use super::scenes::{SceneEntry, unique};
use crate::fault::{Fault, Faults};
use crate::grammar::first_quoted;
use crate::nearest::nearest;
use crate::node::Node;
use fovqa_plan::Eye;

/// Maximum number of comparisons, far more than fit in a table. Memory is needed for the path and
/// the mistakes of each.
const MOST_COMPARISONS: usize = 100_000;

/// The names of the methods. Their tests are added to the scenes.
pub(super) fn methods(
    root: Node<'_>,
    base: &Path,
    scenes: &mut [SceneEntry],
    faults: &mut Faults,
) -> Vec<String> {
    let tables = root.tables("method");
    if tables.is_empty() {
        faults.push(Fault::new(root.span("method"), "the experiment has no method"));
    }
    unique(&tables, "method", faults);
    if tables.len() * scenes.len() > MOST_COMPARISONS {
        let (methods, scenes) = (tables.len(), scenes.len());
        let message = format!(
            "{methods} methods in {scenes} scenes are too many: at most {MOST_COMPARISONS} comparisons are allowed"
        );
        faults.push(
            Fault::new(root.span("method"), message).help("divide it into several experiments"),
        );
        return Vec::new();
    }
    for (index, (table, _)) in tables.iter().enumerate() {
        let wanted = table.names("scenes");
        for (name, span) in wanted.iter().flatten() {
            if faults.are_many() {
                break;
            }
            let known = || scenes.iter().map(|scene| scene.scene.name.as_str());
            if !known().any(|scene| scene == *name) {
                let fault = Fault::new(span.clone(), format!("there is no scene \"{name}\""));
                let label = nearest(name, known()).map(|near| format!("did you mean \"{near}\"?"));
                let help = format!("the scenes are {}", first_quoted(known()));
                faults.push(fault.label(label.unwrap_or_default()).help(help));
            }
        }
        for scene in scenes.iter_mut() {
            let name = &scene.scene.name;
            if wanted.as_ref().is_none_or(|wanted| wanted.iter().any(|(scene, _)| scene == name)) {
                tests(*table, index, base, scene, faults);
            }
        }
    }
    for scene in scenes.iter().filter(|scene| scene.scene.eyes.iter().all(|e| e.tests.is_empty())) {
        if !tables.is_empty() && faults.is_empty() {
            let message = format!("no method is scored in scene \"{}\"", scene.scene.name);
            let fault = Fault::new(scene.span.clone(), message);
            faults.push(fault.help("name it in the scenes of a method, or remove it"));
        }
    }
    tables.iter().map(|(table, _)| table.text("name").unwrap_or_default().to_owned()).collect()
}

/// Adds a method's tests to a scene.
fn tests(table: Node<'_>, index: usize, base: &Path, scene: &mut SceneEntry, faults: &mut Faults) {
    let method = table.text("name").unwrap_or_default();
    let name = scene.scene.name.clone();
    let sides = table.table("test");
    let two = scene.scene.eyes.len() > 1;
    let per_eye = sides.is_some() || table.text("test").is_some_and(|text| text.contains("{eye}"));
    if two != per_eye {
        let (message, help) = if two {
            (
                format!(
                    "scene \"{name}\" has two eyes, but method \"{method}\" has one test for both"
                ),
                "put {eye} into the path (it stands for left and right), or write test = { left = \"…\", right = \"…\" }",
            )
        } else {
            (
                format!(
                    "method \"{method}\" has a test for each eye, but scene \"{name}\" has one reference"
                ),
                "give the scene reference = { left = \"…\", right = \"…\" }, or name the method's scenes",
            )
        };
        faults.push(Fault::new(table.span("test"), message).help(help));
        return;
    }
    let layers = table.table("layer");
    if layers.is_some() && !two {
        let message = format!(
            "method \"{method}\" has a layer for each eye, but scene \"{name}\" has one reference"
        );
        let help =
            "write layer = \"…\", or give the scene reference = { left = \"…\", right = \"…\" }";
        faults.push(Fault::new(table.span("layer"), message).help(help));
    }
    for view in &mut scene.scene.eyes {
        let (text, span) = match (sides, view.eye) {
            (Some(sides), Some(eye)) => (sides.text(eye.name()), sides.span(eye.name())),
            _ => (table.text("test"), table.span("test")),
        };
        let placeholders = Placeholders {
            scene: &name,
            folder: &scene.folder,
            method: Some(method),
            eye: view.eye.map(Eye::name),
        };
        if let Some(path) = path(placeholders, base, text.unwrap_or_default(), span, faults) {
            view.tests.push((index, path.into()));
        }
        let layer = match (layers, view.eye) {
            (Some(layers), Some(eye)) => layers.text(eye.name()),
            _ => table.text("layer"),
        };
        if let Some(layer) = layer {
            view.test_layers.insert(index, layer.to_owned());
        }
    }
}
