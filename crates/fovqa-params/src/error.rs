//! Errors about parameters and their values.

use thiserror::Error;

/// A parameter that does not exist, or a value that the parameter does not accept.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ParamError {
    /// There is no parameter of this name.
    #[error("{owner} has no parameter {param:?}; {known}")]
    Unknown {
        /// The metric, model or method.
        owner: &'static str,
        /// The name that was given.
        param: String,
        /// The names that exist.
        known: String,
    },
    /// The value is out of range or has another type.
    #[error("{owner}.{param} cannot be {value}: {expected}")]
    Value {
        /// The metric, model or method.
        owner: &'static str,
        /// The parameter's name.
        param: &'static str,
        /// The value that was given.
        value: String,
        /// The values that the parameter accepts.
        expected: String,
    },
}
