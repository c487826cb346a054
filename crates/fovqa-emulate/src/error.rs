//! What is wrong with an emulation.

use fovqa_methods::{BudgetError, MethodError};
use fovqa_params::ParamError;
use thiserror::Error;

/// An emulation that cannot be.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EmulateError {
    /// No method of this name.
    #[error("there is no method {name:?} to emulate; there are {known}")]
    UnknownMethod {
        /// What was given.
        name: String,
        /// What there is.
        known: String,
    },
    /// No such parameter, or a value it cannot take.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// A filter, or a parameter of a filter, that the method does not have.
    #[error("{method} has no {wanted}; {known}")]
    NoFilter {
        /// The method.
        method: &'static str,
        /// What was asked for.
        wanted: String,
        /// The filters it has.
        known: &'static str,
    },
    /// A method or an enhancement that depends on angles, without a view.
    #[error(
        "{what} depends on visual angles: it needs a view, such as a field of view or a display"
    )]
    NoView {
        /// The method or enhancement.
        what: &'static str,
    },
    /// A share, strength or size that cannot be.
    #[error("{what} cannot be {found}: it lies between {least} and {most}")]
    OutOfRange {
        /// What it is.
        what: &'static str,
        /// What was given.
        found: f64,
        /// The least it may be.
        least: f64,
        /// The most it may be.
        most: f64,
    },
    /// A method that would shade more samples than memory is used for.
    #[error(
        "{method} would shade {samples:.0} samples with these parameters; at most {most} are emulated"
    )]
    TooManySamples {
        /// The method.
        method: &'static str,
        /// The samples of one frame.
        samples: f64,
        /// How many there may be.
        most: u64,
    },
    /// A budget beside the parameter that it solves.
    #[error("{method}: a budget solves {parameter}, which is set as well")]
    BudgetAndParameter {
        /// The method.
        method: &'static str,
        /// The parameter.
        parameter: &'static str,
    },
    /// A picture or motion of another size than the emulator's.
    #[error("{what} of {}x{} in an emulation of {}x{}", found[0], found[1], expected[0], expected[1])]
    Size {
        /// What has the wrong size.
        what: &'static str,
        /// Its width and height.
        found: [usize; 2],
        /// Those of the emulator.
        expected: [usize; 2],
    },
    /// Two eyes of which one is gray and the other in colour.
    #[error("the frames of one eye are gray, and those of the other in colour")]
    Channels,
    /// Parameters that do not go together, or not with the frame.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// A budget that cannot be had.
    #[error(transparent)]
    Budget(#[from] BudgetError),
}

impl EmulateError {
    /// How to correct it.
    pub fn help(&self) -> &'static str {
        match self {
            Self::UnknownMethod { .. } | Self::Param(_) | Self::Method(_) => {
                "`fovqa list methods` shows all methods with their parameters"
            }
            Self::NoFilter { .. } => "leave filters out, or choose one that the method has",
            Self::NoView { .. } => "give {view}",
            Self::OutOfRange { .. } => "give a number in this range",
            Self::Size { .. } => "all frames of a sequence must have the same size",
            Self::TooManySamples { .. } => {
                "choose parameters with fewer samples, or a smaller budget"
            }
            Self::Channels => "render both eyes alike",
            Self::BudgetAndParameter { .. } => "leave one of them out",
            Self::Budget(_) => "choose another share, or other parameters",
        }
    }
}
