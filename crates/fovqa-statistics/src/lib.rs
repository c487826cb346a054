//! Tails and quantiles of distributions, and corrections of p-values for several tests. The gate and
//! the analyses of user studies use the same ones.

pub mod adjust;
pub mod distributions;
