//! `[[method]]`: the tests of each scene.

use std::ops::Range;
use std::path::Path;

use super::emulate::Emulated;
use super::placeholders::Placeholders;
use super::placeholders::path;
use super::scenes::{SceneEntry, TWO_EYES, unique};
use super::view::VIEW_HELP;
use crate::fault::{Fault, Faults};
use crate::grammar::first_quoted;
use crate::nearest::nearest;
use crate::node::Node;
use fovqa_plan::{Eye, EyeView};

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
    for (index, (table, span)) in tables.iter().enumerate() {
        let wanted = table.names("scenes");
        let emulated = Emulated::new(*table, faults);
        if let Some(fault) = one_of_test_and_emulate(*table, span.clone()) {
            faults.push(fault);
            continue;
        }
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
                match &emulated {
                    Some(emulated) => emulations(*table, index, emulated, scene, faults),
                    None if table.has("emulate") => {}
                    None => tests(*table, index, base, scene, faults),
                }
            }
        }
        let of_method = |eye: &EyeView| eye.eye.is_some() && eye.tests.iter().any(|t| t.0 == index);
        if let Some(span) = emulated.and_then(|emulated| emulated.other_span)
            && !scenes.iter().flat_map(|scene| &scene.scene.eyes).any(of_method)
        {
            let message = "no scene of this method has two eyes, so that other_eye says nothing";
            faults.push(Fault::new(span, message).help(TWO_EYES));
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

/// Reports a method that has both tests and an emulation, or neither.
fn one_of_test_and_emulate(table: Node<'_>, span: Range<usize>) -> Option<Fault> {
    let method = table.text("name").unwrap_or_default();
    match (table.has("test"), table.has("emulate")) {
        (false, false) => {
            let message = format!("method \"{method}\" has neither test nor emulate");
            let help = "give it test = \"…\", the frames that were rendered, or emulate = { model = \"…\" }";
            Some(Fault::new(span, message).help(help))
        }
        (true, true) => {
            let message = format!("method \"{method}\" has both test and emulate");
            let help = "leave one of them out: two methods can compare a render with its emulation";
            Some(Fault::new(table.span("emulate"), message).help(help))
        }
        _ if table.has("emulate") && table.has("layer") => {
            let message = format!("method \"{method}\" is emulated, and reads no layer");
            Some(Fault::new(table.span("layer"), message).help("leave layer out"))
        }
        _ => None,
    }
}

/// Adds a method's emulations to a scene.
fn emulations(
    table: Node<'_>,
    index: usize,
    emulated: &Emulated,
    scene: &mut SceneEntry,
    faults: &mut Faults,
) {
    let method = table.text("name").unwrap_or_default();
    let emulations = emulated.of_scene(method, &scene.scene, faults);
    for (view, emulation) in scene.scene.eyes.iter_mut().zip(emulations) {
        if view.settings.view.is_none()
            && let Some(what) = emulation.spec.needs_view()
        {
            let message = format!(
                "method \"{method}\": {what} depends on visual angles, but scene \"{}\" has no view",
                scene.scene.name
            );
            faults.push(Fault::new(emulated.span.clone(), message).help(VIEW_HELP));
        }
        view.tests.push((index, emulation.into()));
    }
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
