//! How frames are read and viewed.

use std::path::PathBuf;

use fovqa_frame::{Crop, SignalParams, Transfer};
use fovqa_io::{GuideOptions, ReadOptions};
use fovqa_params::words;
use fovqa_plausibility::Plausibility;
use fovqa_vision::{BandEdges, EccentricityKind, Eotf, Luminance, ViewSpec};
use serde::{Deserialize, Serialize};

/// Where the eye looks.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Gaze {
    /// The gaze is at the principal point.
    #[default]
    Centre,
    /// The gaze is at a point in pixels.
    Point([f64; 2]),
    /// The gaze is that of the viewer of a built-in scene.
    Builtin,
    /// The gaze of each frame of the reference is at a point in pixels. For programs, which have the gaze
    /// in memory.
    Each(Vec<[f64; 2]>),
    /// The gaze follows a trace.
    Trace {
        /// The CSV file.
        path: PathBuf,
        /// Whether frames after the end of the trace keep its last gaze.
        hold: bool,
    },
}

words! {
    /// What to do about NaN and infinity.
    #[derive(Default)]
    pub enum Nonfinite {
        /// An error that names the first.
        #[default]
        Error "error" "An error that names the first such pixel";
        /// Leave the pixels out, in both pictures.
        Mask "mask" "Such pixels are left out of every number";
    }
}

/// How frames are read and viewed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Settings {
    /// How files are read.
    pub read: ReadOptions,
    /// The visible part of each frame.
    pub crop: Option<Crop>,
    /// An image that is white where pixels count.
    pub mask: Option<PathBuf>,
    /// Instead of a file, the name of a source that the program gives. Its first frame is the mask.
    #[serde(default)]
    pub given_mask: Option<String>,
    /// How samples become the signal.
    pub signal: SignalParams,
    /// What to do about NaN and infinity.
    pub nonfinite: Nonfinite,
    /// What to do about pairs that cannot be what the user wants to compare.
    pub plausibility: Plausibility,
    /// The view.
    pub view: Option<ViewSpec>,
    /// The photometry of the display, if it differs from that of the view's preset.
    pub luminance: Option<Luminance>,
    /// The gaze.
    pub gaze: Gaze,
    /// How eccentricity is measured.
    pub eccentricity: EccentricityKind,
    /// The bands; `None` for the default bands.
    pub bands: Option<BandEdges>,
    /// The channels that contain motion and depth, for temporal metrics. Those in `read` are
    /// ignored.
    pub guides: GuideOptions,
    /// Separate files that contain the motion: file, folder, glob or printf pattern.
    pub motion_files: Option<PathBuf>,
    /// Separate files that contain the depth: file, folder, glob or printf pattern.
    pub depth_files: Option<PathBuf>,
}

impl Settings {
    /// The first setting that needs a view although there is none.
    pub fn lacks_view(&self) -> Option<&'static str> {
        match self.gaze {
            _ if self.view.is_some() => None,
            _ if self.bands.is_some() => Some("eccentricity bands"),
            Gaze::Point(_) | Gaze::Each(_) | Gaze::Trace { .. } => Some("a gaze"),
            Gaze::Centre | Gaze::Builtin => None,
        }
    }

    /// The photometry of the display: its own or, if there is none, that of the view's preset.
    pub fn photometry(&self) -> Option<Luminance> {
        self.luminance.or(match &self.view {
            Some(ViewSpec::Display(display)) => display.luminance,
            _ => None,
        })
    }

    /// Why a display cannot show the files with their stated encoding; `None` if it can.
    pub fn shown_wrongly(&self) -> Option<String> {
        let eotf = self.photometry()?.eotf;
        let files = match self.signal.transfer? {
            Transfer::Pq if eotf != Eotf::Pq => "PQ",
            Transfer::Srgb if !eotf.is_relative() => "sRGB",
            Transfer::Gamma22 if !eotf.is_relative() => "a power of 2.2",
            _ => return None,
        };
        let display = match eotf {
            Eotf::Srgb => "sRGB",
            Eotf::Gamma => "a power of its own",
            Eotf::Pq => "PQ",
            Eotf::Linear | Eotf::Absolute => "luminance in cd/m²",
        };
        Some(format!("the files are encoded as {files}, but the display expects {display}"))
    }
}
