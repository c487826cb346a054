//! `reproject = { … }` of an emulated method: between which eyes frames are reprojected, and how far
//! apart they are.

use std::ops::Range;
use std::path::Path;

use fovqa_gallery::SceneName;
use fovqa_io::DepthChannels;
use fovqa_params::Words;
use fovqa_plan::{BuiltinFrames, EyeView, Scene, SourceSpec};

use super::scenes::TWO_EYES;
use super::view::VIEW_HELP;
use crate::fault::Fault;
use crate::grammar::REPROJECT;
use crate::node::Node;

/// Distance between both eyes in millimetres, by default.
const IPD_MM: f64 = 63.0;

/// Endings of files that have no depth.
const WITHOUT_DEPTH: [&str; 4] = ["png", "jpg", "jpeg", "y4m"];

/// The table of the file.
#[derive(Clone)]
pub(super) struct Reproject {
    ipd_mm: Option<f64>,
    depth_m: Option<f64>,
    span: Range<usize>,
    ipd_span: Range<usize>,
    depth_span: Range<usize>,
}

/// The geometry of a scene.
#[derive(Debug, Clone, Copy)]
pub(super) struct Geometry {
    /// Distance between both eyes in millimetres.
    pub(super) ipd_mm: f64,
    /// Metres per unit of depth.
    pub(super) depth_m: f64,
}

impl Reproject {
    /// Reads the table of a method; `None` without one.
    pub(super) fn new(method: Node<'_>) -> Option<Self> {
        let table = method.table(REPROJECT)?;
        Some(Self {
            ipd_mm: table.number("ipd_mm"),
            depth_m: table.number("depth_m"),
            span: method.span(REPROJECT),
            ipd_span: table.span("ipd_mm"),
            depth_span: table.span("depth_m"),
        })
    }

    /// The geometry of a scene, or why nothing can be reprojected in it.
    pub(super) fn of_scene(&self, method: &str, scene: &Scene) -> Result<Geometry, Fault> {
        let name = &scene.name;
        let fault = |message: String, help: &str| {
            let message = format!("method \"{method}\" cannot reproject: {message}");
            Err(Fault::new(self.span.clone(), message).help(help))
        };
        let builtin = scene.eyes.iter().find_map(builtin);
        if scene.eyes.len() < 2 {
            let help = if builtin.is_some() {
                "add ipd_mm = 63 to the scene, or name the scenes with two eyes in the method's scenes"
            } else {
                TWO_EYES
            };
            return fault(format!("scene \"{name}\" has one image per frame, not two eyes"), help);
        }
        if scene.eyes.iter().any(|eye| eye.settings.view.is_none()) {
            return fault(format!("scene \"{name}\" has no view"), VIEW_HELP);
        }
        if let Some(frames) = builtin {
            return self.of_builtin(name, frames);
        }
        if let Some((eye, why)) = scene.eyes.iter().find_map(|eye| Some((eye, lacks_depth(eye)?))) {
            let eye = eye.eye.map_or("one", Words::word);
            let help =
                "give the reference depth: OpenEXR files with Z, or depth = { files = \"…\" }";
            return fault(format!("the {eye} eye of scene \"{name}\" has no depth: {why}"), help);
        }
        let (ipd_mm, depth_m) = (self.ipd_mm.unwrap_or(IPD_MM), self.depth_m.unwrap_or(1.0));
        Ok(Geometry { ipd_mm, depth_m })
    }

    /// The geometry of a built-in scene is its own.
    fn of_builtin(&self, name: &str, frames: &BuiltinFrames) -> Result<Geometry, Fault> {
        if frames.spec.scene != SceneName::Gallery {
            let scene = frames.spec.scene.word();
            let message =
                format!("scene \"{name}\", {scene}, is flat, and both eyes see the same of it");
            return Err(Fault::new(self.span.clone(), message).help("reproject in the gallery"));
        }
        // The scene has the distance from the middle to each eye, in metres.
        let ipd_mm = (frames.eye_m.abs() * 2e12).round() / 1e9;
        let differs =
            |given: Option<f64>, own: f64| given.filter(|given| (given - own).abs() > 1e-6 * own);
        if let Some(given) = differs(self.ipd_mm, ipd_mm) {
            let message = format!(
                "{REPROJECT} has ipd_mm = {given}, but the eyes of the built-in scene \"{name}\" are {ipd_mm} mm apart"
            );
            let help = "leave it out here: a built-in scene knows its own";
            return Err(Fault::new(self.ipd_span.clone(), message).help(help));
        }
        if let Some(given) = differs(self.depth_m, 1.0) {
            let message = format!(
                "{REPROJECT} has depth_m = {given}, but the depth of the built-in scene \"{name}\" is in metres"
            );
            return Err(Fault::new(self.depth_span.clone(), message).help("leave it out"));
        }
        Ok(Geometry { ipd_mm, depth_m: 1.0 })
    }
}

fn builtin(eye: &EyeView) -> Option<&BuiltinFrames> {
    match &eye.reference {
        SourceSpec::Builtin(frames) => Some(frames),
        SourceSpec::Files(_) | SourceSpec::Given(_) | SourceSpec::Emulated(_) => None,
    }
}

/// Why an eye cannot have depth, as far as the file says.
fn lacks_depth(eye: &EyeView) -> Option<String> {
    let settings = &eye.settings;
    if settings.depth_files.is_some() {
        return None;
    }
    if settings.guides.depth == DepthChannels::None {
        return Some("depth is \"none\"".to_owned());
    }
    let SourceSpec::Files(path) = &eye.reference else { return None };
    let ending = Path::new(path).extension()?.to_str()?.to_ascii_lowercase();
    let is_without = WITHOUT_DEPTH.contains(&ending.as_str());
    is_without.then(|| format!("files that end in .{ending} have none"))
}
