//! Emulation of a continuous scene: the samples of a method are asked from the scene itself.

use fovqa_frame::{Motion, SignalParams};

use crate::emulator::Emulator;
use crate::error::EmulateError;
use crate::image::Image;
use crate::picture::Picture;
use crate::scene::{SceneLight, SceneSource};
use crate::space::{Space, encoded};
use crate::temporal::History;

impl Emulator {
    /// What the method shows of a scene in frame `frame`, counted from 0: every sample is asked from the
    /// scene, once, and becomes the signal by exposure, tone map and sRGB encoding as a frame of linear
    /// light does ([`Picture::from_frame`]). From there on all is as in [`Emulator::emulate_next`]. With
    /// area sampling a sample is the mean light of 16 rays, also where there is one sample per pixel.
    /// Jitter is that of `frame`.
    ///
    /// The scene is asked from several threads at once; what it answers must depend on the position
    /// alone. The buffers of nested layers are filled whole: DEAMP asks for samples that it does not
    /// count, under the layer inside.
    ///
    /// ```
    /// use fovqa_emulate::{EmulationSpec, Emulator, History, SceneLight};
    /// use fovqa_frame::SignalParams;
    ///
    /// /// Stripes that no grid of pixels could hold.
    /// struct Stripes;
    ///
    /// impl SceneLight for Stripes {
    ///     fn light(&self, x: f64, y: f64) -> [f32; 3] {
    ///         [if (7.3 * x + y).sin() > 0.0 { 0.8 } else { 0.1 }; 3]
    ///     }
    /// }
    ///
    /// let emulator = Emulator::new(&EmulationSpec::new("rmfr")?, [64, 48], None, [32.0, 24.0])?;
    /// let (signal, mut history) = (SignalParams::default(), History::default());
    /// let picture = emulator.emulate_scene(&Stripes, 0, &signal, None, &mut history)?;
    /// assert_eq!([picture.width(), picture.height()], [64, 48]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When the motion has another size.
    pub fn emulate_scene(
        &self,
        scene: &dyn SceneLight,
        frame: usize,
        signal: &SignalParams,
        motion: Option<&Motion>,
        history: &mut History,
    ) -> Result<Picture, EmulateError> {
        self.motion_fits(motion)?;
        let source = SceneSource::new(scene, signal, self.space);
        let shown = self.at_frame(frame)?.prepared.show(&source);
        Ok(self.after(history, Picture::Rgb(self.signal_of(shown)), motion))
    }

    /// The reduced buffers of a scene as pictures, as [`Emulator::buffers`] gives those of a frame.
    ///
    /// # Errors
    /// Those of [`Emulator::at_frame`].
    pub fn scene_buffers(
        &self,
        scene: &dyn SceneLight,
        frame: usize,
        signal: &SignalParams,
    ) -> Result<Vec<Picture>, EmulateError> {
        let source = SceneSource::new(scene, signal, self.space);
        let buffers = self.at_frame(frame)?.prepared.buffers(&source);
        Ok(buffers.into_iter().map(|buffer| Picture::Rgb(self.signal_of(buffer))).collect())
    }

    /// Values that a method ran on as the encoded signal.
    fn signal_of(&self, image: Image<3>) -> Image<3> {
        match self.space {
            Space::Encoded => image,
            Space::Linear => encoded(&image),
        }
    }
}
