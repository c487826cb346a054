//! Writes each emulated frame as soon as it is there, and records it.

use std::path::Path;

use fovqa_emulate::{EmulationSpec, Picture};
use fovqa_engine::{Events, FoundView, FoveatedFrame, OutputError};
use fovqa_frame::SignalParams;
use fovqa_io::encode_frame;
use fovqa_plan::{EyeView, Plan};
use fovqa_results::{
    Failure, FileError, FoveateRecord, FoveatedRecord, make_folder, write_output, write_whole,
};

use super::destination::{Destination, Destinations};
use super::record::{First, budget_record, foveated_record, record};
use super::warnings::Warned;
use super::written_frame::Written;

/// Writes the frames of a view.
pub(super) struct Writer<'a> {
    plan: &'a Plan,
    eye: &'a EyeView,
    spec: &'a EmulationSpec,
    destinations: Destinations,
    code_bits: Option<u32>,
    warned: Warned<'a>,
    /// What the first frame determines.
    first: Option<First>,
    frames: Vec<FoveatedRecord>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(
        plan: &'a Plan,
        view: &FoundView,
        eye: &'a EyeView,
        spec: &'a EmulationSpec,
        destinations: Destinations,
        events: &'a dyn Events,
    ) -> Self {
        Self {
            plan,
            eye,
            spec,
            destinations,
            code_bits: view.sources.reference.code_bits(),
            warned: Warned::new(events, view.frames.len()),
            first: None,
            frames: Vec::new(),
        }
    }

    /// Writes a frame and, if they are wanted, its buffers.
    pub(super) fn take(&mut self, frame: &FoveatedFrame<'_>) -> Result<(), OutputError> {
        let size = [frame.before.width(), frame.before.height()];
        self.warned.of_gaze(frame.gaze_px, size);
        let first = self.first.get_or_insert_with(|| {
            let view = self.eye.settings.view.as_ref();
            self.warned.of_view(view, size);
            First::new(view, frame)
        });
        let budget = frame.emulator.budget().map(budget_record);
        let budget = budget.filter(|budget| Some(budget) != first.budget());
        let written = Written {
            signal: &self.eye.settings.signal,
            input: frame.reference,
            code_bits: self.code_bits,
        };
        let mut buffer_files = Vec::new();
        if let Some(destination) = self.destinations.buffer(frame.index) {
            let pictures = buffers(self.spec, frame, &self.eye.settings.signal)?;
            let layers = pictures.len();
            for (index, picture) in pictures.into_iter().enumerate() {
                let path = destination.layer(index + 1, layers);
                let destination = Destination { path, ..destination.clone() };
                write(&written, &picture, None, &destination)?;
                buffer_files.push(self.plan.shown(&destination.path));
            }
        }
        let destination = self.destinations.frame(frame.index);
        write(&written, frame.shown, Some(frame.before), destination)?;
        let output = self.plan.shown(&destination.path);
        self.frames.push(foveated_record(frame, output, buffer_files, budget));
        Ok(())
    }

    /// The record of what was written.
    pub(super) fn into_record(self, failures: &[Failure]) -> FoveateRecord {
        record(self.spec, self.first, self.frames, failures)
    }
}

/// The reduced buffers of a frame, the innermost layer first.
pub(super) fn buffers(
    spec: &EmulationSpec,
    frame: &FoveatedFrame<'_>,
    signal: &SignalParams,
) -> Result<Vec<Picture>, OutputError> {
    let none = || OutputError::NoBuffer { method: spec.key().replace('_', "-") };
    let pictures = match frame.scene {
        None => frame.emulator.buffers(frame.before),
        Some(scene) => frame.emulator.scene_buffers(scene, frame.index, signal),
    };
    let pictures =
        pictures.unwrap_or_else(|_| unreachable!("the emulator was made for this picture"));
    if pictures.is_empty() { Err(none()) } else { Ok(pictures) }
}

fn write(
    written: &Written<'_>,
    picture: &Picture,
    before: Option<&Picture>,
    destination: &Destination,
) -> Result<(), OutputError> {
    let path = &destination.path;
    let frame = written.frame(picture, before, destination)?;
    let bytes = encode_frame(&frame, destination.format)
        .map_err(|error| OutputError::Encode { path: path.clone(), error })?;
    let refused = |path: &Path, error| OutputError::Write { path: path.to_owned(), error };
    let done = if destination.is_in_folder {
        let folder = path.parent().unwrap_or(Path::new(""));
        make_folder(folder).map_err(|error| refused(folder, error))?;
        write_whole(path, &bytes)
    } else {
        write_output(path, &bytes)
    };
    done.map_err(|error| match error {
        FileError::Write { path, error } | FileError::Read { path, error } => {
            OutputError::Write { path, error }
        }
        FileError::Format { path, detail, .. } => {
            OutputError::Write { path, error: std::io::Error::other(detail) }
        }
    })
}
