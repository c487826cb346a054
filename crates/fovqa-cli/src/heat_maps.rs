//! `--maps DIR`: heat maps of each frame, as files.

use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Entry, Finished, FvvdpMaps, Named};
use fovqa_io::{exr_gray, png_rgb8};
use fovqa_metrics::Metric;
use fovqa_results::{FileError, FrameResult, write_whole};

/// A folder for heat maps.
#[derive(Debug)]
pub(crate) struct HeatMaps {
    folder: PathBuf,
    /// Whether frames of several comparisons meet there, each in a folder of its own.
    several: bool,
}

impl HeatMaps {
    pub(crate) fn new(folder: PathBuf, several: bool) -> Self {
        Self { folder, several }
    }

    /// The folder of a comparison.
    fn folder(&self, named: Named<'_>) -> PathBuf {
        let mut folder = self.folder.clone();
        if self.several {
            folder.extend([named.scene, named.method]);
            folder.extend(named.eye.map(fovqa_config::Eye::name));
        }
        folder
    }

    /// Whether those of a frame are there, where it has some.
    pub(crate) fn has(&self, named: Named<'_>, frame: &FrameResult) -> bool {
        let raw = self.folder(named).join(raw(frame.frame));
        !frame.rows.has(Metric::Fvvdp) || raw.is_file()
    }

    /// Writes those of a pair, where it has some.
    pub(crate) fn write(&self, entry: &Entry<'_>) -> Result<(), EngineError> {
        let Entry::Pair(Finished { named, maps: Some(maps), result: Ok(frame), .. }) = *entry
        else {
            return Ok(());
        };
        let folder = self.folder(named);
        let at = |path: &Path, error| EngineError::Map { path: path.to_owned(), error };
        std::fs::create_dir_all(&folder).map_err(|error| at(&folder, error))?;
        for (name, bytes) in files(maps, frame.frame) {
            let path = folder.join(name);
            let bytes = bytes.map_err(|error| at(&path, error))?;
            write_whole(&path, &bytes).map_err(|error| match error {
                FileError::Write { path, error } | FileError::Read { path, error } => {
                    EngineError::Map { path, error }
                }
                FileError::Format { path, detail, .. } => {
                    EngineError::Map { path, error: io::Error::other(detail) }
                }
            })?;
        }
        Ok(())
    }
}

fn files(maps: &FvvdpMaps, frame: i64) -> Vec<(String, io::Result<Vec<u8>>)> {
    let (width, height) = (maps.raw.width(), maps.raw.height());
    let values = (0..height).flat_map(|y| maps.raw.row(y)).copied();
    let raw_map = (raw(frame), exr_gray(width, height, values));
    let colored = maps.colored.iter().map(|(colors, codes)| {
        let name = format!("fvvdp-{}-{}.png", colors.name(), padded(frame));
        (name, png_rgb8(width, height, codes))
    });
    // The raw one last: where it is there, all are.
    colored.chain([raw_map]).collect()
}

/// The name of a frame's raw map.
fn raw(frame: i64) -> String {
    format!("fvvdp-{}.exr", padded(frame))
}

/// A frame's number with four digits at least, behind the minus sign of a negative one.
fn padded(frame: i64) -> String {
    let sign = if frame < 0 { "-" } else { "" };
    format!("{sign}{:04}", frame.unsigned_abs())
}
