//! Profiles: metrics that describe one picture by eccentricity. They are measured for reference and
//! test and then compared.

pub mod haar;
mod pass;
mod picture_input;
mod profiler;
pub mod rms_contrast;
pub mod spectrum;
#[cfg(test)]
mod tests;

pub use picture_input::PictureInput;
pub use profiler::Profiler;
