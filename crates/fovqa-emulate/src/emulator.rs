//! An emulation, prepared once for a frame size, a view and a gaze, and applied to any number of frames.

use std::sync::Arc;

use fovqa_frame::{Frame, SignalTables};
use fovqa_methods::cps::Cps;
use fovqa_methods::sandbox::Sandbox;
use fovqa_methods::{BudgetError, Method, Setting};
use fovqa_vision::View;

use crate::borders::Border;
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
use crate::temporal::TaaParams;

/// An emulation of frames of one size at one gaze. Everything that depends on these alone is computed
/// here, once.
#[derive(Debug, Clone)]
pub struct Emulator {
    size: [usize; 2],
    pub(crate) setting: Setting,
    pub(crate) prepared: Arc<Prepared>,
    counts: Counts,
    pub(crate) space: Space,
    pub(crate) temporal: Option<TaaParams>,
    /// S of each pixel; `None`: 0.
    pub(crate) rates: Option<Arc<Image<1>>>,
    pub(crate) enhancers: Arc<[Enhancer]>,
    budget: Option<BudgetReport>,
    pub(crate) solved: EmulationSpec,
}

impl Emulator {
    /// Prepares an emulation of frames of `size`, width and height in pixels, with the gaze in pixels
    /// from the top-left corner; a gaze outside of the frame is taken to its edge. With jitter samples
    /// stand as in frame 0; see [`Self::at_frame`].
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
        few_enough(&solved, &setting)?;
        let prepared = Prepared::new(&solved, &setting, solved.jitter.within_cell(0))?;
        let counts = prepared.counts();
        let budget = solution.map(|solution| solution.report(&counts, &setting));
        Ok(Self {
            size,
            space: solved.space,
            temporal: solved.temporal.then_some(solved.taa),
            rates: solved.temporal.then(|| rates(&solved, &setting)).flatten(),
            enhancers: enhancers(&solved, &setting),
            prepared: Arc::new(prepared),
            setting,
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
        few_enough(&spec.solved(&setting)?.0, &setting)
    }

    /// The smallest and the largest share of the frame's pixels that the method can have as a budget,
    /// counted as the budget of the spec says, if it has one.
    ///
    /// # Errors
    /// When the method cannot be applied, or has no parameter that a budget could set.
    pub fn budget_range(
        spec: &EmulationSpec,
        size: [usize; 2],
        view: Option<&View>,
        gaze_px: [f64; 2],
    ) -> Result<[f64; 2], EmulateError> {
        let setting = setting(spec, size, view, gaze_px)?;
        let of = spec.budget.map(|budget| budget.of).unwrap_or_default();
        match &spec.method {
            Emulated::Foveation(method) => Ok(method.budget_range(&setting, of)?),
            _ => Err(BudgetError::NotFree { method: spec.key() }.into()),
        }
    }

    /// The borders between layers or rates on the frame, the innermost first; none for a method whose
    /// rate changes everywhere.
    pub fn borders(&self) -> Vec<Border> {
        self.prepared.borders()
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
        let shown = self.method_picture(picture);
        Ok(self.enhanced(&shown).unwrap_or(shown))
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

    pub(crate) fn fits(&self, what: &'static str, found: [usize; 2]) -> Result<(), EmulateError> {
        let expected = self.size;
        if found == expected { Ok(()) } else { Err(EmulateError::Size { what, found, expected }) }
    }

    /// What the method alone shows of a picture.
    pub(crate) fn method_picture(&self, picture: &Picture) -> Picture {
        match picture {
            Picture::Gray(image) => Picture::Gray(self.method(image)),
            Picture::Rgb(image) => Picture::Rgb(self.method(image)),
        }
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

    /// A picture after all enhancers; `None` where there are none.
    pub(crate) fn enhanced(&self, picture: &Picture) -> Option<Picture> {
        let apply = |picture: &Picture, enhancer: &Enhancer| match picture {
            Picture::Gray(image) => Picture::Gray(enhancer.apply(image)),
            Picture::Rgb(image) => Picture::Rgb(enhancer.apply(image)),
        };
        let (first, others) = self.enhancers.split_first()?;
        Some(others.iter().fold(apply(picture, first), |picture, next| apply(&picture, next)))
    }
}

/// The most samples of a frame: they take 2 GB.
const MOST_SAMPLES: u64 = 1 << 27;

/// Checks that a method can be applied, before memory is asked for.
fn few_enough(spec: &EmulationSpec, setting: &Setting) -> Result<(), EmulateError> {
    let Emulated::Foveation(method) = &spec.method else { return Ok(()) };
    let samples = method.apply(setting)?.counts().whole();
    // Every pixel of a large frame may be shaded.
    let most = MOST_SAMPLES.max(setting.pixels() as u64);
    if samples <= most as f64 {
        return Ok(());
    }
    Err(EmulateError::TooManySamples { method: spec.key(), samples, most })
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
fn enhancers(spec: &EmulationSpec, setting: &Setting) -> Arc<[Enhancer]> {
    let own = match &spec.method {
        Emulated::PerceptualTarget(params) => Some(*params),
        _ => None,
    };
    let asked = spec.enhance.map(|f_max| Sandbox { f_max, ..spec.enhancement });
    own.into_iter().chain(asked).map(|sandbox| Enhancer::new(&sandbox, setting)).collect()
}
