//! Frames of a sequence, each after the one before it: jitter and the temporal filter.

use std::sync::Arc;

use fovqa_frame::{Mask, Motion};

use crate::emulator::Emulator;
use crate::error::EmulateError;
use crate::image::Image;
use crate::jitter::Jitter;
use crate::picture::Picture;
use crate::prepared::Prepared;
use crate::temporal::{History, Step, TaaParams};

impl Emulator {
    /// The same emulator for frame `frame` of a sequence, counted from 0: with jitter its samples stand
    /// elsewhere in each frame. [`Emulator::new`] prepares frame 0. Without jitter all frames are alike,
    /// and this costs next to nothing.
    ///
    /// ```
    /// use fovqa_emulate::{EmulationSpec, Emulator, History, Jitter, Picture};
    /// # use fovqa_frame::{Channels, Frame, Samples, SignalParams, SignalTables};
    /// # let frame = Frame::new(64, 48, Channels::Rgb, Samples::U8(vec![128; 64 * 48 * 3].into()))?;
    /// # let picture = Picture::from_frame(&frame, &SignalTables::new(SignalParams::default()));
    /// # let pictures = [picture.clone(), picture];
    /// let mut spec = EmulationSpec::new("rmfr")?;
    /// spec.set_jitter(Jitter::Halton);
    /// spec.set_temporal(true);
    /// let emulator = Emulator::new(&spec, [64, 48], None, [32.0, 24.0])?;
    /// let mut history = History::default();
    /// for (frame, picture) in pictures.iter().enumerate() {
    ///     emulator.at_frame(frame)?.emulate_next(picture, None, &mut history)?;
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Emulator::new`], which do not occur after it.
    pub fn at_frame(&self, frame: usize) -> Result<Self, EmulateError> {
        let mut emulator = self.clone();
        let jitter = self.solved.jitter;
        if jitter != Jitter::None {
            let prepared = Prepared::new(&self.solved, &self.setting, jitter.within_cell(frame))?;
            emulator.prepared = Arc::new(prepared);
        }
        Ok(emulator)
    }

    /// Where the samples of frame `frame`, counted from 0, stand: positions in pixels from the top-left
    /// corner, some of them off the frame. Buffer by buffer, the innermost first, row by row; column by
    /// column in polar buffers. An area sample stands where a point sample would. Methods without a
    /// buffer list the samples in use (coarse pixel shading), or those of all grids.
    ///
    /// # Errors
    /// Those of [`Self::at_frame`].
    pub fn sample_positions(&self, frame: usize) -> Result<Vec<[f64; 2]>, EmulateError> {
        Ok(self.at_frame(frame)?.prepared.positions())
    }

    /// How many of the samples of frame `frame`, counted from 0, stand on the pixels of `mask`: of the
    /// samples within the method's own field and beyond it. Methods whose samples have no positions of
    /// their own (`linear`, `cps` with a continuous rate) share them out by their density.
    ///
    /// # Errors
    /// When the mask has another size, and those of [`Self::at_frame`].
    pub fn samples_on(&self, frame: usize, mask: &Mask) -> Result<f64, EmulateError> {
        self.fits("a mask", [mask.width(), mask.height()])?;
        Ok(self.at_frame(frame)?.prepared.samples_on(mask))
    }

    /// [`Emulator::emulate`] for the next picture of a sequence: with the temporal filter, where it is
    /// on. `motion` leads to the frame before; without it, pixels stay where they are. The emulators of a
    /// sequence, one for each gaze, pass the same history on; the first frame passes through. With jitter
    /// each frame has an emulator of its own ([`Self::at_frame`]).
    ///
    /// # Errors
    /// When the picture or the motion has another size.
    pub fn emulate_next(
        &self,
        picture: &Picture,
        motion: Option<&Motion>,
        history: &mut History,
    ) -> Result<Picture, EmulateError> {
        self.fits("a picture", [picture.width(), picture.height()])?;
        self.motion_fits(motion)?;
        Ok(self.after(history, self.method_picture(picture), motion))
    }

    /// Checks the motion of a frame; without temporal filter it does not matter.
    pub(crate) fn motion_fits(&self, motion: Option<&Motion>) -> Result<(), EmulateError> {
        match motion {
            Some(motion) if self.temporal.is_some() => {
                self.fits("motion", [motion.width(), motion.height()])
            }
            _ => Ok(()),
        }
    }

    /// What is shown of a method's picture, `current`, after the frames before it.
    pub(crate) fn after(
        &self,
        history: &mut History,
        current: Picture,
        motion: Option<&Motion>,
    ) -> Picture {
        let Some(params) = &self.temporal else {
            return self.enhanced(&current).unwrap_or(current);
        };
        let last = history.last.take();
        let last_rates = std::mem::replace(&mut history.rates, self.rates.clone());
        let rates = [self.rates.as_deref(), last_rates.as_deref()];
        let filtered = match (current, last) {
            (Picture::Gray(current), Some(Picture::Gray(last))) => {
                Picture::Gray(filter(params, current, &last, motion, rates))
            }
            (Picture::Rgb(current), Some(Picture::Rgb(last))) => {
                Picture::Rgb(filter(params, current, &last, motion, rates))
            }
            (current, _) => current,
        };
        let shown = self.enhanced(&filtered).unwrap_or_else(|| filtered.clone());
        history.last = Some(filtered);
        shown
    }
}

/// A step of the temporal filter; after frames of another size the first one passes through.
fn filter<const C: usize>(
    params: &TaaParams,
    current: Image<C>,
    last: &Image<C>,
    motion: Option<&Motion>,
    [rates, last_rates]: [Option<&Image<1>>; 2],
) -> Image<C> {
    if [last.width(), last.height()] != [current.width(), current.height()] {
        return current;
    }
    Step { current: &current, last, motion, rates, last_rates }.filter(params)
}
