//! Foveation methods as pure mathematics: the positions of a method's samples on the screen, their
//! density and their number. This crate knows nothing about images.
//!
//! [`Method`] is the registry: a method with its parameters, which are set by name.
//! [`Method::apply`] applies it to a [`Setting`] (a frame, its focal length and the gaze), and
//! returns a [`Foveation`]: rates, density, counts and, where the method has a reduced buffer, its
//! [`Mapping`]. [`curves`] computes the shading rate over eccentricity and compares it with acuity.
//! There is one file per method, each in the same order: source and misprints, parameters, mapping,
//! inverse, rates, counts.
//!
//! Places are measured from the gaze, in pixels, x to the right and y down; angles are degrees. A
//! method's own eccentricity is the planar one, e = atan(r / f), as a renderer computes it.
//!
//! ```
//! use fovqa_methods::{Method, Place, Setting};
//! use fovqa_params::ParamValue;
//! use fovqa_vision::ViewSpec;
//!
//! let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(110.0) };
//! let view = spec.resolve(1440, 1600)?.view;
//! let mut rmfr = Method::find("rmfr").unwrap();
//! rmfr.set("sigma", &ParamValue::Number(2.6))?;
//! let rmfr = rmfr.apply(&Setting::new(&view, [720.0, 800.0])?)?;
//! let share = rmfr.counts().samples / (1440.0 * 1600.0);
//! assert!((share - 0.1479).abs() < 1e-4);
//! let [u, v] = rmfr.mapping().unwrap().to_buffer(0, Place::at([100.0, 0.0]));
//! assert!(u > 0.0 && v > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod budget;
pub mod cps;
pub mod curves;
pub mod deamp;
mod error;
mod foveation;
pub mod full;
pub mod guenter;
mod info;
pub mod kfr;
pub mod lafr;
pub mod linear;
mod log_polar;
mod quadrature;
mod registry;
pub mod rmfr;
pub mod sandbox;
mod setting;
pub mod vafr;
pub mod visual_polar;

pub use budget::{BudgetError, BudgetSamples, Budgeted};
pub use error::MethodError;
pub use foveation::{Counts, Foveation, Mapping, Rates, Reach};
pub use info::MethodInfo;
pub use registry::Method;
pub use setting::{Place, Setting};

#[cfg(test)]
mod tests;
