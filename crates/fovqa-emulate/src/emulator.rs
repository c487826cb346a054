//! An emulation, prepared once for a frame size, a view and a gaze, and applied to any number of frames.

use std::sync::Arc;

use fovqa_frame::{Frame, Motion, SignalTables};
use fovqa_methods::cps::Cps;
use fovqa_methods::{Method, Setting};
use fovqa_vision::View;

use crate::budget::BudgetReport;
use crate::codes::Codes;
use crate::counts::Counts;
use crate::enhance::Enhancer;
use crate::error::EmulateError;
use crate::image::Image;
use crate::method::Emulated;
use crate::offsets::Offsets;
use crate::picture::Picture;
use crate::prepared::Prepared;
use crate::radial::{Detail, Radial};
use crate::space::{Space, decoded, encoded};
use crate::spec::EmulationSpec;
use crate::temporal::{History, Step, TaaParams};

/// An emulation of frames of one size at one gaze. Everything that depends on these alone is computed
/// here, once.
#[derive(Debug)]
pub struct Emulator {
    size: [usize; 2],
    prepared: Prepared,
    counts: Counts,
    space: Space,
    temporal: Option<TaaParams>,
    /// S of each pixel; `None`: 0.
    rates: Option<Arc<Image<1>>>,
    enhancers: Vec<Enhancer>,
    budget: Option<BudgetReport>,
    solved: EmulationSpec,
}

impl Emulator {
    /// Prepares an emulation of frames of `size`, width and height in pixels, with the gaze in pixels
    /// from the top-left corner; a gaze outside of the frame is taken to its edge.
    ///
    /// # Errors
    /// When the view is missing or of another size, the method cannot be applied, or a budget cannot be
    /// had.
    pub fn new(
        spec: &EmulationSpec,
        size: [usize; 2],
        view: Option<&View>,
        gaze_px: [f64; 2],
    ) -> Result<Self, EmulateError> {
        let setting = setting(spec, size, view, gaze_px)?;
        let (solved, solution) = spec.solved(&setting)?;
        let prepared = Prepared::new(&solved, &setting)?;
        let counts = prepared.counts();
        let budget = solution.map(|solution| solution.report(&counts, &setting));
        Ok(Self {
            size,
            space: solved.space,
            temporal: solved.temporal.then_some(solved.taa),
            rates: solved.temporal.then(|| rates(&solved, &setting)).flatten(),
            enhancers: enhancers(&solved, &setting),
            prepared,
            counts,
            budget,
            solved,
        })
    }

    /// Checks an emulation without preparing it: cheap enough to be done for every method before any
    /// frame is read.
    ///
    /// # Errors
    /// See [`Self::new`].
    pub fn check(
        spec: &EmulationSpec,
        size: [usize; 2],
        view: Option<&View>,
        gaze_px: [f64; 2],
    ) -> Result<(), EmulateError> {
        let setting = setting(spec, size, view, gaze_px)?;
        if let Emulated::Foveation(method) = &spec.solved(&setting)?.0.method {
            method.apply(&setting)?;
        }
        Ok(())
    }

    /// How many samples each frame stands for.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// The budget that was asked for, and what became of it.
    pub fn budget(&self) -> Option<&BudgetReport> {
        self.budget.as_ref()
    }

    /// The spec with a budget's parameter solved.
    pub fn spec(&self) -> &EmulationSpec {
        &self.solved
    }

    /// What the method would have shown of a frame that stands alone: without the temporal filter.
    ///
    /// # Errors
    /// When the picture has another size.
    pub fn emulate(&self, picture: &Picture) -> Result<Picture, EmulateError> {
        self.fits("a picture", [picture.width(), picture.height()])?;
        Ok(match picture {
            Picture::Gray(image) => Picture::Gray(self.enhanced(self.method(image))),
            Picture::Rgb(image) => Picture::Rgb(self.enhanced(self.method(image))),
        })
    }

    /// The same for a frame, in codes of 8 bits. The result is that of [`Picture::from_frame`],
    /// [`Emulator::emulate`] and [`Picture::to_codes8`] to the last bit, and takes much less time where the
    /// frame's own samples are codes of 8 bits.
    ///
    /// # Errors
    /// When the frame has another size.
    pub fn emulate_codes8(
        &self,
        frame: &Frame,
        tables: &SignalTables,
    ) -> Result<Frame, EmulateError> {
        self.fits("a frame", [frame.width(), frame.height()])?;
        if self.space == Space::Encoded && self.enhancers.is_empty() {
            if let Some(codes) = Codes::<3>::of(frame, tables) {
                return Ok(self.prepared.show::<3, u8>(&codes).into_frame());
            }
            if let Some(codes) = Codes::<1>::of(frame, tables) {
                return Ok(self.prepared.show::<1, u8>(&codes).into_frame());
            }
        }
        Ok(self.emulate(&Picture::from_frame(frame, tables))?.to_codes8())
    }

    /// The same for the next picture of a sequence: with the temporal filter, where it is on. `motion`
    /// leads to the frame before; without it, pixels stay where they are. The emulators of a sequence,
    /// one for each gaze, pass the same history on; the first frame passes through.
    ///
    /// # Errors
    /// When the picture or the motion has another size.
    pub fn emulate_next(
        &self,
        picture: &Picture,
        motion: Option<&Motion>,
        history: &mut History,
    ) -> Result<Picture, EmulateError> {
        let Some(params) = &self.temporal else { return self.emulate(picture) };
        self.fits("a picture", [picture.width(), picture.height()])?;
        if let Some(motion) = motion {
            self.fits("motion", [motion.width(), motion.height()])?;
        }
        let last = history.last.take();
        let last_rates = std::mem::replace(&mut history.rates, self.rates.clone());
        let rates = [self.rates.as_deref(), last_rates.as_deref()];
        let (filtered, shown) = match (picture, last) {
            (Picture::Gray(image), last) => {
                let last = last.and_then(|last| match last {
                    Picture::Gray(last) => Some(last),
                    Picture::Rgb(_) => None,
                });
                let filtered = filter(params, self.method(image), last, motion, rates);
                let shown = self.enhanced_of(&filtered).map(Picture::Gray);
                (Picture::Gray(filtered), shown)
            }
            (Picture::Rgb(image), last) => {
                let last = last.and_then(|last| match last {
                    Picture::Rgb(last) => Some(last),
                    Picture::Gray(_) => None,
                });
                let filtered = filter(params, self.method(image), last, motion, rates);
                let shown = self.enhanced_of(&filtered).map(Picture::Rgb);
                (Picture::Rgb(filtered), shown)
            }
        };
        let shown = shown.unwrap_or_else(|| filtered.clone());
        history.last = Some(filtered);
        Ok(shown)
    }

    /// The reduced buffers of a frame as pictures, the innermost first, with the buffer's own filter where
    /// that is on; none for methods without. Of a buffer whose columns differ in length each begins at
    /// the top, and black follows.
    ///
    /// # Errors
    /// When the picture has another size.
    pub fn buffers(&self, picture: &Picture) -> Result<Vec<Picture>, EmulateError> {
        self.fits("a picture", [picture.width(), picture.height()])?;
        Ok(match picture {
            Picture::Gray(image) => self.buffers_of(image).into_iter().map(Picture::Gray).collect(),
            Picture::Rgb(image) => self.buffers_of(image).into_iter().map(Picture::Rgb).collect(),
        })
    }

    fn fits(&self, what: &'static str, found: [usize; 2]) -> Result<(), EmulateError> {
        let expected = self.size;
        if found == expected { Ok(()) } else { Err(EmulateError::Size { what, found, expected }) }
    }

    fn method<const C: usize>(&self, image: &Image<C>) -> Image<C> {
        match self.space {
            Space::Encoded => self.prepared.show(image),
            Space::Linear => encoded(&self.prepared.show(&decoded(image))),
        }
    }

    fn buffers_of<const C: usize>(&self, image: &Image<C>) -> Vec<Image<C>> {
        match self.space {
            Space::Encoded => self.prepared.buffers(image),
            Space::Linear => self.prepared.buffers(&decoded(image)).iter().map(encoded).collect(),
        }
    }

    fn enhanced<const C: usize>(&self, image: Image<C>) -> Image<C> {
        self.enhancers.iter().fold(image, |image, enhancer| enhancer.apply(&image))
    }

    /// `None` where there is nothing to do.
    fn enhanced_of<const C: usize>(&self, image: &Image<C>) -> Option<Image<C>> {
        let (first, others) = self.enhancers.split_first()?;
        Some(others.iter().fold(first.apply(image), |image, enhancer| enhancer.apply(&image)))
    }
}

/// A step of the temporal filter; the first frame passes through.
fn filter<const C: usize>(
    params: &TaaParams,
    current: Image<C>,
    last: Option<Image<C>>,
    motion: Option<&Motion>,
    [rates, last_rates]: [Option<&Image<1>>; 2],
) -> Image<C> {
    match last.filter(|last| [last.width(), last.height()] == [current.width(), current.height()]) {
        None => current,
        Some(last) => {
            Step { current: &current, last: &last, motion, rates, last_rates }.filter(params)
        }
    }
}

/// The geometry. A method that does not use the focal length gets any.
fn setting(
    spec: &EmulationSpec,
    size: [usize; 2],
    view: Option<&View>,
    gaze_px: [f64; 2],
) -> Result<Setting, EmulateError> {
    let [width, height] = size;
    let view = match (view, spec.needs_view()) {
        (Some(view), _) => *view,
        (None, Some(what)) => return Err(EmulateError::NoView { what }),
        (None, None) => {
            let (w, h) = (width as f64, height as f64);
            View { width, height, focal_px: [w.max(1.0); 2], principal_px: [w / 2.0, h / 2.0] }
        }
    };
    if [view.width, view.height] != size {
        let found = [view.width, view.height];
        return Err(EmulateError::Size { what: "a view", found, expected: size });
    }
    Ok(Setting::new(&view, gaze_px)?)
}

/// S of coarse pixel shading, not quantised; `None` for other methods.
fn rates(spec: &EmulationSpec, setting: &Setting) -> Option<Arc<Image<1>>> {
    let Emulated::Foveation(Method::Cps(params)) = &spec.method else { return None };
    let mapped = Cps::new(params, setting);
    let of = |r: f64| mapped.normalised(setting.eccentricity_deg(r));
    let (radial, offsets) =
        (Radial::new(Detail::Fine, setting.corner_px(), of), Offsets::new(setting));
    Some(Arc::new(Image::by_rows(offsets.width(), offsets.height(), |y, row| {
        for (out, square) in row.iter_mut().zip(offsets.squares(y, 0..offsets.width())) {
            *out = [radial.at(square).clamp(0.0, 1.0)];
        }
    })))
}

/// The enhancement of the perceptual target, and the one that was asked for.
fn enhancers(spec: &EmulationSpec, setting: &Setting) -> Vec<Enhancer> {
    let own = match &spec.method {
        Emulated::PerceptualTarget(params) => Some((params.f_max, params)),
        _ => None,
    };
    let asked = spec.enhance.map(|f_max| (f_max, &spec.enhancement));
    let enhancer = |(f_max, params): (f64, &crate::sandbox_params::SandboxParams)| {
        Enhancer::new(f_max, params.growth, params.transition_deg, setting)
    };
    own.into_iter().chain(asked).map(enhancer).collect()
}
