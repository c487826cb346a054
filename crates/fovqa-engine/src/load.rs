//! One pair of files to one pair of frames that may be compared.

use std::path::Path;

use fovqa_frame::{BadPixel, Crop, CropError, Frame, Mask, SignalParams, Transfer};
use fovqa_io::sequence::FramePair;
use fovqa_io::{Note, ReadError, ReadOptions, read_frame};
use thiserror::Error;

use crate::request::Nonfinite;

/// A pair that may be compared.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) reference: Frame,
    pub(crate) test: Frame,
    /// Where both are finite; `None`: everywhere.
    pub(crate) finite: Option<Mask>,
    /// Remarks, with the file they are about.
    pub(crate) notes: Vec<(String, String)>,
}

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
            Self::Crop { .. } => "--crop is X,Y,W,H in pixels of the file",
            Self::Size { .. } => {
                "nothing is resampled: render both at one size, or cut with --crop"
            }
            Self::Nonfinite { .. } => {
                "mend the render, or pass --nonfinite mask to leave such pixels out"
            }
        }
    }
}

/// Why a frame has no scores: what is wrong, and how to mend it.
pub(crate) struct Fault {
    pub(crate) message: String,
    pub(crate) help: String,
}

impl From<LoadError> for Fault {
    fn from(error: LoadError) -> Self {
        Self { message: error.to_string(), help: error.help().to_owned() }
    }
}

/// What loading depends on.
#[derive(Debug)]
pub(crate) struct Loader<'a> {
    pub(crate) read: &'a ReadOptions,
    pub(crate) crop: Option<Crop>,
    pub(crate) nonfinite: Nonfinite,
    pub(crate) signal: &'a SignalParams,
}

/// One side of a pair, with what was found in it.
struct Side {
    file: String,
    frame: Frame,
    bad: Option<BadPixel>,
    notes: Vec<String>,
}

impl Side {
    fn size(&self) -> (usize, usize) {
        (self.frame.width(), self.frame.height())
    }
}

impl Loader<'_> {
    /// Both files at the same time.
    pub(crate) fn load(&self, pair: &FramePair) -> Result<Loaded, LoadError> {
        let (reference, test) =
            rayon::join(|| self.side(&pair.reference), || self.side(&pair.test));
        let (reference, test) = (reference?, test?);
        if reference.size() != test.size() {
            return Err(LoadError::Size {
                reference_size: reference.size(),
                reference: reference.file,
                test_size: test.size(),
                test: test.file,
            });
        }
        let mut finite: Option<Mask> = None;
        let mut notes = Vec::new();
        for side in [&reference, &test] {
            notes.extend(side.notes.iter().map(|note| (side.file.clone(), note.clone())));
            let Some(bad) = side.bad else { continue };
            if self.nonfinite == Nonfinite::Error {
                return Err(LoadError::Nonfinite { file: side.file.clone(), bad });
            }
            let mask = side.frame.finite_mask();
            match &mut finite {
                None => finite = Some(mask),
                Some(both) => both.intersect(&mask),
            }
        }
        Ok(Loaded { reference: reference.frame, test: test.frame, finite, notes })
    }

    fn side(&self, path: &Path) -> Result<Side, LoadError> {
        let decoded = read_frame(path, self.read)?;
        let file = path.display().to_string();
        let mut notes: Vec<String> = decoded.notes.iter().map(Note::in_words).collect();
        let frame = match self.crop {
            Some(crop) => decoded
                .frame
                .cropped(crop)
                .map_err(|error| LoadError::Crop { file: file.clone(), error })?,
            None => decoded.frame,
        };
        let encoded_floats =
            !frame.samples().is_integer() && self.signal.transfer_of(&frame) != Transfer::Linear;
        if encoded_floats {
            let (low, high) = frame.range();
            if low < 0.0 || high > 1.0 {
                let range =
                    "values beyond 0 to 1, which an encoded signal cannot have, are clamped";
                notes.push(range.to_owned());
            }
        }
        let bad = frame.bad_pixel();
        Ok(Side { file, frame, bad, notes })
    }
}
