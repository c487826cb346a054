//! Test against reference: one file a metric, and one pass over the rows for all of them.

pub mod fpsnr;
pub mod fvvdp;
mod ms_ssim;
mod pass;
pub mod pu_psnr;
mod scorer;
mod squared_error;
pub mod ssim;
#[cfg(test)]
mod tests;
mod weighted_mean;

pub use scorer::{BandScores, PairScores, ScoreError, Scorer};
pub use squared_error::{mse_of_db, psnr_db};
