//! What is wrong with a parameter.

use thiserror::Error;

/// A parameter that is not there, or a value it cannot take.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ParamError {
    /// No such parameter.
    #[error("{owner} has no parameter {param:?}; {known}")]
    Unknown {
        /// The metric, model or method.
        owner: &'static str,
        /// What was given.
        param: String,
        /// What there is.
        known: String,
    },
    /// A value out of its range or of another type.
    #[error("{owner}.{param} cannot be {value}: {expected}")]
    Value {
        /// The metric, model or method.
        owner: &'static str,
        /// The parameter.
        param: &'static str,
        /// What was given.
        value: String,
        /// What it may be.
        expected: String,
    },
}
