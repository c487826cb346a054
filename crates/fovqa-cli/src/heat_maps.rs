//! `--maps DIR`: heat maps of each frame, as files.

use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Finished, FvvdpMaps};
use fovqa_io::{exr_gray, png_rgb8};
use fovqa_results::{FileError, write_whole};

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

    /// Writes those of a frame, where it has some.
    pub(crate) fn write(&self, finished: &Finished<'_>) -> Result<(), EngineError> {
        let (Some(maps), Ok(frame)) = (finished.maps, finished.result) else { return Ok(()) };
        let mut folder = self.folder.clone();
        if self.several {
            folder.extend([finished.scene, finished.method]);
            folder.extend(finished.eye.map(fovqa_config::Eye::name));
        }
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

fn files(maps: &FvvdpMaps, frame: u64) -> Vec<(String, io::Result<Vec<u8>>)> {
    let (width, height) = (maps.raw.width(), maps.raw.height());
    let values = (0..height).flat_map(|y| maps.raw.row(y)).copied();
    let raw = (format!("fvvdp-{frame:04}.exr"), exr_gray(width, height, values));
    let colored = maps.colored.iter().map(|(colors, codes)| {
        let name = format!("fvvdp-{}-{frame:04}.png", colors.name());
        (name, png_rgb8(width, height, codes))
    });
    std::iter::once(raw).chain(colored).collect()
}
