//! Shading rate against acuity: what a foveation method shades at each eccentricity, what that
//! costs, and where it leaves the acuity curve. A plan of curves in, numbers out; knows nothing of
//! drawing.

mod curve;
mod density;
mod field;

pub use curve::{Curve, CurveError, Row, trace, trace_all};
pub use density::{DensityMap, density_map};
pub use field::{Field, field};
