//! A method, prepared for a frame size, a view and a gaze: one `match` each for what all of them do.

use fovqa_frame::Mask;
use fovqa_methods::{Method, Setting, kfr, lafr};

use crate::borders::Border;
use crate::counts::Counts;
use crate::cps::Cps;
use crate::deamp::Deamp;
use crate::error::EmulateError;
use crate::fxaa::Fxaa;
use crate::guenter::Guenter;
use crate::image::Image;
use crate::linear::Linear;
use crate::log_polar::{Filters, LogPolar};
use crate::method::Emulated;
use crate::rmfr::Rmfr;
use crate::sample_places::{SamplePlaces, pixel_positions};
use crate::sandbox::{Aliased, Stable};
use crate::source::Source;
use crate::spec::EmulationSpec;
use crate::sums::count_on;
use crate::vafr::Vafr;
use crate::value::Value;
use crate::visual_polar::VisualPolar;

/// A method, ready for frames.
#[derive(Debug)]
pub(crate) enum Prepared {
    /// Every pixel: the frame itself.
    Full(SamplePlaces, [usize; 2]),
    Rmfr(Rmfr),
    Deamp(Deamp),
    Guenter(Box<Guenter>),
    Cps(Cps),
    Linear(Linear),
    LogPolar(LogPolar),
    Vafr(Vafr),
    VisualPolar(VisualPolar),
    Stable(Stable, [usize; 2]),
    Aliased(Aliased, [usize; 2]),
}

impl Prepared {
    /// Samples stand at `within_cell` of their cells, from 0 to 1.
    pub(crate) fn new(
        spec: &EmulationSpec,
        setting: &Setting,
        within_cell: [f64; 2],
    ) -> Result<Self, EmulateError> {
        let places = SamplePlaces::new(spec.sampling, within_cell);
        let size = setting.size_px().map(|side| side as usize);
        let [buffer, screen] = spec.method.filters().chosen(spec.filters).unwrap_or_default();
        let filter = spec.filter;
        let log_polar = Filters { buffer, screen: screen.then_some(filter.factor) };
        Ok(match &spec.method {
            Emulated::Taa | Emulated::Foveation(Method::Full) => Self::Full(places, size),
            Emulated::Stable(params) | Emulated::PerceptualTarget(params) => {
                Self::Stable(Stable::new(params, setting, places), size)
            }
            Emulated::Aliased(params) => Self::Aliased(Aliased::new(params, setting, places), size),
            Emulated::Foveation(Method::Rmfr(params)) => {
                Self::Rmfr(Rmfr::new(params, setting, places))
            }
            Emulated::Foveation(Method::Deamp(params)) => {
                let sigma_px = screen.then_some(filter.sigma_px);
                Self::Deamp(Deamp::new(params, setting, places, sigma_px)?)
            }
            Emulated::Foveation(Method::Guenter(params)) => {
                Self::Guenter(Box::new(Guenter::new(params, setting, places)?))
            }
            Emulated::Foveation(Method::Cps(params)) => {
                Self::Cps(Cps::new(params, setting, places))
            }
            Emulated::Foveation(Method::Linear(params)) => {
                Self::Linear(Linear::new(params, setting, places)?)
            }
            Emulated::Foveation(Method::Kfr(params)) => {
                let mapped = kfr::Kfr::new(params, setting)?;
                Self::LogPolar(LogPolar::new(&mapped, setting, places, log_polar))
            }
            Emulated::Foveation(Method::Lafr(params)) => {
                let mapped = lafr::Lafr::new(params, setting)?;
                Self::LogPolar(LogPolar::new(&mapped, setting, places, log_polar))
            }
            Emulated::Foveation(Method::Vafr(params)) => {
                let fxaa =
                    Fxaa { span: filter.span, reduce: filter.reduce, minimum: filter.minimum };
                Self::Vafr(Vafr::new(params, setting, places, buffer.then_some(fxaa))?)
            }
            Emulated::Foveation(Method::VisualPolar(params)) => {
                Self::VisualPolar(VisualPolar::new(*params, setting, places))
            }
        })
    }

    pub(crate) fn counts(&self) -> Counts {
        match self {
            Self::Full(_, [w, h]) | Self::Stable(_, [w, h]) | Self::Aliased(_, [w, h]) => {
                Counts::rectangular(vec![[*w, *h]], (w * h) as f64)
            }
            Self::Rmfr(method) => method.counts(),
            Self::Deamp(method) => method.counts(),
            Self::Guenter(method) => method.counts(),
            Self::Cps(method) => method.counts(),
            Self::Linear(method) => method.counts(),
            Self::LogPolar(method) => method.counts(),
            Self::Vafr(method) => method.counts(),
            Self::VisualPolar(method) => method.counts(),
        }
    }

    /// The borders between layers or rates, the innermost first; none for a method whose rate changes
    /// everywhere.
    pub(crate) fn borders(&self) -> Vec<Border> {
        match self {
            Self::Deamp(method) => method.borders(),
            Self::Guenter(method) => method.borders(),
            Self::Cps(method) => method.borders(),
            Self::Full(..)
            | Self::Rmfr(_)
            | Self::Linear(_)
            | Self::LogPolar(_)
            | Self::Vafr(_)
            | Self::VisualPolar(_)
            | Self::Stable(..)
            | Self::Aliased(..) => Vec::new(),
        }
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Full(places, size) => pixel_positions(*places, *size).collect(),
            Self::Stable(method, size) => pixel_positions(method.places, *size).collect(),
            Self::Rmfr(method) => method.positions().collect(),
            Self::Deamp(method) => method.positions().collect(),
            Self::Guenter(method) => method.positions().collect(),
            Self::Cps(method) => method.positions(),
            Self::Linear(method) => method.positions().collect(),
            Self::LogPolar(method) => method.positions().collect(),
            Self::Vafr(method) => method.positions().collect(),
            Self::VisualPolar(method) => method.positions().collect(),
            Self::Aliased(method, _) => method.positions().collect(),
        }
    }

    /// How many of the samples that are counted stand on the pixels of a mask of the frame's size.
    pub(crate) fn samples_on(&self, mask: &Mask) -> f64 {
        match self {
            Self::Full(places, size) => count_on(mask, pixel_positions(*places, *size)) as f64,
            // They shade every pixel.
            Self::Stable(_, [w, h]) | Self::Aliased(_, [w, h]) => {
                (w * h) as f64 - mask.left_out() as f64
            }
            Self::Rmfr(method) => count_on(mask, method.positions()) as f64,
            Self::Deamp(method) => count_on(mask, method.counted_positions()) as f64,
            Self::Guenter(method) => count_on(mask, method.positions()) as f64,
            Self::Cps(method) => method.samples_on(mask),
            Self::Linear(method) => method.samples_on(mask),
            Self::LogPolar(method) => count_on(mask, method.positions()) as f64,
            Self::Vafr(method) => method.samples_on(mask),
            Self::VisualPolar(method) => count_on(mask, method.positions()) as f64,
        }
    }

    /// What the method shows of a frame or a scene.
    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        match self {
            Self::Full(places, size) => source.sample_frame(*places, *size),
            Self::Rmfr(method) => method.show(source),
            Self::Deamp(method) => method.show(source),
            Self::Guenter(method) => method.show(source),
            Self::Cps(method) => method.show(source),
            Self::Linear(method) => method.show(source),
            Self::LogPolar(method) => method.show(source),
            Self::Vafr(method) => method.show(source),
            Self::VisualPolar(method) => method.show(source),
            Self::Stable(method, _) => method.show(source),
            Self::Aliased(method, _) => method.show(source),
        }
    }

    /// The buffers of a frame or a scene, the innermost first; none for methods without.
    pub(crate) fn buffers<const C: usize>(&self, source: &impl Source<C>) -> Vec<Image<C>> {
        match self {
            Self::Rmfr(method) => vec![method.buffer(source)],
            Self::Deamp(method) => method.buffers(source),
            Self::Guenter(method) => method.buffers(source),
            Self::LogPolar(method) => vec![method.buffer(source)],
            Self::Vafr(method) => vec![method.buffer(source)],
            Self::VisualPolar(method) => vec![method.buffer(source)],
            Self::Full(..)
            | Self::Cps(_)
            | Self::Linear(_)
            | Self::Stable(..)
            | Self::Aliased(..) => Vec::new(),
        }
    }
}
