//! `fovqa foveate`.

mod frames;
mod golden;
mod mistakes;
mod outputs;
mod record;
mod sequences;
