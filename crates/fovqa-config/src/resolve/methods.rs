//! `[[method]]`: the tests of each scene.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

use fovqa_emulate::Budget;
use fovqa_params::ParamValue;

use super::emulate::Emulated;
use super::placeholders::Placeholders;
use super::placeholders::path;
use super::scenes::{SceneEntry, TWO_EYES, unique};
use super::sweep::{Entry, Sweeps};
use super::view::VIEW_HELP;
use crate::fault::{Fault, Faults};
use crate::grammar::{BUDGET, first_quoted};
use crate::nearest::nearest;
use crate::node::Node;
use fovqa_plan::{Eye, EyeView, Sweep};

/// Maximum number of comparisons, far more than fit in a table. Memory is needed for the path and
/// the mistakes of each.
const MOST_COMPARISONS: usize = 100_000;

/// The methods of a file.
pub(super) struct Methods {
    /// Their names; each point of a sweep has its own.
    pub(super) names: Vec<String>,
    pub(super) sweeps: Vec<Sweep>,
}

impl Methods {
    /// The methods that a name of the file stands for: one, or all points of a sweep.
    pub(super) fn called(&self, name: &str) -> &[String] {
        let swept = self.sweeps.iter().find(|sweep| sweep.method == name);
        let range = match swept {
            Some(sweep) => sweep.methods(),
            None => match self.names.iter().position(|known| known == name) {
                Some(index) => index..index + 1,
                None => 0..0,
            },
        };
        &self.names[range]
    }

    /// The names that plots and rules may refer to.
    pub(super) fn referable(&self) -> Vec<&str> {
        let mut names = Vec::new();
        let mut index = 0;
        while index < self.names.len() {
            if let Some(sweep) = self.sweeps.iter().find(|sweep| sweep.first == index) {
                names.push(sweep.method.as_str());
                index = sweep.methods().end.max(index + 1);
            } else {
                names.push(self.names[index].as_str());
                index += 1;
            }
        }
        names
    }
}

/// Reads the methods. Their tests are added to the scenes.
pub(super) fn methods(
    root: Node<'_>,
    base: &Path,
    scenes: &mut [SceneEntry],
    faults: &mut Faults,
) -> Methods {
    let none = || Methods { names: Vec::new(), sweeps: Vec::new() };
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
        return none();
    }
    let common = common_budget(root, faults);
    let all_emulated = tables.iter().map(|(table, _)| Emulated::new(*table, common, faults));
    let all_emulated: Vec<Option<Emulated>> = all_emulated.collect();
    budget_of_nobody(root, &all_emulated, faults);
    let own_names: Vec<&str> =
        tables.iter().map(|(table, _)| table.text("name").unwrap_or_default()).collect();
    let swept = Sweeps::new(root, &own_names, &all_emulated, faults);
    let runs = (0..tables.len()).map(|method| swept.points(method));
    let runs = runs.fold(0, usize::saturating_add).saturating_mul(scenes.len());
    if runs > MOST_COMPARISONS {
        let message = format!(
            "the sweep has {runs} runs, counting all methods and scenes: at most {MOST_COMPARISONS} are allowed"
        );
        let help = "sweep fewer keys or fewer values, or divide it into several experiments";
        faults.push(Fault::new(swept.span, message).help(help));
        return none();
    }
    let mut methods = none();
    for (table_index, ((table, span), emulated)) in tables.iter().zip(&all_emulated).enumerate() {
        let index = methods.names.len();
        let wanted = table.names("scenes");
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
                match emulated {
                    // The points of a sweep are added below.
                    Some(_) if !swept.of(table_index).is_empty() => {}
                    Some(emulated) => emulations(*table, index, emulated, scene, faults),
                    None if table.has("emulate") => {}
                    None => tests(*table, index, base, scene, faults),
                }
            }
        }
        let name = table.text("name").unwrap_or_default();
        match (emulated, swept.of(table_index)) {
            (None, _) | (_, []) => methods.names.push(name.to_owned()),
            (Some(emulated), entries) => {
                let keys = entries.iter().map(Entry::swept).collect();
                let sweep = Sweep { method: name.to_owned(), keys, first: index };
                let is_in = |scene: &&mut SceneEntry| {
                    let name = &scene.scene.name;
                    wanted.as_ref().is_none_or(|w| w.iter().any(|(scene, _)| scene == name))
                };
                let scenes: Vec<&mut SceneEntry> = scenes.iter_mut().filter(is_in).collect();
                points(*table, (&sweep, &swept.span), emulated, scenes, faults);
                methods.names.extend((0..sweep.methods().len()).map(|point| sweep.label(point)));
                methods.sweeps.push(sweep);
            }
        }
        let of_method = |eye: &EyeView| eye.eye.is_some() && eye.tests.iter().any(|t| t.0 == index);
        if let Some(span) = emulated.as_ref().and_then(|emulated| emulated.other_span.clone())
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
    alike(&methods, swept.span.clone(), faults);
    methods
}

/// Reports a method that has the name of a point of a sweep.
fn alike(methods: &Methods, span: Range<usize>, faults: &mut Faults) {
    let mut seen = BTreeSet::new();
    let mut twice = methods.names.iter().filter(|name| !seen.insert(name.to_lowercase()));
    if let Some(twice) = twice.next().filter(|_| !methods.sweeps.is_empty()) {
        let message = format!("a method has the name of a point of the sweep, \"{twice}\"");
        faults.push(Fault::new(span, message).help("give it another name"));
    }
}

/// The budget of the experiment.
fn common_budget(root: Node<'_>, faults: &mut Faults) -> Option<Budget> {
    let share = root.number(BUDGET);
    if share.is_none() && root.has("budget_of") {
        let message = "budget_of needs a budget, but none is given";
        faults.push(Fault::new(root.span("budget_of"), message));
    }
    Some(Budget { share: share?, of: root.word("budget_of").unwrap_or_default() })
}

/// Reports a budget of the experiment that no method can take.
fn budget_of_nobody(root: Node<'_>, emulated: &[Option<Emulated>], faults: &mut Faults) {
    if root.has(BUDGET)
        && !emulated.iter().flatten().any(Emulated::takes_common_budget)
        && faults.is_empty()
    {
        let message = "no method has a parameter that the budget of the experiment could set";
        let help = "emulate a method such as rmfr, or leave the budget out";
        faults.push(Fault::new(root.span(BUDGET), message).help(help));
    }
}

/// Adds a method's points of a sweep to its scenes.
fn points(
    table: Node<'_>,
    (sweep, span): (&Sweep, &Range<usize>),
    emulated: &Emulated,
    mut scenes: Vec<&mut SceneEntry>,
    faults: &mut Faults,
) {
    for (point, index) in sweep.methods().enumerate() {
        let values: Vec<(&str, &ParamValue)> = sweep.at(point).collect();
        let before = faults.count();
        match emulated.at(&values) {
            Ok(emulated) => {
                for scene in &mut scenes {
                    emulations(table, index, &emulated, scene, faults);
                }
            }
            Err(error) => faults.push(Fault::new(span.clone(), error)),
        }
        // What is wrong with one point is wrong with most of them.
        if faults.count() > before {
            return;
        }
    }
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
