//! Metrics that compare test and reference: one file per metric, and one pass over the rows for
//! most of them.

pub mod fpsnr;
pub(crate) mod fssim;
pub mod fvvdp;
pub(crate) mod ms_ssim;
pub(crate) mod mse;
mod pass;
pub(crate) mod psnr;
pub mod pu_psnr;
pub(crate) mod score_error;
pub(crate) mod scored;
pub(crate) mod scorer;
pub mod ssim;
#[cfg(test)]
mod tests;
mod totals;
pub(crate) mod weighted_mean;
