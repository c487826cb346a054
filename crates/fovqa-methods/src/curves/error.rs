//! Errors of curves.

use fovqa_vision::acuity::PiecewiseMarError;
use thiserror::Error;

use crate::error::MethodError;

/// The reason why a curve cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CurveError {
    /// The method cannot be applied.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The knots do not make an acuity curve.
    #[error(transparent)]
    Acuity(#[from] PiecewiseMarError),
}
