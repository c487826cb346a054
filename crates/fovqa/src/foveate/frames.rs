//! Emulates frames and hands them over in memory.

use fovqa_emulate::{Picture, WriteFrameError};
use fovqa_engine::{EngineError, Events, FoveatedFrame, Given, OutputError};
use fovqa_frame::{Frame, Samples, SignalParams, Transfer};
use fovqa_plan::Plan;

use super::record::{First, budget_record, foveated_record, record};
use super::warnings::Warned;
use super::writer::buffers;
use super::{Foveated, only_emulation, only_view};
use crate::error::Error;

/// What a method would have shown of a frame. Codes have the bits of the input. Floats are 32-bit floats in
/// the input's own encoding.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownFrame {
    /// Frame number.
    pub number: i64,
    /// The frame.
    pub frame: Frame,
    /// The reduced buffers, the innermost layer first; empty if they were not requested.
    pub buffers: Vec<Frame>,
}

/// Emulates the frames of a plan as [`foveate_files`](super::foveate_files), but hands each over instead of
/// writing it. The record has no names of files.
///
/// # Errors
/// If the plan has another form, the emulation is not possible, `with_buffers` is set for a method that
/// has none, or a result cannot be expressed as the input is.
pub fn foveate_frames(
    plan: &Plan,
    given: &Given,
    with_buffers: bool,
    events: &dyn Events,
    take: &mut dyn FnMut(ShownFrame),
) -> Result<Foveated, Error> {
    let (eye, spec) = only_emulation(plan)?;
    let view = only_view(plan, given)?;
    let signal = &eye.settings.signal;
    let mut warned = Warned::new(events, view.frames.len());
    let mut first: Option<First> = None;
    let mut records = Vec::new();
    let failures = fovqa_engine::foveate(plan, &view, events, &mut |frame| {
        let size = [frame.before.width(), frame.before.height()];
        warned.of_gaze(frame.gaze_px, size);
        let of_first = first.get_or_insert_with(|| {
            let view = eye.settings.view.as_ref();
            warned.of_view(view, size);
            First::new(view, &frame)
        });
        let budget = frame.emulator.budget().map(budget_record);
        let budget = budget.filter(|budget| Some(budget) != of_first.budget());
        let alike = |picture: &Picture, before| {
            like_input(picture, before, &frame, signal).map_err(|error| {
                EngineError::from(OutputError::Convert { path: frame.input.into(), error })
            })
        };
        let layers = if with_buffers { buffers(spec, &frame, signal)? } else { Vec::new() };
        take(ShownFrame {
            number: frame.frame,
            frame: alike(frame.shown, Some(frame.before))?,
            buffers: layers.iter().map(|layer| alike(layer, None)).collect::<Result<_, _>>()?,
        });
        records.push(foveated_record(&frame, String::new(), Vec::new(), budget));
        Ok(())
    });
    events.finish();
    let failures = failures?;
    Ok(Foveated { record: record(spec, first, records, &failures), failures })
}

/// A picture in the type and the encoding of the input. `before` is the picture of the input, if `picture`
/// has the same pixels: light that emulation did not change keeps its value.
fn like_input(
    picture: &Picture,
    before: Option<&Picture>,
    of: &FoveatedFrame<'_>,
    signal: &SignalParams,
) -> Result<Frame, WriteFrameError> {
    let input = of.reference;
    match (input.samples(), signal.transfer_of(input)) {
        (Samples::U8(_), _) => Ok(picture.to_codes8()),
        (Samples::U16(_), _) => Ok(picture.to_codes16()),
        (Samples::F16(_) | Samples::F32(_), Transfer::Linear) => match before {
            Some(before) if of.scene.is_none() => picture.to_linear_from(signal, before, input),
            _ => picture.to_linear(signal),
        },
        (Samples::F16(_) | Samples::F32(_), _) => Ok(picture.to_signal()),
    }
}
