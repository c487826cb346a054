//! Errors that prevent a run from starting.

use std::path::{Path, PathBuf};

use fovqa_emulate::EmulateError;
use fovqa_frame::source::{Doubt, SourceError};
use fovqa_gallery::GalleryError;
use fovqa_io::sequence::{ListingError, PairingError};
use fovqa_io::{OpenError, ReadError};
use fovqa_metrics::Metric;
use fovqa_metrics::fvvdp::TimeError;
use fovqa_params::ParamError;
use fovqa_vision::{GazeTraceError, ViewError};
use thiserror::Error;

use crate::needed_memory::{Needed, gigabytes};
use crate::output_error::OutputError;

/// Why a run could not start.
#[derive(Debug, Error)]
pub enum EngineError {
    /// A path argument that matches nothing.
    #[error(transparent)]
    Listing(#[from] ListingError),
    /// A path argument that exists but is not a sequence of frames.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// Frames that have no partners.
    #[error(transparent)]
    Pairing(#[from] PairingError),
    /// A source that the caller had to provide and did not.
    #[error("the plan uses the source {name:?}, but no such source was given")]
    NotGiven {
        /// The name of the source in the plan.
        name: String,
    },
    /// Not as many gaze points as frames.
    #[error("the number of gaze points is {points}, but that of frames is {frames}")]
    GazeCount {
        /// Number of points.
        points: usize,
        /// Number of frames.
        frames: usize,
    },
    /// A reference that is emulated.
    #[error("only tests can be emulated, not the reference")]
    EmulatedReference,
    /// A method that cannot be emulated as the plan says.
    #[error(transparent)]
    Emulate(#[from] EmulateError),
    /// An emulated frame that cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A built-in scene that cannot be.
    #[error(transparent)]
    Gallery(#[from] GalleryError),
    /// The temporal filter of an emulated method needs the frames in their order.
    #[error(
        "with this fvvdp.temp_padding, FovVideoVDP begins with later frames, but the temporal filter of {method} needs the frames in their order"
    )]
    LooksAhead {
        /// The model of the method.
        method: &'static str,
    },
    /// A method that takes from the frames of the other eye, and FovVideoVDP begins a sequence with its
    /// later frames.
    #[error(
        "to reproject, {method} needs the frames of both eyes in their order, but with this fvvdp.temp_padding FovVideoVDP begins with later frames"
    )]
    ReprojectsAhead {
        /// The model of the method.
        method: &'static str,
    },
    /// A selection that contains no frame.
    #[error("the selection contains no frame; the frames are {first} to {last}")]
    NoFrames {
        /// Lowest frame number that exists.
        first: i64,
        /// Highest frame number that exists.
        last: i64,
    },
    /// Frames are requested by number, but the file names have no numbers that tell them apart.
    #[error("{argument}: {what} needs frame numbers, but the numbers in the file names do not identify the frames: {}", doubt.in_words())]
    NoNumbers {
        /// The reference argument.
        argument: String,
        /// What depends on the numbers.
        what: &'static str,
        /// Why the names have no such numbers.
        doubt: Doubt,
    },
    /// A view that is not possible.
    #[error(transparent)]
    View(#[from] ViewError),
    /// Something needs a view, and there is none.
    #[error("{what} needs a view, but no view is given")]
    NoView {
        /// What needs it.
        what: String,
    },
    /// Something needs the photometry of the display, and there is none.
    #[error("{what} needs the display's photometry, but {}", unlit(display.as_ref()))]
    NoLuminance {
        /// What needs it.
        what: String,
        /// The name of the display, if one is given.
        display: Option<String>,
    },
    /// A display that cannot show the files as they are encoded.
    #[error("{what}: {why}")]
    ShownWrongly {
        /// What depends on the luminance of the display.
        what: String,
        /// Why the display cannot show the files.
        why: String,
    },
    /// A sequence that cannot be filtered over time.
    #[error(transparent)]
    Time(#[from] TimeError),
    /// A map that cannot be written.
    #[error("{}: the map cannot be written: {error}", path.display())]
    Map {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// An emulated frame that is to be kept and cannot be written.
    #[error("{}: the emulated frame cannot be written: {error}", path.display())]
    KeptFrame {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// A region of a frame that a figure shows and that cannot be written.
    #[error("{}: the region of a frame cannot be written: {error}", path.display())]
    Region {
        /// The folder of the region.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// A picture for the report that cannot be written.
    #[error("{}: the picture for the report cannot be written: {error}", path.display())]
    Picture {
        /// The folder of the picture.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// A parameter with a value that is not possible.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// A gaze file that cannot be opened.
    #[error("{}: the gaze file cannot be read: {error}", path.display())]
    GazeFile {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// A file that is not a valid gaze trace, or a gaze trace that does not fit the frames.
    #[error("{}: {error}", path.display())]
    GazeTrace {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: GazeTraceError,
    },
    /// Frames that do not fit into memory.
    #[error(
        "frames of {}x{} pixels need at least {} of memory ({needed}), but only {} is available",
        size.0, size.1, gigabytes(needed.bytes()), gigabytes(*available)
    )]
    Memory {
        /// Width and height of the frames.
        size: (usize, usize),
        /// The memory that is in use at once.
        needed: Needed,
        /// Bytes of memory that are available.
        available: u64,
    },
    /// A mask that cannot be read.
    #[error("the mask {0}")]
    Mask(#[from] ReadError),
    /// A journal that cannot be written.
    #[error("{}: the journal cannot be written: {error}", path.display())]
    Journal {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// A journal with a line that was changed after it was written.
    #[error("{}:{line}: this line of the journal was changed or damaged", path.display())]
    JournalChanged {
        /// The file.
        path: PathBuf,
        /// Number of the line, counted from 1.
        line: usize,
    },
    /// A journal that cannot be read.
    #[error("{}: the journal cannot be read: {error}", path.display())]
    JournalRead {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
}

impl From<OpenError> for EngineError {
    fn from(error: OpenError) -> Self {
        match error {
            OpenError::Listing(error) => Self::Listing(error),
            OpenError::Source(error) => Self::Source(error),
        }
    }
}

impl EngineError {
    /// The same error with its paths as results show them.
    pub(crate) fn with_paths(self, shown: &dyn Fn(&Path) -> PathBuf) -> Self {
        match self {
            Self::Listing(error) => Self::Listing(error.with_paths(shown)),
            Self::GazeFile { path, error } => Self::GazeFile { path: shown(&path), error },
            Self::GazeTrace { path, error } => Self::GazeTrace { path: shown(&path), error },
            Self::Mask(ReadError { path, kind }) => {
                Self::Mask(ReadError { path: shown(&path), kind })
            }
            other => other,
        }
    }

    /// Whether the error is in the command line rather than in an input.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::View(_)
            | Self::Emulate(_)
            | Self::EmulatedReference
            | Self::Gallery(_)
            | Self::LooksAhead { .. }
            | Self::ReprojectsAhead { .. }
            | Self::NotGiven { .. }
            | Self::GazeCount { .. }
            | Self::NoView { .. }
            | Self::NoLuminance { .. }
            | Self::ShownWrongly { .. }
            | Self::Time(_)
            | Self::Param(_) => true,
            Self::Output(error) => error.is_usage(),
            Self::GazeTrace { error, .. } => matches!(error, GazeTraceError::NoFps),
            Self::Listing(error) => matches!(error, ListingError::Pattern { .. }),
            Self::Pairing(_)
            | Self::Source(_)
            | Self::NoFrames { .. }
            | Self::NoNumbers { .. }
            | Self::GazeFile { .. }
            | Self::Mask(_)
            | Self::Memory { .. }
            | Self::Map { .. }
            | Self::KeptFrame { .. }
            | Self::Region { .. }
            | Self::Picture { .. }
            | Self::Journal { .. }
            | Self::JournalChanged { .. }
            | Self::JournalRead { .. } => false,
        }
    }

    /// How to correct the error.
    pub fn help(&self) -> String {
        match self {
            Self::Listing(error) => error.help().to_owned(),
            Self::Source(error) => error.help.clone(),
            Self::Pairing(error) => error.help(),
            Self::NoNumbers { .. } => {
                "give a pattern that has the number, such as 'renders/f_%04d.png', or rename the files"
                    .to_owned()
            }
            Self::NotGiven { .. } => "give a source with this name together with the plan".to_owned(),
            Self::Emulate(error) => error.help().to_owned(),
            Self::Output(error) => error.help(),
            Self::Gallery(_) => "give a number in this range".to_owned(),
            Self::GazeCount { .. } => {
                "give one point for each frame of the reference, or one for all".to_owned()
            }
            Self::EmulatedReference => "give files as the reference".to_owned(),
            Self::ReprojectsAhead { .. } => {
                "leave fvvdp.temp_padding at replicate, or leave reproject out".to_owned()
            }
            Self::LooksAhead { .. } => {
                "leave fvvdp.temp_padding at replicate, or leave the temporal filter out".to_owned()
            }
            Self::NoFrames { .. } => {
                "{frames} selects by number, from A up to, but not including, B".to_owned()
            }
            Self::View(_) => {
                "angles must be between 0° and 180°, lengths and tangents above 0".to_owned()
            }
            Self::NoView { .. } => "give {view}".to_owned(),
            Self::NoLuminance { .. } => {
                "give {luminance}, or a display that has it (`fovqa list displays`)".to_owned()
            }
            Self::ShownWrongly { .. } => {
                "check that {transfer} matches the files, and give {luminance}, for a display with the same eotf"
                    .to_owned()
            }
            Self::Time(TimeError::NoFps) => "give {fps}; a single frame is scored as a still and needs no frame rate".to_owned(),
            Self::Time(TimeError::Fps { .. }) => {
                "check {fps}; skipped frames make it lower".to_owned()
            }
            Self::Map { .. } => "give another folder with {maps}, or free some space".to_owned(),
            Self::Region { .. } => "give another folder with {output}, or free some space".to_owned(),
            Self::Picture { .. } => {
                "give another folder with {output}, free some space, or write frames = [] in [report]".to_owned()
            }
            Self::KeptFrame { .. } => {
                "give another folder with {output}, free some space, or leave out keep_frames".to_owned()
            }
            Self::Param(_) => {
                "`fovqa list metrics` shows every parameter with its range".to_owned()
            }
            Self::GazeFile { .. } => "give a CSV file, or write a gaze point as {gaze}".to_owned(),
            Self::GazeTrace { error, .. } => error.help().to_owned(),
            Self::Memory { needed, .. } => {
                let fvvdp = if needed.is_of_fvvdp() {
                    "leave fvvdp out with {metrics}, or score fewer methods at once; "
                } else {
                    ""
                };
                format!("{fvvdp}score a part with {{crop}}, or use a machine with more memory")
            }
            Self::Mask(error) => error.kind.help().to_owned(),
            Self::Journal { .. } => {
                "free some space; frames in the journal are not lost, and {resume} continues with them"
                    .to_owned()
            }
            Self::JournalChanged { .. } => {
                "delete this line and all lines after it to continue from there, or leave out {resume} to score \
                 everything again"
                    .to_owned()
            }
            Self::JournalRead { .. } => "correct this, or leave out {resume}".to_owned(),
        }
    }
}

fn unlit(display: Option<&String>) -> String {
    match display {
        None => "none is given".to_owned(),
        Some(name) => format!("the photometry of {} is not known", name.replace('_', "-")),
    }
}

/// The error for metrics that need a view where there is none.
pub(crate) fn no_view(metrics: &[Metric]) -> EngineError {
    let names: Vec<_> = metrics.iter().map(|m| m.info().label).collect();
    EngineError::NoView { what: names.join(" and ") }
}
