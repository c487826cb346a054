//! Acuity: the highest spatial frequency that is visible at an eccentricity, in cycles per degree.
//! There is one model per file; each is a pure function of f64.
//!
//! [`AcuityModel`] is the registry: a model with its parameters, which are set by name. Curves and
//! methods compute with [`AcuityCurve`]: every model here is a minimum angle of resolution (MAR)
//! that is piecewise linear in eccentricity, so that the number of samples up to an eccentricity
//! has a closed form.

mod curve;
mod geisler_perry;
mod linear_mar;
mod model;
mod piecewise_mar;
mod thibos;

pub use curve::AcuityCurve;
pub use geisler_perry::GeislerPerry;
pub use linear_mar::LinearMar;
pub use model::{AcuityInfo, AcuityModel};
pub use piecewise_mar::{PiecewiseMar, PiecewiseMarError, PiecewiseParams};
pub use thibos::{GratingThresholds, THIBOS_1996};
