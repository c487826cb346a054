//! Profiles: metrics that describe one picture by eccentricity. They are measured for reference and
//! test and then compared.

pub mod haar;
mod pass;
mod profiler;
pub mod rms_contrast;
#[cfg(test)]
mod tests;

pub use profiler::Profiler;
