//! `builtin = "gallery"` of a scene.

use fovqa_gallery::{BuiltinSpec, IPD_M, SceneName};
use fovqa_params::Words;
use fovqa_plan::{BuiltinFrames, Eye, Settings};
use fovqa_vision::ViewSpec;

use super::view::VIEW_HELP;
use crate::fault::{Fault, Faults};
use crate::grammar::resolution;
use crate::node::Node;

/// The keys that only built-in scenes have.
const KEYS: [&str; 4] = ["resolution", "samples", "seed", "ipd_mm"];

/// A built-in scene of the file.
pub(super) struct Builtin<'a> {
    table: Node<'a>,
    spec: BuiltinSpec,
    size: Option<[usize; 2]>,
    ipd_m: Option<f64>,
}

impl<'a> Builtin<'a> {
    /// Reads a scene; `None` if it is not built in. A scene with neither or both is a mistake.
    pub(super) fn new(table: Node<'a>, faults: &mut Faults) -> Option<Self> {
        let name = table.text("name").unwrap_or_default();
        let has = |key: &str| table.has(key);
        let fault = match (has("builtin"), has("reference")) {
            (false, false) => {
                let message = format!("scene \"{name}\" has neither reference nor builtin");
                let help = "add reference = \"…\", the frames that tests are compared with, or builtin = \"gallery\"";
                Some(Fault::new(table.span("name"), message).help(help))
            }
            (true, true) => {
                let message = format!("scene \"{name}\" has both reference and builtin");
                Some(Fault::new(table.span("builtin"), message).help("leave one of them out"))
            }
            (false, true) => {
                for key in KEYS.into_iter().filter(|key| has(key)) {
                    let message = format!(
                        "{key} is for built-in scenes, but scene \"{name}\" has a reference"
                    );
                    faults.push(Fault::new(table.span(key), message).help("leave it out"));
                }
                if table.number("frames").is_some() {
                    let message = "a number of frames is for built-in scenes";
                    let help = "write a range, such as frames = \"0..100\"";
                    faults.push(Fault::new(table.span("frames"), message).help(help));
                }
                None
            }
            (true, false) => {
                for key in ["crop", "mask", "layer", "motion", "depth", "folder"]
                    .into_iter()
                    .filter(|key| has(key))
                {
                    let message = format!("{key} is for files, but scene \"{name}\" is built in");
                    faults.push(Fault::new(table.span(key), message).help("leave it out"));
                }
                if table.text("frames").is_some() {
                    let message = "a built-in scene has as many frames as it is asked for";
                    let help =
                        "write their number, such as frames = 300; --frames selects some of them";
                    faults.push(Fault::new(table.span("frames"), message).help(help));
                }
                None
            }
        };
        faults.extend(fault);
        let scene = SceneName::find(&table.text("builtin")?.replace('-', "_"))?;
        let default = BuiltinSpec::new(scene);
        let whole = |key: &str| table.number(key).map(|number| number as u64);
        let spec = BuiltinSpec {
            frames: whole("frames").map_or(default.frames, |frames| frames as usize),
            fps: table.number("fps").unwrap_or(default.fps),
            samples: whole("samples").map_or(default.samples, |samples| samples as usize),
            seed: whole("seed").unwrap_or(default.seed),
            ..default
        };
        let size = table.text("resolution").and_then(resolution);
        Some(Self { table, spec, size, ipd_m: table.number("ipd_mm").map(|mm| mm / 1000.0) })
    }

    /// The eyes of the scene.
    pub(super) fn eyes(&self) -> Vec<Option<Eye>> {
        match self.ipd_m {
            Some(_) => Eye::BOTH.map(Some).to_vec(),
            None => vec![None],
        }
    }

    /// The frames per second.
    pub(super) fn fps(&self) -> f64 {
        self.spec.fps
    }

    /// Whether the viewer has a gaze of its own.
    pub(super) fn has_gaze(&self) -> bool {
        self.spec.scene == SceneName::Gallery
    }

    /// The frames of an eye.
    pub(super) fn frames(
        &self,
        eye: Option<Eye>,
        settings: &Settings,
        faults: &mut Faults,
    ) -> BuiltinFrames {
        let name = self.table.text("name").unwrap_or_default();
        if settings.view.is_none() && self.spec.scene == SceneName::Gallery {
            let message =
                format!("scene \"{name}\" has no view, so that its frames cannot be drawn");
            faults.push(Fault::new(self.table.span("builtin"), message).help(VIEW_HELP));
        }
        let of_display = match &settings.view {
            Some(ViewSpec::Display(display)) => Some(display.resolution),
            _ => None,
        };
        let size = self.size.or(of_display).unwrap_or_else(|| {
            let message = format!("the size of the frames of scene \"{name}\" is not known");
            let help = "add resolution = \"1440x1600\" to the scene, or give a display";
            faults.push(Fault::new(self.table.span("builtin"), message).help(help));
            [1, 1]
        });
        let half = self.ipd_m.unwrap_or(IPD_M) / 2.0;
        let eye_m = match eye {
            None => 0.0,
            Some(Eye::Left) => -half,
            Some(Eye::Right) => half,
        };
        BuiltinFrames { spec: self.spec.clone(), size, eye_m }
    }
}
