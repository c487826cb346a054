//! A built-in sequence for one eye: its frames as functions of position, and as pictures.

use fovqa_frame::{BLOCK_ROWS, Channels, Frame, Guides, Motion, Plane, PlaneSamples, Samples};
use fovqa_vision::View;
use rayon::prelude::*;

use crate::camera::Pose;
use crate::frame_scene::FrameScene;
use crate::gaze::GazeCourse;
use crate::path::head;
use crate::scene::{Prepared, SceneName};
use crate::spec::{BuiltinSpec, GalleryError, check_size};

/// A built-in sequence for one eye.
#[derive(Debug)]
pub struct Builtin {
    spec: BuiltinSpec,
    view: View,
    eye_m: f64,
    scene: Prepared,
    gaze: GazeCourse,
}

/// The pose of a camera: its position in metres and its axes, in a world with x to the right, y up and
/// z forward.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct CameraPose {
    /// The position in metres.
    pub position_m: [f64; 3],
    /// To the right of the frame.
    pub right: [f64; 3],
    /// Down the frame.
    pub down: [f64; 3],
    /// Into the frame.
    pub forward: [f64; 3],
}

/// Distance at which both eyes meet, in metres.
const VERGENCE_M: f64 = 3.0;

impl Builtin {
    /// Prepares a sequence as an eye sees it that is `eye_m` metres to the right of the middle between
    /// both eyes.
    ///
    /// # Errors
    /// If a number of the spec or the size of the view is out of range.
    pub fn new(spec: &BuiltinSpec, view: View, eye_m: f64) -> Result<Self, GalleryError> {
        spec.check()?;
        check_size(&view)?;
        let scene = Prepared::new(spec.scene, view, spec.fps, eye_m, spec.seed);
        let gaze = GazeCourse::new(spec.seed, spec.frames as f64 / spec.fps);
        Ok(Self { spec: spec.clone(), view, eye_m, scene, gaze })
    }

    /// What the sequence is made of.
    pub fn spec(&self) -> &BuiltinSpec {
        &self.spec
    }

    /// The view.
    pub fn view(&self) -> View {
        self.view
    }

    /// A frame as a function of position.
    pub fn frame(&self, frame: usize) -> Box<dyn FrameScene + '_> {
        self.scene.frame(frame)
    }

    /// The gaze of a frame in pixels. Patterns and the chart are looked at in their centre.
    pub fn gaze_px(&self, frame: usize) -> [f64; 2] {
        let View { focal_px, principal_px, .. } = self.view;
        if self.spec.scene != SceneName::Gallery {
            return principal_px;
        }
        let [right, down] = self.gaze.at(frame as f64 / self.spec.fps);
        let tan = |degrees: f64| libm::tan(degrees.to_radians());
        // The eyes converge: each sees the target on its own side.
        let x = tan(right) - self.eye_m / VERGENCE_M;
        [principal_px[0] + focal_px[0] * x, principal_px[1] + focal_px[1] * tan(down)]
    }

    /// The pose of the camera of a frame; `None` for flat patterns.
    pub fn pose(&self, frame: usize) -> Option<CameraPose> {
        if self.spec.scene != SceneName::Gallery {
            return None;
        }
        let Pose { position, right, down, forward } =
            head(frame as f64 / self.spec.fps).moved(self.eye_m);
        let [position_m, right, down, forward] =
            [position, right, down, forward].map(|v| [v.x, v.y, v.z]);
        Some(CameraPose { position_m, right, down, forward })
    }

    /// The ground truth of a frame: the mean of its samples in each pixel, in linear light.
    pub fn ground_truth(&self, frame: usize) -> Frame {
        self.ground_truth_watched(frame, &|| {})
    }

    /// The same as [`Builtin::ground_truth`]. `begin` is called before each row, by any thread. If it
    /// panics, the drawing ends.
    pub fn ground_truth_watched(&self, frame: usize, begin: &(dyn Fn() + Sync)) -> Frame {
        let View { width, height, .. } = self.view;
        let scene = self.frame(frame);
        let offsets = offsets(self.spec.samples);
        let mut pixels = vec![[0.0f32; 3]; width * height];
        pixels.par_chunks_mut(BLOCK_ROWS * width).enumerate().for_each(|(block, pixels)| {
            for (index, pixel) in pixels.iter_mut().enumerate() {
                if index % width == 0 {
                    begin();
                }
                let (x, y) = (index % width, block * BLOCK_ROWS + index / width);
                let mut sum = [0.0f64; 3];
                for [dx, dy] in &offsets {
                    let light = scene.light(x as f64 + dx, y as f64 + dy);
                    for (sum, value) in sum.iter_mut().zip(light) {
                        *sum += f64::from(value);
                    }
                }
                *pixel = sum.map(|sum| (sum / offsets.len() as f64) as f32);
            }
        });
        let planes = (0..3).flat_map(|c| pixels.iter().map(move |pixel| pixel[c])).collect();
        let frame = Frame::new(width, height, Channels::Rgb, Samples::F32(planes));
        frame.unwrap_or_else(|error| unreachable!("three values for each pixel: {error}"))
    }

    /// Motion and depth of a frame at the centres of its pixels. Where a point was behind the eye, the
    /// motion is NaN. The first frame has a motion as well: that of a frame before it.
    pub fn guides(&self, frame: usize) -> Guides {
        let View { width, height, .. } = self.view;
        let scene = self.frame(frame);
        let mut values = vec![[0.0f32; 3]; width * height];
        values.par_chunks_mut(BLOCK_ROWS * width).enumerate().for_each(|(block, values)| {
            for (index, value) in values.iter_mut().enumerate() {
                let (x, y) = (index % width, block * BLOCK_ROWS + index / width);
                let surface = scene.surface(x as f64 + 0.5, y as f64 + 0.5);
                let [dx, dy] = surface.motion_px.unwrap_or([f64::NAN; 2]);
                *value = [dx as f32, dy as f32, surface.depth_m as f32];
            }
        });
        let plane = |c: usize| {
            let samples = PlaneSamples::F32(values.iter().map(|value| value[c]).collect());
            let plane = Plane::new(width, height, samples);
            plane.unwrap_or_else(|error| unreachable!("a value for each pixel: {error}"))
        };
        Guides { motion: Motion::new(plane(0), plane(1), [1.0; 2]), depth: Some(plane(2)) }
    }
}

/// Where the samples of a pixel stand, from 0 to 1 along both axes: a lattice, which spreads any number
/// of samples evenly.
fn offsets(samples: usize) -> Vec<[f64; 2]> {
    /// 1 over the golden ratio.
    const STEP: f64 = 0.618_033_988_749_894_9;
    let offset = |i: usize| {
        let across = (i as f64 + 0.5) * STEP;
        [across - across.floor(), (i as f64 + 0.5) / samples as f64]
    };
    (0..samples).map(offset).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(width: usize, height: usize) -> View {
        let focal = height as f64 / 2.0;
        let principal_px = [width as f64 / 2.0, height as f64 / 2.0];
        View { width, height, focal_px: [focal; 2], principal_px }
    }

    fn psnr(a: &Frame, b: &Frame) -> f64 {
        let (Samples::F32(a), Samples::F32(b)) = (a.samples(), b.samples()) else {
            panic!("floats")
        };
        let code =
            |value: f32| fovqa_frame::transfer::srgb::encode(f64::from(value.clamp(0.0, 1.0)));
        let square = |(a, b): (&f32, &f32)| (code(*a) - code(*b)) * (code(*a) - code(*b));
        let mse = a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64;
        -10.0 * mse.log10()
    }

    #[test]
    fn more_samples_converge() {
        let frame = |samples| {
            let spec = BuiltinSpec { samples, ..BuiltinSpec::new(SceneName::Gallery) };
            Builtin::new(&spec, view(180, 200), 0.0).unwrap().ground_truth(7)
        };
        let (some, more, most) = (frame(16), frame(64), frame(256));
        assert!(psnr(&more, &most) > 40.0, "{}", psnr(&more, &most));
        assert!(psnr(&some, &most) < psnr(&more, &most));
    }

    #[test]
    fn every_scene_has_frames_gaze_and_guides() {
        for scene in <SceneName as fovqa_params::Words>::all() {
            let spec = BuiltinSpec { frames: 3, samples: 2, ..BuiltinSpec::new(scene) };
            let builtin = Builtin::new(&spec, view(48, 40), 0.03).unwrap();
            let (frame, guides) = (builtin.ground_truth(2), builtin.guides(2));
            assert_eq!((frame.width(), frame.height()), (48, 40));
            assert!(frame.bad_pixel().is_none());
            let motion = guides.motion.unwrap();
            assert!(motion.at(20, 20).iter().all(|value| value.is_finite()));
            assert!(guides.depth.unwrap().at(20, 20) > 0.0);
            let [x, y] = builtin.gaze_px(2);
            assert!((0.0..48.0).contains(&x) && (0.0..40.0).contains(&y));
            assert_eq!(builtin.pose(2).is_some(), scene == SceneName::Gallery);
        }
    }

    #[test]
    fn impossible_numbers_are_refused() {
        let spec = BuiltinSpec::new(SceneName::Gallery);
        let wrong = [
            BuiltinSpec { frames: 0, ..spec.clone() },
            BuiltinSpec { samples: 1_000_000, ..spec.clone() },
            BuiltinSpec { fps: f64::NAN, ..spec.clone() },
        ];
        for spec in wrong {
            assert!(Builtin::new(&spec, view(48, 40), 0.0).is_err());
        }
        assert!(Builtin::new(&spec, view(40_000, 40), 0.0).is_err());
    }
}
