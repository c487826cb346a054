//! Writes the emulated frames that an experiment keeps.

use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Entry, Finished, FoundInputs, Named};
use fovqa_frame::Frame;
use fovqa_frame::source::Origin;
use fovqa_io::{FrameFormat, encode_frame};
use fovqa_plan::{Plan, SourceSpec};
use fovqa_results::{FileError, FrameResult, make_folder, padded, write_whole};

use crate::error::Error;

/// The folder below the results that emulated frames are written to.
const FOLDER: &str = "emulated";

/// Writes the emulated frames that are to be kept.
#[derive(Debug)]
pub(crate) struct KeptFrames {
    folder: PathBuf,
}

impl KeptFrames {
    pub(crate) fn new(results: &Path) -> Self {
        Self { folder: results.join(FOLDER) }
    }

    fn file(&self, named: Named<'_>, frame: i64, format: FrameFormat) -> PathBuf {
        let mut path = self.folder.join(named.scene).join(named.method);
        path.extend(named.eye.map(fovqa_plan::Eye::name));
        path.join(format!("{}.{}", padded(frame), format.endings()[0]))
    }

    /// Whether a frame that a plan keeps exists.
    pub(crate) fn has(&self, plan: &Plan, named: Named<'_>, frame: &FrameResult) -> bool {
        let there =
            |path: PathBuf| path.metadata().is_ok_and(|file| file.is_file() && file.len() > 0);
        let formats = [FrameFormat::Png, FrameFormat::Exr];
        !is_kept(plan, named)
            || formats.into_iter().any(|format| there(self.file(named, frame.frame, format)))
    }

    /// Writes the emulated frame of a pair, if it is to be kept.
    pub(crate) fn write(&self, entry: &Entry<'_>) -> Result<(), EngineError> {
        let Entry::Pair(Finished { named, kept: Some(kept), result: Ok(frame), .. }) = *entry
        else {
            return Ok(());
        };
        let format = format(kept);
        let path = self.file(named, frame.frame, format);
        let failed = |path: &Path, error| EngineError::KeptFrame { path: path.to_owned(), error };
        let folder = path.parent().unwrap_or(&self.folder);
        make_folder(folder).map_err(|error| failed(folder, error))?;
        let bytes =
            encode_frame(kept, format).map_err(|error| failed(&path, io::Error::other(error)))?;
        write_whole(&path, &bytes).map_err(|error| match error {
            FileError::Write { path, error } | FileError::Read { path, error } => {
                failed(&path, error)
            }
            FileError::Format { path, detail, .. } => failed(&path, io::Error::other(detail)),
        })
    }
}

/// Refuses to keep frames in the folder that inputs are read from: they could replace them.
///
/// # Errors
/// If an input is in the folder.
pub(crate) fn check_inputs(plan: &Plan, found: &FoundInputs, results: &Path) -> Result<(), Error> {
    let keeps = |test: &(usize, SourceSpec)| matches!(&test.1, SourceSpec::Emulated(emulation) if emulation.keep_frames);
    let tests = plan.scenes.iter().flat_map(|scene| &scene.eyes).flat_map(|eye| &eye.tests);
    let Ok(folder) = results.join(FOLDER).canonicalize() else { return Ok(()) };
    if !tests.clone().any(keeps) {
        return Ok(());
    }
    let frames = found
        .views
        .iter()
        .flat_map(|view| view.frames.iter().flat_map(|frame| view.sources.of_frame(frame)));
    for (source, at) in frames {
        for (name, origin) in source.origins(at) {
            let Origin::File(path) = origin else { continue };
            if path.canonicalize().is_ok_and(|path| path.starts_with(&folder)) {
                let message = format!(
                    "{name}: this input is in the folder that emulated frames are written to"
                );
                return Err(Error::usage(message, "give another folder with {output}"));
            }
        }
    }
    Ok(())
}

/// Whether a plan keeps the emulated frames of a comparison.
fn is_kept(plan: &Plan, named: Named<'_>) -> bool {
    let scenes = plan.scenes.iter().filter(|scene| scene.name == named.scene);
    let eyes = scenes.flat_map(|scene| &scene.eyes).filter(|eye| eye.eye == named.eye);
    eyes.flat_map(|eye| &eye.tests).any(|(method, test)| {
        let keeps = matches!(test, SourceSpec::Emulated(emulation) if emulation.keep_frames);
        keeps && plan.methods[*method] == named.method
    })
}

/// PNG for codes, OpenEXR for linear light.
fn format(frame: &Frame) -> FrameFormat {
    if frame.samples().is_integer() { FrameFormat::Png } else { FrameFormat::Exr }
}

/// Copies the frames that a shard has kept.
///
/// # Errors
/// If a frame cannot be read or written.
pub(crate) fn copy_kept(shard: &Path, results: &Path) -> io::Result<()> {
    copy(&shard.join(FOLDER), &results.join(FOLDER))
}

/// Copies a folder with all that is in it, if it exists.
pub(crate) fn copy(from: &Path, to: &Path) -> io::Result<()> {
    let Ok(entries) = std::fs::read_dir(from) else { return Ok(()) };
    make_folder(to)?;
    for entry in entries {
        let entry = entry?;
        let (from, to) = (entry.path(), to.join(entry.file_name()));
        if entry.file_type()?.is_dir() {
            copy(&from, &to)?;
        } else {
            write_whole(&to, &std::fs::read(&from)?).map_err(io::Error::other)?;
        }
    }
    Ok(())
}
