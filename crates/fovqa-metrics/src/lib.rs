//! The metrics: numbers from pairs of frames. This crate knows nothing about files.
//!
//! [`Metric`] is the registry of metrics, with units, directions, parameters and sources.
//! [`Scorer`] computes all fidelity metrics that are asked for in one pass over the rows of a pair,
//! and [`Profiler`] all profiles in one pass over a picture. [`temporal`] compares a picture with
//! the one before it. Each metric's formula has a file of its own in `fidelity/`, `profile/` or
//! `temporal/`.

mod decibels;
mod fidelity;
mod frame_rows;
mod info;
mod kinds;
mod log_exp;
mod map;
mod metric;
mod metric_params;
mod pair_input;
mod param_set;
mod pooling;
pub mod profile;
mod regions;
mod registry;
mod row;
mod spool;
mod sums;
pub mod temporal;

pub use fidelity::fpsnr::{self, WeightField};
pub use fidelity::fvvdp;
pub use fidelity::pu_psnr;
pub use fidelity::score_error::ScoreError;
pub use fidelity::scored::Scored;
pub use fidelity::scorer::Scorer;
pub use fidelity::ssim;
pub use frame_rows::{FrameRows, Layout, Layouts};
pub use info::{Demand, MetricInfo, Needs};
pub use kinds::{Better, LeadIn, MetricKind};
pub use map::{Map, MapInfo, MapPicture, MapScale};
pub use metric::Metric;
pub use metric_params::NoParams;
pub use pair_input::PairInput;
pub use param_set::ParamSet;
pub use pooling::{Parts, Pool, Pooling, Statistic, Weight, pool};
pub use profile::{PictureInput, Profiler, spectrum};
pub use regions::{BlockRegions, Regions};
pub use registry::Params;
pub use row::{Image, Key, Row, Rows, Subject};
pub use spool::ReadBackError;
