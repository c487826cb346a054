//! Shading rate against acuity: the rate of a foveation method at each eccentricity, its cost, and
//! where it is below the acuity curve. This module computes numbers only; figures and tables are
//! made elsewhere.

mod acuity_shares;
mod density;
mod error;
mod setting;
mod spec;
mod trace;

pub use acuity_shares::{AcuityShares, acuity_shares};
pub use density::{DensityMap, density_map};
pub use error::CurveError;
pub use setting::{CurveRange, CurveSetting};
pub use spec::{CurveBudget, CurveSource, CurveSpec};
pub use trace::{Curve, CurvePoint, trace, trace_all};
