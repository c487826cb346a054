//! Writes a built-in scene as files, as `fovqa gallery` does.

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};

use fovqa_emulate::Picture;
use fovqa_engine::Events;
use fovqa_frame::{SignalParams, SignalTables};
use fovqa_gallery::{Builtin, BuiltinSpec, IPD_M};
use fovqa_io::{FrameFormat, encode_exr_with_guides, encode_frame};
use fovqa_plan::Eye;
use fovqa_results::{make_folder, padded, write_whole};
use fovqa_vision::ViewSpec;

use crate::error::Error;

/// A built-in scene that is to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct GalleryRequest {
    /// The scene.
    pub spec: BuiltinSpec,
    /// Width and height of its frames in pixels.
    pub size: [usize; 2],
    /// How it is viewed.
    pub view: ViewSpec,
    /// The eyes; empty for one in the middle between both.
    pub eyes: Vec<Eye>,
    /// Distance between the pupils in metres.
    pub ipd_m: f64,
}

impl GalleryRequest {
    /// A scene as an eye in the middle sees it.
    pub fn new(spec: BuiltinSpec, size: [usize; 2], view: ViewSpec) -> Self {
        Self { spec, size, view, eyes: Vec::new(), ipd_m: IPD_M }
    }
}

/// Writes the frames of a built-in scene to a folder: `exr/0000.exr` (linear light, motion, depth),
/// `png/0000.png` (encoded, cut at white), `gaze.csv` and, for a scene with a camera, `camera.json`. Each
/// eye has a folder of its own, `left` or `right`. Returns the number of frames.
///
/// # Errors
/// If the scene or its view is not possible, or a file cannot be written.
pub fn write_gallery(
    request: &GalleryRequest,
    folder: &Path,
    events: &dyn Events,
) -> Result<usize, Error> {
    let [width, height] = request.size;
    let view = request.view.resolve(width, height).map_err(|error| {
        Error::usage(error.to_string(), "give a view that fits frames of this size")
    })?;
    let half = request.ipd_m / 2.0;
    let eyes: Vec<(Option<Eye>, f64)> = match request.eyes.as_slice() {
        [] => vec![(None, 0.0)],
        eyes => eyes
            .iter()
            .map(|eye| (Some(*eye), if *eye == Eye::Left { -half } else { half }))
            .collect(),
    };
    let total = request.spec.frames * eyes.len();
    events.progress(0, total);
    for (index, (eye, eye_m)) in eyes.iter().enumerate() {
        let builtin = Builtin::new(&request.spec, view.view, *eye_m)
            .map_err(|error| Error::usage(error.to_string(), "give a number in this range"))?;
        let mut folder = folder.to_owned();
        folder.extend(eye.map(Eye::name));
        let done = |frame: usize| events.progress(index * request.spec.frames + frame + 1, total);
        write_eye(&builtin, &folder, &done)?;
    }
    events.finish();
    Ok(total)
}

fn write_eye(builtin: &Builtin, folder: &Path, done: &dyn Fn(usize)) -> Result<(), Error> {
    let [exr, png] = ["exr", "png"].map(|name| folder.join(name));
    for folder in [&exr, &png] {
        make_folder(folder).map_err(|error| refused(folder, &error.to_string()))?;
    }
    let tables = SignalTables::new(SignalParams::default());
    let mut gaze = "frame,x_px,y_px\n".to_owned();
    let mut poses = Vec::new();
    for frame in 0..builtin.spec().frames {
        let light = builtin.ground_truth(frame);
        let number = padded(frame as i64);
        let path = exr.join(format!("{number}.exr"));
        let bytes = encode_exr_with_guides(&light, &builtin.guides(frame));
        write(&path, bytes)?;
        let path = png.join(format!("{number}.png"));
        let codes = Picture::from_frame(&light, &tables).to_codes8();
        let bytes = encode_frame(&codes, FrameFormat::Png).map_err(|error| error.to_string());
        write(&path, bytes)?;
        let [x, y] = builtin.gaze_px(frame);
        // Writing to a text does not fail.
        let _ = writeln!(gaze, "{frame},{x},{y}");
        poses.extend(builtin.pose(frame));
        done(frame);
    }
    write(&folder.join("gaze.csv"), Ok(gaze.into_bytes()))?;
    if poses.is_empty() {
        return Ok(());
    }
    let view = builtin.view();
    let camera = serde_json::json!({
        "width": view.width,
        "height": view.height,
        "focal_px": view.focal_px,
        "principal_px": view.principal_px,
        "fps": builtin.spec().fps,
        "axes": "x to the right, y up, z forward, in metres",
        "frames": poses,
    });
    let text = serde_json::to_vec_pretty(&camera).map_err(|error| error.to_string());
    write(&folder.join("camera.json"), text)
}

fn write(path: &Path, bytes: Result<Vec<u8>, String>) -> Result<(), Error> {
    let bytes = bytes.map_err(|error| refused(path, &error))?;
    write_whole(path, &bytes).map_err(|error| {
        let error = io::Error::other(error);
        refused(path, &error.to_string())
    })
}

fn refused(path: &Path, why: &str) -> Error {
    let path: PathBuf = path.to_owned();
    let message = format!("{}: cannot be written: {why}", path.display());
    Error::input(message, "give another folder with {output}, or free some space")
}
