//! The journal: what is finished, line by line, so that a run that is killed loses nothing of it.
//!
//! Each line is one JSON object, written in one go: a kill leaves whole lines and at most one piece
//! of a line. Numbers are written so that they are read again to the last bit.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use fovqa_metrics::fvvdp::{FvvdpBand, FvvdpFrame};
use fovqa_metrics::temporal::{AtdBand, AtdFrame};
use fovqa_metrics::{HaarBand, Profile};
use fovqa_results::{Failure, FrameResult, Input, Sides};
use serde_json::{Map, Value, json};

use crate::error::EngineError;
use crate::run::Finished;

/// Its name in the folder of results.
pub const JOURNAL: &str = "journal.jsonl";
/// Name and version of its format.
const SCHEMA: &str = "fovqa.journal/1";

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Begins a journal: its first line says of which experiment, by the SHA-256 of its text, and
    /// by which version.
    ///
    /// # Errors
    /// When the file cannot be made.
    pub fn create(folder: &Path, experiment_sha256: &str) -> Result<Self, EngineError> {
        let path = folder.join(JOURNAL);
        let file = File::create(&path);
        let file = file.map_err(|error| EngineError::Journal { path: path.clone(), error })?;
        let mut journal = Self { path, file };
        journal.line(&json!({
            "schema": SCHEMA,
            "version": env!("CARGO_PKG_VERSION"),
            "experiment_sha256": experiment_sha256,
        }))?;
        Ok(journal)
    }

    /// Takes down a finished frame, after the inputs that were read for it.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&mut self, finished: &Finished<'_>) -> Result<(), EngineError> {
        for Input { path, bytes, sha256 } in &finished.inputs {
            self.line(&json!({ "input": path, "bytes": bytes, "sha256": sha256 }))?;
        }
        let mut line = json!({
            "scene": finished.scene,
            "method": finished.method,
            "eye": finished.eye.map(fovqa_config::Eye::name),
        });
        match finished.result {
            Ok(result) => scored(&mut line, result),
            Err(Failure { frame, message, .. }) => {
                line["frame"] = json!(frame);
                line["error"] = json!(message);
            }
        }
        self.line(&line)
    }

    fn line(&mut self, value: &Value) -> Result<(), EngineError> {
        let mut line = value.to_string();
        line.push('\n');
        self.file
            .write_all(line.as_bytes())
            .map_err(|error| EngineError::Journal { path: self.path.clone(), error })
    }
}

fn scored(line: &mut Value, result: &FrameResult) {
    let number = |value: f64| if value.is_infinite() { json!("inf") } else { json!(value) };
    let scores = &result.scores;
    let values = scores.scores.iter().map(|(m, v)| (m.key().to_owned(), number(*v)));
    let bands = scores.bands.iter().map(|band| {
        let mut entry: Map<String, Value> =
            band.scores.iter().map(|(m, v)| (m.key().to_owned(), json!(v.map(number)))).collect();
        entry.insert("pixels".to_owned(), json!(band.pixels));
        entry.insert("squared_error".to_owned(), json!(band.mse));
        Value::Object(entry)
    });
    line["frame"] = json!(result.frame);
    line["reference"] = json!(result.reference);
    line["test"] = json!(result.test);
    line["gaze_px"] = json!(result.gaze_px);
    line["scores"] = Value::Object(values.collect());
    line["bands"] = bands.collect();
    line["pixels"] = json!(scores.pixels);
    line["pixels_outside_bands"] = json!(scores.outside_bands);
    line["pixels_left_out"] = json!(scores.left_out);
    line["squared_error"] = json!(scores.mse);
    line["weighted_squared_error"] = json!(scores.weighted_squared_error);
    line["gaze_step_deg"] = json!(result.gaze_step_deg);
    if let Some(profiles) = &result.profiles {
        line["profiles"] = sides(profiles, profile);
    }
    if let Some(atd) = &result.atd {
        line["atd"] = sides(atd, difference);
    }
    if let Some(fvvdp) = &result.fvvdp {
        line["fvvdp"] = visible_difference(fvvdp);
    }
}

fn sides<T>(sides: &Sides<T>, of: impl Fn(&T) -> Value) -> Value {
    json!({ "reference": of(&sides.reference), "test": of(&sides.test) })
}

/// Wavelet coefficients as lists, level by level and band by band: their number, then mean, maximum and
/// energy of all, then those of each orientation.
fn profile(profile: &Profile) -> Value {
    let band = |band: &HaarBand| {
        let statistics =
            band.statistics.iter().chain(band.orientations.as_deref().into_iter().flatten());
        let values = statistics.flat_map(|statistics| statistics.values().map(Value::from));
        std::iter::once(Value::from(band.coefficients)).chain(values).collect::<Value>()
    };
    let level = |level: &Vec<HaarBand>| level.iter().map(band).collect::<Value>();
    let haar = profile.haar.as_ref().map(|levels| levels.iter().map(level).collect::<Value>());
    json!({ "rms_contrast": profile.rms_contrast, "haar": haar })
}

/// Bands of spatial frequency as lists: frequency, sustained and transient Q.
fn visible_difference(fvvdp: &FvvdpFrame) -> Value {
    let band = |band: &FvvdpBand| json!([band.cpd, band.sustained, band.transient]);
    json!({
        "q": fvvdp.q,
        "frame_jod": fvvdp.frame_jod,
        "bands": fvvdp.bands.iter().map(band).collect::<Value>(),
        "shares": fvvdp.shares,
    })
}

/// Pixels that count, then the mean and the valid pixels of the whole frame, and of each band.
fn difference(atd: &AtdFrame) -> Value {
    let pair = |band: &AtdBand| json!([band.mean, band.valid]);
    json!({
        "pixels": atd.pixels,
        "whole": pair(&atd.whole),
        "bands": atd.bands.iter().map(pair).collect::<Value>(),
    })
}
