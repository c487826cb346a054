//! `--right-reference`, `--right-test`, `--right-layer`, `--right-crop`, `--right-gaze`, `--right-frustum`,
//! `--right-mask`: what the right eye sees, if it differs from the left one.

use std::path::{Path, PathBuf};

use clap::Args;
use fovqa_frame::Crop;
use fovqa_plan::{Eye, EyeView, Settings, SourceSpec};
use fovqa_vision::ViewSpec;

use super::values::{crop, numbers};
use super::view::{GazeArg, gaze};

#[derive(Debug, Args)]
#[command(next_help_heading = "Right eye")]
pub(crate) struct RightEyeArgs {
    /// Reference frames of the right eye. REFERENCE, TEST and all other options are then those of the
    /// left eye, and of the right one unless an option below says otherwise. The left eye, the right eye
    /// and both are reported
    #[arg(long, value_name = "PATH", requires = "right_test")]
    right_reference: Option<PathBuf>,
    /// Test frames of the right eye
    #[arg(long, value_name = "PATH", requires = "right_reference")]
    right_test: Option<PathBuf>,
    /// Colour layer of the right eye, such as that of OpenEXR files with both eyes
    #[arg(long, value_name = "NAME")]
    right_layer: Option<String>,
    /// Rectangle of the right eye, such as that in a side-by-side picture
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    right_crop: Option<Crop>,
    /// Gaze of the right eye, in the forms of --gaze
    #[arg(long, value_name = "X,Y|FILE.csv", allow_hyphen_values = true, value_parser = gaze)]
    right_gaze: Option<GazeArg>,
    /// Asymmetric frustum of the right eye, in the form of --frustum
    #[arg(long, value_name = "L,R,U,D", allow_hyphen_values = true, value_parser = |t: &str| numbers::<4>(t, "four tangents, L,R,U,D"))]
    right_frustum: Option<[f64; 4]>,
    /// Mask image of the right eye
    #[arg(long, value_name = "FILE")]
    right_mask: Option<PathBuf>,
}

impl RightEyeArgs {
    /// Whether there is a right eye: it has frames of its own, or a part of the same ones.
    fn has_frames(&self) -> bool {
        self.right_reference.is_some() || self.right_layer.is_some() || self.right_crop.is_some()
    }

    fn is_given(&self) -> bool {
        self.has_frames()
            || self.right_gaze.is_some()
            || self.right_frustum.is_some()
            || self.right_mask.is_some()
    }

    /// The views of both eyes, if there is a right one; otherwise the only view. The error is a wrong
    /// command line.
    pub(crate) fn with_left(self, left: EyeView, gaze_hold: bool) -> Result<Vec<EyeView>, String> {
        if !self.is_given() {
            return Ok(vec![left]);
        }
        if !self.has_frames() {
            return Err("the frames of the right eye are missing: give --right-reference and \
                        --right-test, or --right-crop or --right-layer for its part of the same files"
                .to_owned());
        }
        if left.settings.motion_files.is_some() || left.settings.depth_files.is_some() {
            return Err(
                "--motion-files and --depth-files are those of one eye; an experiment names \
                        files for each eye"
                    .to_owned(),
            );
        }
        let mut right = EyeView { eye: Some(Eye::Right), ..left.clone() };
        if let Some((reference, test)) = self.right_reference.zip(self.right_test) {
            right.reference = reference.into();
            right.tests = vec![(0, test.into())];
        }
        if let Some(layer) = self.right_layer {
            right.settings.read.layer = Some(layer);
            right.test_layers.clear();
        }
        let Settings { crop, gaze, view, mask, .. } = &mut right.settings;
        *crop = self.right_crop.or(*crop);
        if let Some(of_right) = self.right_gaze {
            *gaze = of_right.gaze(gaze_hold);
        }
        if let Some([left, right, up, down]) = self.right_frustum {
            *view = Some(ViewSpec::Frustum { left, right, up, down });
        }
        *mask = self.right_mask.or(mask.take());
        let left = EyeView { eye: Some(Eye::Left), ..left };
        let is_stdin = |eye: &EyeView| {
            let sources = eye.tests.iter().map(|(_, test)| test).chain([&eye.reference]);
            sources
                .into_iter()
                .any(|source| matches!(source, SourceSpec::Files(path) if path == Path::new("-")))
        };
        if is_stdin(&left) || is_stdin(&right) {
            return Err("two eyes cannot be read from standard input (-)".to_owned());
        }
        Ok(vec![left, right])
    }
}
