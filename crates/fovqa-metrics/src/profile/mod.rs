//! One picture by eccentricity: what is measured of reference and test alike, and then compared.

pub mod haar;
mod pass;
mod profiler;
pub mod rms_contrast;
#[cfg(test)]
mod tests;

pub use profiler::Profiler;
