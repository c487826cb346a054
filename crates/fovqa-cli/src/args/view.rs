//! `--fov-…`, `--frustum`, `--display`, `--luminance`, `--gaze`, `--eccentricity`, `--bands`.

use std::path::PathBuf;

use clap::Args;
use fovqa_params::Words;
use fovqa_plan::Gaze;
use fovqa_vision::{BandEdges, EccentricityKind, Luminance, ViewSpec};

use super::display::display;
use super::luminance::luminance;
use super::offered::{self, offering};
use super::values::{finite, numbers, words};

/// The ways to give a view.
#[derive(Debug, Args)]
#[command(next_help_heading = "View")]
pub(crate) struct ViewSpecArgs {
    /// Vertical field of view, degrees; without --fov-horizontal, pixels are square
    #[arg(long, value_name = "DEG", value_parser = finite, allow_negative_numbers = true)]
    fov_vertical: Option<f64>,
    /// Horizontal field of view, degrees; without --fov-vertical, pixels are square
    #[arg(long, value_name = "DEG", value_parser = finite, allow_negative_numbers = true)]
    fov_horizontal: Option<f64>,
    /// Diagonal field of view, degrees
    #[arg(long, value_name = "DEG", value_parser = finite, allow_negative_numbers = true)]
    fov_diagonal: Option<f64>,
    /// Asymmetric frustum: tangents of the half angles, left, right, up, down
    #[arg(long, value_name = "L,R,U,D", allow_hyphen_values = true, value_parser = |t: &str| numbers::<4>(t, "four tangents, L,R,U,D"))]
    frustum: Option<[f64; 4]>,
    /// A display preset; `fovqa list displays` shows them
    #[arg(long, value_name = "NAME", value_parser = offering(display, offered::display_names), hide_possible_values = true)]
    display: Option<fovqa_vision::Display>,
    /// Distance of the eye from a flat screen, metres; with --pixel-pitch-mm
    #[arg(long, value_name = "D", value_parser = finite, requires = "pixel_pitch_mm")]
    distance_m: Option<f64>,
    /// Size of a pixel of a flat screen, millimetres; with --distance-m
    #[arg(long, value_name = "P", value_parser = finite, requires = "distance_m")]
    pixel_pitch_mm: Option<f64>,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "View")]
pub(crate) struct ViewArgs {
    #[command(flatten)]
    spec: ViewSpecArgs,
    /// Photometry of the display, for FovVideoVDP and PU-PSNR: the name of a preset (htc-vive-pro), or
    /// values such as peak_cd_m2=100,contrast=1000; further keys are min_cd_m2, ambient_lux,
    /// reflectivity, eotf and gamma [default: that of --display]
    #[arg(long, value_name = "NAME|KEY=N,…", value_parser = offering(luminance, offered::luminances), hide_possible_values = true)]
    luminance: Option<Luminance>,
    #[command(flatten)]
    gaze: GazeArgs,
    /// How eccentricity is measured
    #[arg(long, value_name = "KIND", default_value = EccentricityKind::default().word(), value_parser = words::<EccentricityKind>())]
    eccentricity: EccentricityKind,
    /// Edges of the eccentricity bands, degrees [default: 0,5,10,… up to the largest
    /// eccentricity of the frames]
    #[arg(long, value_name = "DEG,DEG,…", value_parser = bands)]
    bands: Option<BandEdges>,
}

/// The gaze.
#[derive(Debug, Args)]
#[command(next_help_heading = "View")]
pub(crate) struct GazeArgs {
    /// Gaze in pixels from the top-left corner, or a CSV trace with columns frame,x_px,y_px (or
    /// time_s with --fps) [default: the principal point]
    #[arg(long, value_name = "X,Y|FILE.csv", allow_hyphen_values = true, value_parser = gaze)]
    gaze: Option<GazeArg>,
    /// Keep the last gaze in frames that the gaze trace does not cover
    #[arg(long, requires = "gaze")]
    gaze_hold: bool,
}

impl GazeArgs {
    /// Whether the user has said where the eye looks.
    pub(crate) fn is_given(&self) -> bool {
        self.gaze.is_some()
    }

    pub(crate) fn gaze(&self) -> Gaze {
        match &self.gaze {
            None => Gaze::Centre,
            Some(gaze) => gaze.gaze(self.gaze_hold),
        }
    }
}

/// A gaze as the user wrote it.
#[derive(Debug, Clone)]
pub(super) enum GazeArg {
    Point([f64; 2]),
    File(PathBuf),
}

impl GazeArg {
    /// The gaze. `hold` says whether frames that a trace does not cover keep its last gaze.
    pub(super) fn gaze(&self, hold: bool) -> Gaze {
        match self {
            Self::Point(px) => Gaze::Point(*px),
            Self::File(path) => Gaze::Trace { path: path.clone(), hold },
        }
    }
}

/// The message for a gaze that is far outside any frame.
pub(super) const FAR: &str = "the gaze must be within a million pixels of the frame";

/// Whether a gaze is not far outside any frame.
pub(super) fn near(point: [f64; 2]) -> bool {
    const FARTHEST_PX: f64 = 1e6;
    point.iter().all(|v| v.abs() <= FARTHEST_PX)
}

pub(super) fn gaze(text: &str) -> Result<GazeArg, String> {
    if let Ok(point) = numbers::<2>(text, "") {
        return if near(point) { Ok(GazeArg::Point(point)) } else { Err(FAR.to_owned()) };
    }
    // Numbers that do not form a point are a mistake, not a file name.
    if text.split(',').all(|part| part.trim().parse::<f64>().is_ok()) {
        return Err("write X,Y in pixels, or the path of a CSV file".to_owned());
    }
    Ok(GazeArg::File(PathBuf::from(text)))
}

fn bands(text: &str) -> Result<BandEdges, String> {
    let edges: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let edges =
        edges.map_err(|_| "write degrees separated by commas, such as 0,5,10,20".to_owned())?;
    BandEdges::new(edges).map_err(|error| error.to_string())
}

impl ViewSpecArgs {
    /// The view, if one is given; more than one is an error.
    pub(crate) fn spec(&self) -> Result<Option<ViewSpec>, String> {
        let fov = (self.fov_horizontal.is_some() || self.fov_vertical.is_some()).then_some(
            ViewSpec::Fov { horizontal_deg: self.fov_horizontal, vertical_deg: self.fov_vertical },
        );
        let diagonal = self.fov_diagonal.map(|diagonal_deg| ViewSpec::FovDiagonal { diagonal_deg });
        let frustum =
            self.frustum.map(|[left, right, up, down]| ViewSpec::Frustum { left, right, up, down });
        let pitch = self
            .distance_m
            .zip(self.pixel_pitch_mm)
            .map(|(distance_m, pitch_mm)| ViewSpec::PixelPitch { distance_m, pitch_mm });
        let display = self.display.clone().map(ViewSpec::Display);
        let mut given = [fov, diagonal, frustum, pitch, display].into_iter().flatten();
        let first = given.next();
        if given.next().is_some() {
            return Err("the view is given in more than one way".to_owned());
        }
        Ok(first)
    }
}

impl ViewArgs {
    /// The view, if one is given; more than one is an error.
    pub(crate) fn spec(&self) -> Result<Option<ViewSpec>, String> {
        self.spec.spec()
    }

    pub(crate) fn gaze(&self) -> Gaze {
        self.gaze.gaze()
    }

    pub(crate) fn gaze_hold(&self) -> bool {
        self.gaze.gaze_hold
    }

    pub(crate) fn luminance(&self) -> Option<Luminance> {
        self.luminance
    }

    pub(crate) fn bands(&self) -> Option<BandEdges> {
        self.bands.clone()
    }

    pub(crate) fn eccentricity(&self) -> EccentricityKind {
        self.eccentricity
    }
}
