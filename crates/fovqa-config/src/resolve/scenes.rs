//! `[[scene]]`.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;

use fovqa_metrics::MetricInfo;

use super::builtin::Builtin;
use super::placeholders::{Placeholders, path};
use super::settings::Layers;
use super::view::{LUMINANCE_HELP, VIEW_HELP};
use crate::fault::{Fault, Faults};
use crate::node::Node;
use fovqa_plan::{Eye, EyeView, Gaze, MetricChoice, Scene, SourceSpec};

/// A scene, and the data that its methods need.
pub(super) struct SceneEntry {
    pub(super) scene: Scene,
    /// The value of `{folder}`.
    pub(super) folder: String,
    pub(super) span: Range<usize>,
}

pub(super) fn scenes(
    root: Node<'_>,
    base: &Path,
    metrics: &MetricChoice,
    faults: &mut Faults,
) -> Vec<SceneEntry> {
    let tables = root.tables("scene");
    if tables.is_empty() {
        faults.push(Fault::new(root.span("scene"), "the experiment has no scene"));
    }
    unique(&tables, "scene", faults);
    eyes_of_nobody(root, &tables, faults);
    tables
        .into_iter()
        .map(|(table, span)| {
            let name = table.text("name").unwrap_or_default();
            let folder = table.text("folder").unwrap_or(name);
            let builtin = Builtin::new(table, faults);
            let references: Vec<(Option<Eye>, &str, Range<usize>)> = match table.table("reference")
            {
                _ if builtin.is_some() => {
                    let eyes = builtin.iter().flat_map(Builtin::eyes);
                    eyes.map(|eye| (eye, "", table.span("builtin"))).collect()
                }
                None => vec![(
                    None,
                    table.text("reference").unwrap_or_default(),
                    table.span("reference"),
                )],
                Some(sides) => Eye::BOTH
                    .into_iter()
                    .filter_map(|eye| {
                        Some((Some(eye), sides.text(eye.name())?, sides.span(eye.name())))
                    })
                    .collect(),
            };
            let eyes = references.into_iter().map(|(eye, text, span)| {
                let placeholders =
                    Placeholders { scene: name, folder, method: None, eye: eye.map(Eye::name) };
                let layers = Layers::new(root, table, eye);
                let mut settings = layers.settings(base, placeholders, faults);
                if builtin.is_none() && settings.gaze == Gaze::Builtin {
                    let message = format!(
                        "scene \"{name}\" is not built in, so that no viewer has a gaze in it"
                    );
                    let help = "write \"center\", [x, y] in pixels, or { trace = \"gaze.csv\" }";
                    faults.push(Fault::new(layers.gaze_span(), message).help(help));
                }
                let reference = match &builtin {
                    Some(builtin) => {
                        if builtin.has_gaze() && !layers.has_gaze() {
                            settings.gaze = Gaze::Builtin;
                        }
                        SourceSpec::Builtin(builtin.frames(eye, &settings, faults))
                    }
                    None if text.is_empty() => SourceSpec::default(),
                    None => path(placeholders, base, text, span, faults).unwrap_or_default().into(),
                };
                EyeView {
                    eye,
                    reference,
                    tests: Vec::new(),
                    test_layers: BTreeMap::new(),
                    settings,
                }
            });
            let eyes: Vec<EyeView> = eyes.collect();
            foveal_without_view(root, &eyes, name, metrics, faults);
            unlit(root, &eyes, name, metrics, faults);
            if let [left, right] = eyes.as_slice()
                && left.settings.view.is_some() != right.settings.view.is_some()
            {
                let which = if left.settings.view.is_some() { "left" } else { "right" };
                let message = format!("scene \"{name}\" has a view only for its {which} eye");
                faults.push(
                    Fault::new(span.clone(), message)
                        .help("give one for both, or one in each of the tables left and right"),
                );
            }
            if eyes.len() < 2 {
                for eye in Eye::BOTH.into_iter().filter(|eye| table.has(eye.name())) {
                    let message = format!("scene \"{name}\" has no {} eye of its own", eye.name());
                    let fault = Fault::new(table.span(eye.name()), message);
                    faults.push(fault.help(TWO_EYES));
                }
            }
            let scene = Scene {
                name: name.to_owned(),
                frames: table.text("frames").and_then(|text| text.parse().ok()),
                allow_missing: table.flag("allow_missing").unwrap_or(false),
                fps: table.number("fps").or(builtin.as_ref().map(Builtin::fps)),
                eyes,
            };
            SceneEntry { scene, folder: folder.to_owned(), span }
        })
        .collect()
}

/// Reports general tables for one eye if no scene has two eyes.
fn eyes_of_nobody(root: Node<'_>, scenes: &[(Node<'_>, Range<usize>)], faults: &mut Faults) {
    if scenes.iter().any(|(scene, _)| scene.table("reference").is_some()) {
        return;
    }
    for general in ["view", "signal"].into_iter().filter_map(|key| root.table(key)) {
        for eye in Eye::BOTH.into_iter().filter(|eye| general.has(eye.name())) {
            let message = format!("no scene has a {} eye of its own", eye.name());
            let fault = Fault::new(general.span(eye.name()), message);
            faults.push(fault.help(TWO_EYES));
        }
    }
}

/// How the user gives a scene two eyes.
pub(super) const TWO_EYES: &str = "give a scene reference = { left = \"…\", right = \"…\" }";

/// Reports metrics that were requested by name and need a view, if there is none.
fn foveal_without_view(
    root: Node<'_>,
    eyes: &[EyeView],
    scene: &str,
    metrics: &MetricChoice,
    faults: &mut Faults,
) {
    if eyes.iter().all(|eye| eye.settings.view.is_some()) {
        return;
    }
    for (key, span) in asked_for(root, metrics, |info| info.needs.view) {
        let message = format!("{key} needs a view, but scene \"{scene}\" has none");
        faults.push(Fault::new(span, message).help(VIEW_HELP));
    }
}

/// The metrics that were requested by name and need something, each with its position.
fn asked_for<'a>(
    root: Node<'a>,
    metrics: &MetricChoice,
    needs: fn(&MetricInfo) -> bool,
) -> Vec<(&'a str, Range<usize>)> {
    let MetricChoice::Named(named) = metrics else { return Vec::new() };
    let needy = |key: &str| named.iter().any(|m| m.key() == key && needs(m.info()));
    let entries = root.table("metrics").into_iter().flat_map(Node::entries);
    entries.filter(|(key, ..)| needy(key)).map(|(key, span, _)| (key, span)).collect()
}

/// Reports luminance-based metrics if the display has no photometry, or shows the files differently
/// from their encoding.
fn unlit(
    root: Node<'_>,
    eyes: &[EyeView],
    scene: &str,
    metrics: &MetricChoice,
    faults: &mut Faults,
) {
    for (key, span) in asked_for(root, metrics, |info| info.needs.luminance) {
        if eyes.iter().any(|eye| eye.settings.photometry().is_none()) {
            let message =
                format!("{key} needs the display's photometry, but scene \"{scene}\" has none");
            faults.push(Fault::new(span, message).help(LUMINANCE_HELP));
        } else if let Some(why) = eyes.iter().find_map(|eye| eye.settings.shown_wrongly()) {
            let message = format!("{key} of scene \"{scene}\": {why}");
            faults.push(Fault::new(span, message).help(
                "check that transfer matches the files, and give the luminance of a display with the same eotf",
            ));
        }
    }
}

/// Words that fovqa's tables use, and words that readers of CSV take for a missing value.
const RESERVED: [&str; 10] =
    ["average", "best", "error", "#na", "<na>", "na", "nan", "none", "null", "inf"];

/// Reports names that appear twice or are not allowed.
pub(super) fn unique(tables: &[(Node<'_>, Range<usize>)], what: &str, faults: &mut Faults) {
    let mut seen = BTreeSet::new();
    for (table, _) in tables {
        let name = table.text("name").unwrap_or_default();
        if RESERVED.contains(&name.to_lowercase().as_str()) {
            let fault =
                Fault::new(table.span("name"), format!("a {what} cannot be named \"{name}\""));
            faults.push(fault.help(
                "tables use this word, or programs that read them treat it as a missing value: choose another name",
            ));
        }
        if !seen.insert(name.to_lowercase()) {
            let fault =
                Fault::new(table.span("name"), format!("there are two {what}s named \"{name}\""));
            faults.push(
                fault
                    .label("the second")
                    .help("give each its own name; upper and lower case count as equal"),
            );
        }
    }
}
