//! Loads frames from sources, and checks whether pairs of them may be compared.

use std::sync::Arc;

use fovqa_emulate::{Border, BudgetReport, Counts};
use fovqa_frame::source::{InputId, MissingGuides, Source, SourceError};
use fovqa_frame::{
    BadPixel, Channels, CropError, Frame, Guides, Mask, Motion, Plane, Samples, Transfer,
};
use fovqa_gallery::Builtin;
use fovqa_plan::{Nonfinite, Settings};
use thiserror::Error;

use crate::found_frame::FoundFrame;
use crate::view_sources::ViewSources;

/// Why a pair cannot be compared.
#[derive(Debug, Error)]
pub(crate) enum LoadError {
    #[error(transparent)]
    Read(#[from] SourceError),
    #[error("{file}: {error}")]
    Crop { file: String, error: CropError },
    #[error("{reference} has {}x{} pixels, but {test} has {}x{}", reference_size.0, reference_size.1, test_size.0, test_size.1)]
    Size {
        reference: String,
        reference_size: (usize, usize),
        test: String,
        test_size: (usize, usize),
    },
    #[error("{file}: no {what} file matches this frame")]
    NoGuideFile { file: String, what: &'static str },
    #[error("frame {frame} has no {eye} eye, from which it would be reprojected")]
    NoDominantFrame { frame: i64, eye: &'static str },
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
    pub(crate) fn help(&self) -> &str {
        match self {
            Self::Read(error) => &error.help,
            Self::Crop { .. } => "{crop} is in pixels of the file",
            Self::Size { .. } => {
                "fovqa does not resample: render both at the same size, or crop them with {crop}"
            }
            Self::NoGuideFile { .. } => {
                "motion and depth files are paired with the reference by name, then by frame number"
            }
            Self::NoDominantFrame { .. } => {
                "render the same frames for both eyes, or leave reproject out"
            }
            Self::Nonfinite { .. } => {
                "correct the render, or leave out such pixels with {nonfinite=mask}"
            }
        }
    }
}

/// Why a frame has no scores: the error and how to correct it.
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

/// One test to load. The reference comes with the first test of its frame.
#[derive(Debug)]
pub(crate) struct Step<'a> {
    /// Index of the frame.
    pub(crate) frame: usize,
    /// The frame.
    pub(crate) found: &'a FoundFrame,
    /// Whether the reference is loaded as well.
    pub(crate) reference: bool,
    /// Index of the method.
    pub(crate) method: usize,
    /// Index of the test in the method's source.
    pub(crate) test: usize,
}

/// The frames that a step has loaded.
pub(crate) struct Loaded {
    pub(crate) reference: Option<Result<Side, LoadError>>,
    /// The test; `None` if it is emulated from the reference.
    pub(crate) test: Option<Result<Side, LoadError>>,
    /// The frame of the dominant eye, if methods take from it. It comes with the reference.
    pub(crate) dominant: Option<Result<Side, LoadError>>,
}

impl Loaded {
    /// Size of its pixels in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let bytes = |side: &Result<Side, LoadError>| match side {
            Ok(side) => side.frame.bytes() + side.guides.bytes(),
            Err(_) => 0,
        };
        [&self.reference, &self.test, &self.dominant].into_iter().flatten().map(bytes).sum()
    }
}

/// A frame with what its files contain.
pub(crate) struct Side {
    /// Name of the file, as results show it.
    pub(crate) file: Arc<str>,
    pub(crate) frame: Frame,
    /// Motion and depth, if they are wanted and exist.
    pub(crate) guides: Guides,
    /// The files read for the frame with their identities, if they are hashed.
    pub(crate) ids: Vec<(String, InputId)>,
    pub(crate) notes: Vec<String>,
    /// Width of a pixel divided by its height, as the file declares it.
    pub(crate) pixel_aspect: f32,
    /// What belongs to an emulated frame.
    pub(crate) made: Option<Made>,
    bad: Option<BadPixel>,
    missing: MissingGuides,
}

/// What belongs to an emulated frame.
pub(crate) struct Made {
    /// The samples that it stands for.
    pub(crate) counts: Counts,
    /// The share of its samples that is shaded, if it takes what it can from the other eye.
    pub(crate) reshaded_share: Option<f64>,
    /// The budget, and how it was met.
    pub(crate) budget: Option<BudgetReport>,
    /// The frame as it is to be kept, if it is.
    pub(crate) kept: Option<Frame>,
    /// The borders between the layers or rates of the method.
    pub(crate) borders: Vec<Border>,
}

impl Side {
    /// A test that was emulated.
    pub(crate) fn emulated(file: String, frame: Frame, pixel_aspect: f32, made: Made) -> Self {
        Self {
            file: file.into(),
            frame,
            guides: Guides::default(),
            ids: Vec::new(),
            notes: Vec::new(),
            pixel_aspect,
            made: Some(made),
            bad: None,
            missing: MissingGuides::default(),
        }
    }

    /// Checks that a frame from which others are emulated has no bad pixel.
    pub(crate) fn finite(&self) -> Result<(), Fault> {
        let Some(bad) = self.bad else { return Ok(()) };
        let error = LoadError::Nonfinite { file: self.file.to_string(), bad };
        let help =
            "correct the render: an emulated method would spread such pixels over their neighbours";
        Err(Fault { message: error.to_string(), help: help.to_owned() })
    }

    pub(crate) fn size(&self) -> (usize, usize) {
        (self.frame.width(), self.frame.height())
    }
}

/// Checks whether two frames may be compared. Returns where both are finite; `None` means
/// everywhere.
pub(crate) fn comparable(
    reference: &Side,
    test: &Side,
    nonfinite: Nonfinite,
) -> Result<Option<Mask>, LoadError> {
    if reference.size() != test.size() {
        return Err(LoadError::Size {
            reference_size: reference.size(),
            reference: reference.file.to_string(),
            test_size: test.size(),
            test: test.file.to_string(),
        });
    }
    let mut finite: Option<Mask> = None;
    for side in [reference, test] {
        let Some(bad) = side.bad else { continue };
        if nonfinite == Nonfinite::Error {
            return Err(LoadError::Nonfinite { file: side.file.to_string(), bad });
        }
        let mask = side.frame.finite_mask();
        match &mut finite {
            None => finite = Some(mask),
            Some(both) => both.intersect(&mask),
        }
    }
    Ok(finite)
}

/// The settings that loading depends on.
#[derive(Debug)]
pub(crate) struct Loader<'a> {
    pub(crate) settings: &'a Settings,
    pub(crate) sources: &'a ViewSources,
    /// Whether any metric or temporal filter uses motion and depth.
    pub(crate) guides: bool,
}

impl Loader<'_> {
    /// The number of steps that may be loaded at the same time.
    pub(crate) fn loaders(&self) -> usize {
        let in_turn = self.sources.all().any(Source::is_read_once);
        if in_turn { 1 } else { rayon::current_num_threads() }
    }

    /// Loads the frames of a step in parallel.
    pub(crate) fn load(&self, step: &Step<'_>) -> Loaded {
        let first = step.frame == 0;
        let (reference, test) = rayon::join(
            || step.reference.then(|| self.reference(step.found, first)),
            || {
                let source = self.sources.test(step.method).read()?;
                Some(self.side(source, step.test, self.guides))
            },
        );
        Loaded { reference, test, dominant: None }
    }

    /// A frame whose built-in scene is sampled itself: its ground truth is not needed and
    /// black, and only its motion and depth are computed, if they are wanted.
    pub(crate) fn unlit(&self, builtin: &Builtin, found: &FoundFrame) -> Side {
        let at = found.reference;
        let (width, height) = (builtin.view().width, builtin.view().height);
        let black = Samples::F32(vec![0.0; 3 * width * height].into());
        let frame = Frame::new(width, height, Channels::Rgb, black);
        let frame = frame.unwrap_or_else(|_| unreachable!("three values for each pixel"));
        Side {
            file: self.sources.reference.listing().name(at).into(),
            frame,
            guides: if self.guides { builtin.guides(at) } else { Guides::default() },
            ids: Vec::new(),
            notes: Vec::new(),
            pixel_aspect: 1.0,
            made: None,
            bad: None,
            missing: MissingGuides::default(),
        }
    }

    /// Loads the frames of a pair alone, for code that looks ahead in a sequence. A test that is
    /// not read is `emulated` from the reference.
    pub(crate) fn pair(
        &self,
        frame: &FoundFrame,
        method: usize,
        emulated: impl FnOnce(&Frame) -> Result<Frame, Fault>,
    ) -> Result<[Frame; 2], Fault> {
        let Some(source) = self.sources.test(method).read() else {
            let reference = self.side(&*self.sources.reference, frame.reference, false)?;
            reference.finite()?;
            let test = emulated(&reference.frame)?;
            return Ok([reference.frame, test]);
        };
        let test = frame.tests.iter().find(|(m, _)| *m == method).map(|(_, test)| *test);
        let Some(test) = test else { unreachable!("the frame is of the method's sequence") };
        let (reference, test) = rayon::join(
            || self.side(&*self.sources.reference, frame.reference, false),
            || self.side(source, test, false),
        );
        let (reference, test) = (reference?, test?);
        comparable(&reference, &test, Nonfinite::Error)?;
        Ok([reference.frame, test.frame])
    }

    /// Loads a reference with its motion and depth, from its own source or from others.
    pub(crate) fn reference(&self, found: &FoundFrame, first: bool) -> Result<Side, LoadError> {
        let mut side = self.side(&*self.sources.reference, found.reference, self.guides)?;
        if !self.guides {
            return Ok(side);
        }
        let own = found.guides;
        for (what, lacks) in [
            ("motion", !first && self.sources.motion.is_some() && own.motion.is_none()),
            ("depth", self.sources.depth.is_some() && own.depth.is_none()),
        ] {
            if lacks {
                return Err(LoadError::NoGuideFile { file: side.file.to_string(), what });
            }
        }
        if let Some((source, at)) = self.sources.motion.as_ref().zip(own.motion) {
            side.guides.motion = self.guides_of(&**source, at, &mut side)?.motion;
        }
        if let Some((source, at)) = self.sources.depth.as_ref().zip(own.depth) {
            side.guides.depth = self.guides_of(&**source, at, &mut side)?.depth;
        }
        // A file that the user has named must exist. A file that fovqa only looks for need not.
        let missing_motion = side.missing.motion.take().filter(|_| !first && own.motion.is_none());
        let missing_depth = side.missing.depth.take().filter(|_| own.depth.is_none());
        match missing_motion.or(missing_depth) {
            Some(error) => Err(LoadError::Read(error)),
            None => Ok(side),
        }
    }

    /// Loads motion or depth from a source of its own.
    fn guides_of(
        &self,
        source: &dyn Source,
        at: usize,
        side: &mut Side,
    ) -> Result<Guides, LoadError> {
        let file = source.listing().name(at).to_owned();
        let read = source.read_guides(at)?;
        side.ids.extend(read.inputs);
        side.notes.extend(read.notes);
        let guides = read.guides;
        let motion = guides.motion.as_ref().map(Motion::file_size);
        let size = motion.or(guides.depth.as_ref().map(Plane::file_size));
        if let Some(size) = size.filter(|size| *size != side.frame.file_size()) {
            return Err(LoadError::Size {
                reference: side.file.to_string(),
                reference_size: side.frame.file_size(),
                test: file,
                test_size: size,
            });
        }
        self.cropped(guides, &file)
    }

    fn cropped(&self, guides: Guides, file: &str) -> Result<Guides, LoadError> {
        match self.settings.crop {
            Some(crop) => guides
                .cropped(crop)
                .map_err(|error| LoadError::Crop { file: file.to_owned(), error }),
            None => Ok(guides),
        }
    }

    fn side(&self, source: &dyn Source, at: usize, guides: bool) -> Result<Side, LoadError> {
        let Settings { signal, crop, .. } = self.settings;
        let file = source.listing().shared_name(at);
        let picture = source.read(at, guides)?;
        let mut notes = picture.notes;
        let guides = self.cropped(picture.guides, &file)?;
        let frame = match *crop {
            Some(crop) => picture
                .frame
                .cropped(crop)
                .map_err(|error| LoadError::Crop { file: file.to_string(), error })?,
            None => picture.frame,
        };
        let encoded_floats =
            !frame.samples().is_integer() && signal.transfer_of(&frame) != Transfer::Linear;
        if encoded_floats {
            let (low, high) = frame.range();
            if low < 0.0 || high > 1.0 {
                let range =
                    "values outside 0 to 1, which an encoded signal cannot have, are clamped";
                notes.push(range.to_owned());
            }
        }
        let bad = frame.bad_pixel();
        let (ids, pixel_aspect, missing) = (picture.inputs, picture.pixel_aspect, picture.missing);
        let made = None;
        Ok(Side { file, frame, guides, ids, notes, pixel_aspect, made, bad, missing })
    }
}
