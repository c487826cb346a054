//! A method, prepared for a frame size, a view and a gaze: one `match` each for what all of them do.

use fovqa_methods::{Method, Setting, kfr, lafr};

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
use crate::pixels::Pixels;
use crate::rmfr::Rmfr;
use crate::sandbox::{Aliased, Stable};
use crate::spec::EmulationSpec;
use crate::vafr::Vafr;
use crate::value::Value;
use crate::visual_polar::VisualPolar;

/// A method, ready for frames.
#[derive(Debug)]
pub(crate) enum Prepared {
    /// Every pixel: the frame itself.
    Full([usize; 2]),
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
    pub(crate) fn new(spec: &EmulationSpec, setting: &Setting) -> Result<Self, EmulateError> {
        let sampling = spec.sampling;
        let size = setting.size_px().map(|side| side as usize);
        let [buffer, screen] = spec.method.filters().chosen(spec.filters).unwrap_or_default();
        let filter = spec.filter;
        let log_polar = Filters { buffer, screen: screen.then_some(filter.factor) };
        Ok(match &spec.method {
            Emulated::Taa | Emulated::Foveation(Method::Full) => Self::Full(size),
            Emulated::Stable(params) | Emulated::PerceptualTarget(params) => {
                Self::Stable(Stable::new(params.growth, setting), size)
            }
            Emulated::Aliased(params) => {
                Self::Aliased(Aliased::new(params.growth, setting, sampling), size)
            }
            Emulated::Foveation(Method::Rmfr(params)) => {
                Self::Rmfr(Rmfr::new(params, setting, sampling))
            }
            Emulated::Foveation(Method::Deamp(params)) => {
                let sigma_px = screen.then_some(filter.sigma_px);
                Self::Deamp(Deamp::new(params, setting, sampling, sigma_px)?)
            }
            Emulated::Foveation(Method::Guenter(params)) => {
                Self::Guenter(Box::new(Guenter::new(params, setting, sampling)?))
            }
            Emulated::Foveation(Method::Cps(params)) => {
                Self::Cps(Cps::new(params, setting, sampling))
            }
            Emulated::Foveation(Method::Linear(params)) => {
                Self::Linear(Linear::new(params, setting, sampling)?)
            }
            Emulated::Foveation(Method::Kfr(params)) => {
                let mapped = kfr::Kfr::new(params, setting)?;
                Self::LogPolar(LogPolar::new(&mapped, setting, sampling, log_polar))
            }
            Emulated::Foveation(Method::Lafr(params)) => {
                let mapped = lafr::Lafr::new(params, setting)?;
                Self::LogPolar(LogPolar::new(&mapped, setting, sampling, log_polar))
            }
            Emulated::Foveation(Method::Vafr(params)) => {
                let fxaa =
                    Fxaa { span: filter.span, reduce: filter.reduce, minimum: filter.minimum };
                Self::Vafr(Vafr::new(params, setting, sampling, buffer.then_some(fxaa))?)
            }
            Emulated::Foveation(Method::VisualPolar(params)) => {
                Self::VisualPolar(VisualPolar::new(*params, setting, sampling))
            }
        })
    }

    pub(crate) fn counts(&self) -> Counts {
        match self {
            Self::Full([w, h]) | Self::Stable(_, [w, h]) | Self::Aliased(_, [w, h]) => {
                Counts::on_screen(vec![[*w, *h]], (w * h) as f64)
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

    /// What the method shows of a frame.
    pub(crate) fn show<const C: usize, V: Value>(&self, frame: &impl Pixels<C>) -> Image<C, V> {
        match self {
            Self::Full([w, h]) => Image::by_rows(*w, *h, |y, row| frame.read_row(y, 0..*w, row)),
            Self::Rmfr(method) => method.show(frame),
            Self::Deamp(method) => method.show(frame),
            Self::Guenter(method) => method.show(frame),
            Self::Cps(method) => method.show(frame),
            Self::Linear(method) => method.show(frame),
            Self::LogPolar(method) => method.show(frame),
            Self::Vafr(method) => method.show(frame),
            Self::VisualPolar(method) => method.show(frame),
            Self::Stable(method, _) => method.show(frame),
            Self::Aliased(method, _) => method.show(frame),
        }
    }

    /// The buffers of a frame, the innermost first; none for methods without.
    pub(crate) fn buffers<const C: usize>(&self, frame: &Image<C>) -> Vec<Image<C>> {
        match self {
            Self::Rmfr(method) => vec![method.buffer(frame)],
            Self::Deamp(method) => method.buffers(frame),
            Self::Guenter(method) => method.buffers(frame),
            Self::LogPolar(method) => vec![method.buffer(frame)],
            Self::Vafr(method) => vec![method.buffer(frame)],
            Self::VisualPolar(method) => vec![method.buffer(frame)],
            Self::Full(_)
            | Self::Cps(_)
            | Self::Linear(_)
            | Self::Stable(..)
            | Self::Aliased(..) => Vec::new(),
        }
    }
}
