//! Files to frames, and frames to pairs that may be compared.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fovqa_frame::{BadPixel, CropError, Frame, Guides, Mask, Motion, Plane, Transfer};
use fovqa_io::{
    DepthChannels, FileId, GuideOptions, GuideSearch, MotionChannels, Note, ReadError,
    ReadErrorKind, ReadOptions, read_frame, read_frame_and_hash, read_guides, read_guides_and_hash,
};
use fovqa_plan::{Nonfinite, Plan, Settings};
use thiserror::Error;

use crate::find::{FoundFrame, GuideFiles};

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
    #[error("{file}: no file of {what} belongs to it")]
    NoGuideFile { file: String, what: &'static str },
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
            Self::NoGuideFile { .. } => {
                "files of motion and depth pair with the reference by name, then by the number of the frame"
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
    /// The reference, where this is the first test of its frame, and what has files of its own.
    pub(crate) reference: Option<(&'a Path, &'a GuideFiles)>,
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
            Ok(side) => side.frame.bytes() + side.guides.bytes(),
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
    /// Motion and depth, where they are wanted and there.
    pub(crate) guides: Guides,
    /// The files read for it, where they are hashed.
    pub(crate) ids: Vec<(String, FileId)>,
    pub(crate) notes: Vec<String>,
    /// Width of a pixel over its height, as the file declares it.
    pub(crate) pixel_aspect: f32,
    bad: Option<BadPixel>,
    missing: Missing,
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
    /// Layers of the tests of methods that have their own.
    pub(crate) test_layers: &'a BTreeMap<usize, String>,
    /// Whether motion and depth are of any use.
    pub(crate) guides: bool,
}

impl Loader<'_> {
    /// The files of a step, at the same time.
    pub(crate) fn load(&self, step: &Step<'_>) -> Loaded {
        let first = step.frame == 0;
        let (reference, test) = rayon::join(
            || step.reference.map(|(path, guides)| self.reference(path, guides, first)),
            || self.side(step.test, self.test_layer(step.method), &self.beside_colour()),
        );
        Loaded { reference, test }
    }

    /// The frames of a pair by themselves: for what looks ahead in a sequence.
    pub(crate) fn pair(&self, frame: &FoundFrame, method: usize) -> Result<[Frame; 2], Fault> {
        let test = frame.tests.iter().find(|(m, _)| *m == method).map(|(_, test)| test);
        let Some(test) = test else { unreachable!("the frame is of the method's sequence") };
        let nothing = GuideOptions::default();
        let (reference, test) = rayon::join(
            || self.side(&frame.reference, self.layer(), &nothing),
            || self.side(test, self.test_layer(method), &nothing),
        );
        let (reference, test) = (reference?, test?);
        comparable(&reference, &test, Nonfinite::Error)?;
        Ok([reference.frame, test.frame])
    }

    /// The colour layer of the reference.
    fn layer(&self) -> Option<&str> {
        self.settings.read.layer.as_deref()
    }

    /// The colour layer of a method's tests.
    fn test_layer(&self, method: usize) -> Option<&str> {
        self.test_layers.get(&method).map(String::as_str).or(self.layer())
    }

    /// What is looked for beside the colour: not the names a user has given channels of files of their
    /// own, which may be those of colours here.
    fn beside_colour(&self) -> GuideOptions {
        let Settings { guides, motion_files, depth_files, .. } = self.settings;
        let mut wanted = if self.guides { guides.clone() } else { GuideOptions::default() };
        if motion_files.is_some() && is_named(&wanted.motion) {
            wanted.motion = MotionChannels::None;
        }
        if depth_files.is_some() && matches!(wanted.depth, DepthChannels::Named(_)) {
            wanted.depth = DepthChannels::None;
        }
        wanted
    }

    /// A reference with its motion and depth, from its own file or from others.
    fn reference(&self, path: &Path, files: &GuideFiles, first: bool) -> Result<Side, LoadError> {
        let mut side = self.side(path, self.layer(), &self.beside_colour())?;
        if !self.guides {
            return Ok(side);
        }
        let named = &self.settings.guides;
        let lacks =
            |wanted: &Option<PathBuf>, file: &Option<PathBuf>| wanted.is_some() && file.is_none();
        for (what, lacks) in [
            ("motion", !first && lacks(&self.settings.motion_files, &files.motion)),
            ("depth", lacks(&self.settings.depth_files, &files.depth)),
        ] {
            if lacks {
                return Err(LoadError::NoGuideFile { file: side.file, what });
            }
        }
        if let Some(file) = &files.motion {
            let motion = GuideOptions { motion: named.motion.clone(), ..GuideOptions::default() };
            side.guides.motion = self.guides_of(file, &motion, &mut side)?.motion;
        }
        if let Some(file) = &files.depth {
            let depth = GuideOptions { depth: named.depth.clone(), ..GuideOptions::default() };
            side.guides.depth = self.guides_of(file, &depth, &mut side)?.depth;
        }
        // What a user has named has to be there; what is only looked for need not.
        let missing_motion =
            side.missing.motion.take().filter(|_| !first && files.motion.is_none());
        let missing_depth = side.missing.depth.take().filter(|_| files.depth.is_none());
        match missing_motion.or(missing_depth) {
            Some(kind) => Err(LoadError::Read(ReadError { path: PathBuf::from(&side.file), kind })),
            None => Ok(side),
        }
    }

    /// Motion or depth from a file of its own.
    fn guides_of(
        &self,
        path: &Path,
        wanted: &GuideOptions,
        side: &mut Side,
    ) -> Result<Guides, LoadError> {
        let file = self.plan.shown(path);
        let named = |error: ReadError| ReadError { path: PathBuf::from(&file), ..error };
        let options = ReadOptions { guides: wanted.clone(), ..self.settings.read.clone() };
        let decoded = if self.plan.hash_inputs {
            let (decoded, id) = read_guides_and_hash(path, &options).map_err(named)?;
            side.ids.push((file.clone(), id));
            decoded
        } else {
            read_guides(path, &options).map_err(named)?
        };
        side.notes.extend(decoded.notes.iter().map(Note::in_words));
        let guides = decoded.guides;
        let motion = guides.motion.as_ref().map(Motion::file_size);
        let size = motion.or(guides.depth.as_ref().map(Plane::file_size));
        if let Some(size) = size.filter(|size| *size != side.frame.file_size()) {
            return Err(LoadError::Size {
                reference: side.file.clone(),
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

    fn side(
        &self,
        path: &Path,
        layer: Option<&str>,
        guides: &GuideOptions,
    ) -> Result<Side, LoadError> {
        let Settings { signal, crop, .. } = self.settings;
        let file = self.plan.shown(path);
        let named = |error: ReadError| ReadError { path: PathBuf::from(&file), ..error };
        let (guides, layer) = (guides.clone(), layer.map(str::to_owned));
        let read = ReadOptions { guides, layer, ..self.settings.read.clone() };
        let (decoded, ids) = if self.plan.hash_inputs {
            let (decoded, id) = read_frame_and_hash(path, &read).map_err(named)?;
            (decoded, vec![(file.clone(), id)])
        } else {
            (read_frame(path, &read).map_err(named)?, Vec::new())
        };
        let missing = Missing::of(&read.guides, &decoded.guide_search);
        let mut notes: Vec<String> = decoded.notes.iter().map(Note::in_words).collect();
        let guides = self.cropped(decoded.guides, &file)?;
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
        let pixel_aspect = decoded.pixel_aspect;
        Ok(Side { file, frame, guides, ids, notes, pixel_aspect, bad, missing })
    }
}

/// Whether a user has named the channels of the motion.
fn is_named(motion: &MotionChannels) -> bool {
    matches!(motion, MotionChannels::Named(_) | MotionChannels::NamedAs(..))
}

/// What a user has named and a file does not have.
#[derive(Debug, Default)]
struct Missing {
    motion: Option<ReadErrorKind>,
    depth: Option<ReadErrorKind>,
}

impl Missing {
    fn of(wanted: &GuideOptions, search: &GuideSearch) -> Self {
        let named_motion = !matches!(wanted.motion, MotionChannels::None | MotionChannels::Auto);
        let named_depth = !matches!(wanted.depth, DepthChannels::None | DepthChannels::Auto);
        Self {
            motion: search.missing_motion().filter(|_| named_motion),
            depth: search.missing_depth().filter(|_| named_depth),
        }
    }
}
