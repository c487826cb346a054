//! Shows what a foveation method would have shown of finished frames, and writes it to files, as
//! `fovqa foveate` does.

mod destination;
mod frames;
mod inputs;
mod record;
mod warnings;
mod writer;
mod written_frame;

use std::path::PathBuf;

use fovqa_emulate::EmulationSpec;
use fovqa_engine::{EngineError, Events, FoundView, Given};
use fovqa_plan::{EyeView, Plan, SourceSpec};
use fovqa_results::{Failure, FoveateRecord};

use crate::error::Error;
use destination::Destinations;
pub use frames::{ShownFrame, foveate_frames};
use writer::Writer;

/// Where emulated frames are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoveateOutputs {
    /// The file for a single frame, otherwise the folder. Existing files are replaced.
    pub frames: PathBuf,
    /// The file or folder for the reduced buffers, if they are written.
    pub buffers: Option<PathBuf>,
}

/// The result of [`foveate_files`].
#[derive(Debug, Clone, PartialEq)]
pub struct Foveated {
    /// The emulation and the frames that were written.
    pub record: FoveateRecord,
    /// The frames that could not be emulated.
    pub failures: Vec<Failure>,
}

/// Emulates the frames of a plan with one scene, one eye and one method that is emulated
/// ([`SourceSpec::Emulated`]), and writes them. Each file is written completely or not at all. Frames
/// that cannot be emulated are failures in the result.
///
/// # Errors
/// If the plan has another form, the emulation is not possible, the outputs do not fit the inputs, or
/// a frame cannot be written.
pub fn foveate_files(
    plan: &Plan,
    given: &Given,
    outputs: &FoveateOutputs,
    events: &dyn Events,
) -> Result<Foveated, Error> {
    let (eye, spec) = only_emulation(plan)?;
    inputs::refuse_stream(&eye.reference)?;
    let view = only_view(plan, given)?;
    let view = &view;
    let destinations = Destinations::new(plan, view, outputs)?;
    let mut writer = Writer::new(plan, view, eye, spec, destinations, events);
    let failures = fovqa_engine::foveate(plan, view, events, &mut |frame| {
        writer.take(&frame).map_err(EngineError::from)
    });
    events.finish();
    let failures = failures?;
    Ok(Foveated { record: writer.into_record(&failures), failures })
}

/// The only eye of a plan, and the emulation of its only method.
fn only_emulation(plan: &Plan) -> Result<(&EyeView, &EmulationSpec), Error> {
    let ([scene], [_]) = (plan.scenes.as_slice(), plan.methods.as_slice()) else {
        return Err(not_one());
    };
    let [eye] = scene.eyes.as_slice() else { return Err(not_one()) };
    let [(_, SourceSpec::Emulated(emulation))] = eye.tests.as_slice() else {
        return Err(not_one());
    };
    fovqa_engine::check(plan)?;
    Ok((eye, &emulation.spec))
}

/// The frames of a plan with one eye.
fn only_view(plan: &Plan, given: &Given) -> Result<FoundView, Error> {
    let mut found = fovqa_engine::find(plan, given);
    if let Some(problem) = found.problems.pop() {
        return Err(problem.error.into());
    }
    found.views.into_iter().next().ok_or_else(not_one)
}

fn not_one() -> Error {
    Error::usage(
        "the plan does not have one scene with one eye and one method that is emulated",
        "emulate one method at a time",
    )
}
