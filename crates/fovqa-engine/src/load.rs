//! One pair of files to one pair of frames that may be compared.

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

impl Loader<'_> {
    /// Both files at the same time.
    pub(crate) fn load(&self, pair: &FramePair) -> Result<Loaded, LoadError> {
        let (reference, test) =
            rayon::join(|| self.load_one(&pair.reference), || self.load_one(&pair.test));
        let (reference, mut notes) = reference?;
        let (test, test_notes) = test?;
        notes.extend(test_notes);
        let size = |frame: &Frame| (frame.width(), frame.height());
        if size(&reference.0) != size(&test.0) {
            return Err(LoadError::Size {
                reference: pair.reference.display().to_string(),
                reference_size: size(&reference.0),
                test: pair.test.display().to_string(),
                test_size: size(&test.0),
            });
        }
        let mut finite = None;
        for (path, (frame, bad)) in [(&pair.reference, &reference), (&pair.test, &test)] {
            let Some(bad) = *bad else { continue };
            if self.nonfinite == Nonfinite::Error {
                return Err(LoadError::Nonfinite { file: path.display().to_string(), bad });
            }
            let mask = frame.finite_mask();
            match &mut finite {
                None => finite = Some(mask),
                Some(both) => both.intersect(&mask),
            }
        }
        Ok(Loaded { reference: reference.0, test: test.0, finite, notes })
    }

    #[allow(clippy::type_complexity, reason = "a frame with its findings, used once")]
    fn load_one(
        &self,
        path: &std::path::Path,
    ) -> Result<((Frame, Option<BadPixel>), Vec<(String, String)>), LoadError> {
        let decoded = read_frame(path, self.read)?;
        let file = || path.display().to_string();
        let mut notes: Vec<(String, String)> =
            decoded.notes.iter().map(|note: &Note| (file(), note.in_words())).collect();
        let frame = match self.crop {
            Some(crop) => decoded
                .frame
                .cropped(crop)
                .map_err(|error| LoadError::Crop { file: file(), error })?,
            None => decoded.frame,
        };
        let encoded_floats =
            !frame.samples().is_integer() && self.signal.transfer_of(&frame) != Transfer::Linear;
        if encoded_floats {
            let (low, high) = frame.range();
            if low < 0.0 || high > 1.0 {
                let range =
                    "values beyond 0 to 1, which an encoded signal cannot have, are clamped";
                notes.push((file(), range.to_owned()));
            }
        }
        let bad = frame.bad_pixel();
        Ok(((frame, bad), notes))
    }
}
