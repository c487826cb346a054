//! `fovqa curves`.

mod figures;
pub(crate) mod files;
mod flags;
mod golden;
mod kinds;
mod mistakes;
