//! Tails and quantiles of the distributions that the tests use.
//!
//! Small tails are computed directly, not as 1 minus a large one. `statrs` provides the incomplete
//! gamma function and the inverse error function. The incomplete beta function is our own, because
//! that of `statrs` stops after 140 terms, which is too early for large samples.

mod binomial;
mod incomplete_beta;
mod normal;
mod tails;

pub use binomial::{
    binomial_at_least, binomial_at_most, binomial_probability, clopper_pearson, half_two_sided,
    wilson,
};
pub use incomplete_beta::incomplete_beta;
pub use normal::{normal_cdf, normal_density, normal_log_cdf, normal_quantile, normal_two_sided};
pub use tails::{chi_squared_upper, f_upper, t_quantile, t_two_sided, t_upper, t_upper_quantile};
