//! Files to frames, and frames to pairs that may be compared.

use std::path::{Path, PathBuf};

use fovqa_config::{Nonfinite, Plan, Settings};
use fovqa_frame::{BadPixel, CropError, Frame, Mask, Transfer};
use fovqa_io::{FileId, Note, ReadError, read_frame, read_frame_and_hash};
use thiserror::Error;

/// Why a pair cannot be compared.
#[derive(Debug, Error)]
pub(crate) enum LoadError {
    #[error(transparent)]
    Read(#[from] ReadError),
    #[error("{file}: {error}")]
    Crop { file: String, error: CropError },
    #[error("{reference} has {}x{} pixels and {test} has {}x{}", reference_size.0, reference_size.1, test_size.0, test_size.1)]
    Size {
        reference: String,
        reference_size: (usize, usize),
        test: String,
        test_size: (usize, usize),
    },
    #[error("{file}: channel {} is {} at pixel ({}, {}){}", bad.channel, bad.value, bad.x, bad.y, more(bad.pixels))]
    Nonfinite { file: String, bad: BadPixel },
}

fn more(pixels: u64) -> String {
    match pixels {
        1 => String::new(),
        2 => ", and one more pixel is bad".to_owned(),
        n => format!(", and {} more pixels are bad", n - 1),
    }
}

impl LoadError {
    pub(crate) fn help(&self) -> &'static str {
        match self {
            Self::Read(error) => error.kind.help(),
            Self::Crop { .. } => "{crop} is in pixels of the file",
            Self::Size { .. } => {
                "nothing is resampled: render both at one size, or cut with {crop}"
            }
            Self::Nonfinite { .. } => {
                "mend the render, or leave such pixels out with {nonfinite=mask}"
            }
        }
    }
}

/// Why a frame has no scores: what is wrong, and how to mend it.
#[derive(Debug, Clone)]
pub(crate) struct Fault {
    pub(crate) message: String,
    pub(crate) help: String,
}

impl From<LoadError> for Fault {
    fn from(error: LoadError) -> Self {
        Self { message: error.to_string(), help: error.help().to_owned() }
    }
}

/// One file to load: the reference of a frame with its first test, or another test of it.
#[derive(Debug)]
pub(crate) struct Step<'a> {
    /// Index of the frame.
    pub(crate) frame: usize,
    /// The reference, where this is the first test of its frame.
    pub(crate) reference: Option<&'a Path>,
    /// Index of the method.
    pub(crate) method: usize,
    /// The test.
    pub(crate) test: &'a Path,
}

/// What a step has brought.
pub(crate) struct Loaded {
    pub(crate) reference: Option<Result<Side, LoadError>>,
    pub(crate) test: Result<Side, LoadError>,
}

impl Loaded {
    /// Bytes of its pixels.
    pub(crate) fn bytes(&self) -> usize {
        let bytes = |side: &Result<Side, LoadError>| match side {
            Ok(side) => side.frame.bytes(),
            Err(_) => 0,
        };
        self.reference.as_ref().map_or(0, bytes) + bytes(&self.test)
    }
}

/// A frame with what was found in it.
pub(crate) struct Side {
    /// The file, as results show it.
    pub(crate) file: String,
    pub(crate) frame: Frame,
    pub(crate) id: Option<FileId>,
    pub(crate) notes: Vec<String>,
    bad: Option<BadPixel>,
}

impl Side {
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.frame.width(), self.frame.height())
    }
}

/// Whether two frames may be compared, and where both are finite; `None`: everywhere.
pub(crate) fn comparable(
    reference: &Side,
    test: &Side,
    nonfinite: Nonfinite,
) -> Result<Option<Mask>, LoadError> {
    if reference.size() != test.size() {
        return Err(LoadError::Size {
            reference_size: reference.size(),
            reference: reference.file.clone(),
            test_size: test.size(),
            test: test.file.clone(),
        });
    }
    let mut finite: Option<Mask> = None;
    for side in [reference, test] {
        let Some(bad) = side.bad else { continue };
        if nonfinite == Nonfinite::Error {
            return Err(LoadError::Nonfinite { file: side.file.clone(), bad });
        }
        let mask = side.frame.finite_mask();
        match &mut finite {
            None => finite = Some(mask),
            Some(both) => both.intersect(&mask),
        }
    }
    Ok(finite)
}

/// What loading depends on.
#[derive(Debug)]
pub(crate) struct Loader<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) settings: &'a Settings,
}

impl Loader<'_> {
    /// The files of a step, at the same time.
    pub(crate) fn load(&self, step: &Step<'_>) -> Loaded {
        let (reference, test) =
            rayon::join(|| step.reference.map(|path| self.side(path)), || self.side(step.test));
        Loaded { reference, test }
    }

    fn side(&self, path: &Path) -> Result<Side, LoadError> {
        let Settings { read, signal, crop, .. } = self.settings;
        let file = self.plan.shown(path);
        let named = |error: ReadError| ReadError { path: PathBuf::from(&file), ..error };
        let (decoded, id) = if self.plan.hash_inputs {
            let (decoded, id) = read_frame_and_hash(path, read).map_err(named)?;
            (decoded, Some(id))
        } else {
            (read_frame(path, read).map_err(named)?, None)
        };
        let mut notes: Vec<String> = decoded.notes.iter().map(Note::in_words).collect();
        let frame = match *crop {
            Some(crop) => decoded
                .frame
                .cropped(crop)
                .map_err(|error| LoadError::Crop { file: file.clone(), error })?,
            None => decoded.frame,
        };
        let encoded_floats =
            !frame.samples().is_integer() && signal.transfer_of(&frame) != Transfer::Linear;
        if encoded_floats {
            let (low, high) = frame.range();
            if low < 0.0 || high > 1.0 {
                let range =
                    "values beyond 0 to 1, which an encoded signal cannot have, are clamped";
                notes.push(range.to_owned());
            }
        }
        let bad = frame.bad_pixel();
        Ok(Side { file, frame, id, notes, bad })
    }
}
