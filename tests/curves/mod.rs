//! `fovqa curves`.

pub(crate) mod files;
mod flags;
mod golden;
