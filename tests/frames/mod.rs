//! Which frames are scored, how they pair, where the gaze is, and what the signal is.

mod frame_numbers;
mod gaze_files;
pub(crate) mod moving_frames;
mod questionable_views;
mod sequences;
mod signal;
