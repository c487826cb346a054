//! The output of `fovqa foveate --format json`, schema `fovqa.foveate/1`. New keys may be added, but
//! keys are never renamed.

use std::io::{self, Write};

use fovqa_params::ParamValue;
use serde::Serialize;
use serde::ser::Serializer;

use super::summary::ViewRecord;

/// Name and version of the format.
pub const FOVEATE_SCHEMA: &str = "fovqa.foveate/1";

/// What an emulation was, and what each emulated frame stands for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoveateRecord {
    /// Name and version of the format.
    pub schema: &'static str,
    /// Version of fovqa.
    pub version: &'static str,
    /// The method.
    pub method: String,
    /// All parameters that apply, by name. A parameter that a budget solves has the value of the first
    /// frame.
    #[serde(serialize_with = "by_name")]
    pub parameters: Vec<(String, ParamValue)>,
    /// How a sample reads the frame.
    pub sampling: &'static str,
    /// Which filters of the method are on.
    pub filter: &'static str,
    /// The values on which the method runs.
    pub space: &'static str,
    /// Whether the temporal filter is on.
    pub temporal: bool,
    /// The strength of the enhancement; `None` if it is off.
    pub enhance: Option<f64>,
    /// The budget, as it was met in the first frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget: Option<BudgetRecord>,
    /// The view; `None` if none was given.
    pub view: Option<ViewRecord>,
    /// The frames that were written, in order.
    pub frames: Vec<FoveatedRecord>,
    /// The frames that could not be emulated.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<FoveateErrorRecord>,
}

/// A budget that was asked for, and how it was met.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BudgetRecord {
    /// The share of the pixels that was asked for.
    pub share: f64,
    /// Which samples it counts.
    pub of: &'static str,
    /// The parameter that was solved.
    pub parameter: String,
    /// Its value.
    pub value: ParamValue,
    /// The share of the ideal buffer, before its size is rounded.
    pub ideal_share: f64,
    /// The share of the buffer that was emulated.
    pub rounded_share: f64,
}

/// An emulated frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoveatedRecord {
    /// Frame number.
    pub frame: i64,
    /// The input, with `/` between folders.
    pub input: String,
    /// The file that was written; empty for a frame in memory.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub output: String,
    /// The files with the reduced buffer, the innermost layer first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffer_files: Vec<String>,
    /// Gaze in pixels, as it was given.
    pub gaze_px: [f64; 2],
    /// Columns and rows of each buffer, the innermost first; of columns of different lengths, the
    /// longest. Empty for methods without a buffer.
    pub buffers: Vec<[usize; 2]>,
    /// Samples that are shaded, within the method's own field.
    #[serde(serialize_with = "count")]
    pub samples: f64,
    /// Samples whose position is in the frame.
    #[serde(serialize_with = "count")]
    pub samples_on_screen: f64,
    /// Samples beyond the method's own field.
    #[serde(serialize_with = "count")]
    pub samples_beyond: f64,
    /// Samples, with those beyond, over the pixels of the frame.
    pub samples_share: f64,
    /// Coarse pixel shading: blocks of 2x2 samples in which a sample is used.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quads: Option<u64>,
    /// The budget as it was met in this frame, if its gaze differs from that of the first frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget: Option<BudgetRecord>,
}

/// A frame that could not be emulated.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FoveateErrorRecord {
    /// Frame number, if the error is that of a frame.
    pub frame: Option<i64>,
    /// The input.
    pub input: String,
    /// What is wrong, and where.
    pub message: String,
}

impl FoveateRecord {
    /// Writes the record as indented JSON with a newline at its end.
    ///
    /// # Errors
    /// If the writer refuses.
    pub fn write_json(&self, mut out: impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut out, self)?;
        writeln!(out)
    }
}

fn by_name<S: Serializer>(
    parameters: &[(String, ParamValue)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(parameters.iter().map(|(name, value)| (name, value)))
}

/// A whole number is written without decimals.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn count<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    /// Up to here, every whole number is a number of 64-bit floats.
    const LARGEST: f64 = 9_007_199_254_740_992.0;
    if number.fract() == 0.0 && (0.0..=LARGEST).contains(number) {
        serializer.serialize_u64(*number as u64)
    } else {
        serializer.serialize_f64(*number)
    }
}
