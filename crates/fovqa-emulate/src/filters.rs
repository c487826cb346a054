//! The filters of methods, and their parameters.

use fovqa_params::{ParamInfo, ParamValue, ParamValues, words};

words! {
    /// Which of a method's own filters are on.
    #[derive(Default)]
    pub enum FilterChoice {
        /// None.
        #[default]
        None "none" "None of its filters";
        /// All it has.
        Own "own" "All filters the method has";
        /// The one in its buffer.
        Buffer "buffer" "The filter in its buffer (kfr, lafr, vafr)";
        /// The one on the finished picture.
        Screen "screen" "The filter on the finished picture (kfr, lafr, deamp)";
    }
}

/// Parameters of all filters; a method uses those of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FilterParams {
    /// KFR, LaFR on screen: width of the blur over the spacing of samples less 1 px.
    pub(crate) factor: f64,
    /// DEAMP on screen: width of the Gaussian in pixels.
    pub(crate) sigma_px: f64,
    /// VaFR in the buffer: most samples to either side of an edge.
    pub(crate) span: f64,
    /// VaFR in the buffer: share of the mean luma added to gradients.
    pub(crate) reduce: f64,
    /// VaFR in the buffer: the least that is added.
    pub(crate) minimum: f64,
}

impl Default for FilterParams {
    fn default() -> Self {
        Self { factor: 0.5, sigma_px: 1.0, span: 8.0, reduce: 0.125, minimum: 1.0 / 128.0 }
    }
}

impl FilterParams {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "factor" => self.factor = value.number()?,
            "sigma_px" => self.sigma_px = value.number()?,
            "span" => self.span = value.number()?,
            "reduce" => self.reduce = value.number()?,
            "minimum" => self.minimum = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

/// The filters a method has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FilterInfo {
    pub(crate) buffer: bool,
    pub(crate) screen: bool,
    /// What it has, for error messages.
    pub(crate) known: &'static str,
    pub(crate) params: &'static [ParamInfo],
}

impl FilterInfo {
    /// Whether the filter in the buffer and the one on screen are on; `None` where the method does not
    /// have the one asked for.
    pub(crate) fn chosen(&self, choice: FilterChoice) -> Option<[bool; 2]> {
        match choice {
            FilterChoice::None => Some([false; 2]),
            FilterChoice::Own => (self.buffer || self.screen).then_some([self.buffer, self.screen]),
            FilterChoice::Buffer => self.buffer.then_some([true, false]),
            FilterChoice::Screen => self.screen.then_some([false, true]),
        }
    }
}

pub(crate) const NONE: FilterInfo = FilterInfo {
    buffer: false,
    screen: false,
    known: "only deamp, kfr, lafr and vafr have filters",
    params: &[],
};

pub(crate) const LOG_POLAR: FilterInfo = FilterInfo {
    buffer: true,
    screen: true,
    known: "it has the filters `buffer` and `screen`",
    params: &[ParamInfo {
        name: "factor",
        default: "0.5",
        values: ParamValues::Number(0.0, 100.0),
        about: "filter on screen: σ over the local spacing of samples in pixels less 1",
    }],
};

pub(crate) const DEAMP: FilterInfo = FilterInfo {
    buffer: false,
    screen: true,
    known: "it has the filter `screen`",
    params: &[ParamInfo {
        name: "sigma_px",
        default: "1",
        values: ParamValues::Number(0.01, 100.0),
        about: "filter on screen: σ of the Gaussian beyond the middle layer, px",
    }],
};

pub(crate) const VAFR: FilterInfo = FilterInfo {
    buffer: true,
    screen: false,
    known: "it has the filter `buffer`",
    params: &[
        ParamInfo {
            name: "span",
            default: "8",
            values: ParamValues::Number(0.0, 1000.0),
            about: "FXAA: most samples to either side of an edge",
        },
        ParamInfo {
            name: "reduce",
            default: "0.125",
            values: ParamValues::Number(0.0, 1.0),
            about: "FXAA: share of the mean luma added to gradients",
        },
        ParamInfo {
            name: "minimum",
            default: "0.0078125",
            values: ParamValues::Number(1e-6, 1.0),
            about: "FXAA: the least that is added to gradients, of a luma of 0 to 1",
        },
    ],
};
