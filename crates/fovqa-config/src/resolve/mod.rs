//! From checked tables to the plan: overrides, placeholders, names that refer to each other.

mod curves;
mod gates;
mod guides;
mod methods;
mod metrics;
mod plots;
mod scenes;
mod settings;
mod view;

pub(crate) use curves::curves;

use std::path::{Path, PathBuf};

use fovqa_io::sequence::{is_glob, literal};

use crate::fault::Faults;
use crate::node::Node;
use fovqa_plan::Experiment;
use fovqa_plan::Plan;

/// The experiment; mistakes go to `faults`.
pub(crate) fn experiment(
    root: Node<'_>,
    path: &Path,
    text: &str,
    faults: &mut Faults,
) -> Experiment {
    let base = path.parent().map(Path::to_owned).unwrap_or_default();
    let (choice, params) = metrics::metrics(root, faults);
    let mut scenes = scenes::scenes(root, &base, &choice, faults);
    let methods = methods::methods(root, &base, &mut scenes, faults);
    let known =
        plots::Known { scenes: &scenes, methods: &methods, metrics: &choice, params: &params };
    let plots = plots::plots(root, &known, faults);
    let gates = gates::gates(root, text, &known, faults);
    Experiment {
        name: root.text("name").unwrap_or_default().to_owned(),
        about: root.text("about").map(str::to_owned),
        path: path.to_owned(),
        text: String::new(),
        plots,
        gates,
        plan: Plan {
            base,
            scenes: scenes.into_iter().map(|scene| scene.scene).collect(),
            methods,
            metrics: choice,
            params,
            frames: None,
            hash_inputs: true,
            maps: false,
        },
    }
}

/// What Linux opens. A text of nothing but placeholders would fill the memory.
const LONGEST_PATH: usize = 4096;

/// What braces in a path stand for.
#[derive(Debug, Clone, Copy, Default)]
struct Placeholders<'a> {
    scene: &'a str,
    folder: &'a str,
    method: Option<&'a str>,
    eye: Option<&'static str>,
}

impl Placeholders<'_> {
    /// The path of a text from the file, below `base`.
    fn path(&self, base: &Path, text: &str) -> Result<PathBuf, (String, String)> {
        if text == "-" {
            let message = "\"-\" is standard input, which an experiment cannot read".to_owned();
            return Err((message, "give a file; `fovqa score` reads standard input".to_owned()));
        }
        // In a pattern, names stand for themselves, whatever characters they have.
        let pattern = is_glob(Path::new(text));
        let verbatim = |name: &str| {
            if pattern { literal(name) } else { name.to_owned() }
        };
        let too_long = || {
            let message = format!("the path becomes longer than {LONGEST_PATH} bytes");
            (message, "name fewer placeholders, or shorter ones".to_owned())
        };
        let mut path = String::new();
        let mut rest = text;
        while let Some((before, behind)) = rest.split_once('{') {
            path.push_str(before);
            if path.len() > LONGEST_PATH {
                return Err(too_long());
            }
            let Some((name, after)) = behind.split_once('}') else {
                return Err((
                    format!("\"{text}\" opens a brace and does not close it"),
                    self.known(),
                ));
            };
            path.push_str(&verbatim(match name {
                "scene" => self.scene,
                "folder" => self.folder,
                "method" if self.method.is_some() => self.method.unwrap_or_default(),
                "eye" => self.eye.ok_or_else(|| {
                    let message = format!("\"{text}\" has {{eye}} in it, and the scene \"{}\" has one reference for both", self.scene);
                    (message, "give the scene reference = { left = \"…\", right = \"…\" }".to_owned())
                })?,
                other => {
                    return Err((format!("\"{text}\" has {{{other}}} in it, which stands for nothing"), self.known()));
                }
            }));
            rest = after;
        }
        path.push_str(rest);
        if path.len() > LONGEST_PATH {
            return Err(too_long());
        }
        Ok(base.join(path))
    }

    fn known(&self) -> String {
        let method = if self.method.is_some() { ", {method}" } else { "" };
        format!(
            "braces may hold {{scene}}, {{folder}}{method} or, in a scene with two eyes, {{eye}}"
        )
    }
}
