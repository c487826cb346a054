//! `fovqa curves`.

mod data;
mod figures;
pub(crate) mod files;
mod flags;
mod golden;
mod kinds;
mod mistakes;
