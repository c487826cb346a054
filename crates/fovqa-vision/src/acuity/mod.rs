//! Acuity: the highest spatial frequency seen at an eccentricity, in cycles per degree. One model
//! a file; each is a pure function of f64.

mod geisler_perry;
mod linear_mar;
mod piecewise_mar;

pub use geisler_perry::GeislerPerry;
pub use linear_mar::LinearMar;
pub use piecewise_mar::{PiecewiseMar, PiecewiseMarError};
