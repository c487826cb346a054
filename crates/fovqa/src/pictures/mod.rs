//! Pictures of frames for the report of a run: the chosen frames in full, their maps, and what the page
//! holds of them.

mod again;
mod blocks;
mod chosen;
mod folders;
mod recorder;
mod reduced;
mod retake;

pub(crate) use again::Again;
pub(crate) use blocks::{blocks, means};
pub(crate) use folders::{clear_pictures, copy_pictures};
pub(crate) use recorder::Pictures;
pub(crate) use reduced::{Small, small};
pub(crate) use retake::{Taking, no_pictures, take_missing};
