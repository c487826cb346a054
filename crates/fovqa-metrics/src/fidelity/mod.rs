//! Test against reference: one file a metric, and one pass over the rows for all of them.

pub mod fpsnr;
pub(crate) mod fssim;
pub mod fvvdp;
pub(crate) mod ms_ssim;
pub(crate) mod mse;
mod pass;
pub(crate) mod psnr;
pub mod pu_psnr;
mod score_error;
mod scorer;
pub mod ssim;
#[cfg(test)]
mod tests;
mod totals;
mod weighted_mean;

pub(crate) use psnr::{mse_of_db, psnr_db};
pub use score_error::ScoreError;
pub use scorer::{Scored, Scorer};
