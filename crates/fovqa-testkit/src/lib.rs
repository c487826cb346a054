//! For tests alone: synthetic pictures, files of every kind (whole and broken), golden values.

pub mod exr_files;
pub mod fvvdp_golden;
pub mod golden;
pub mod npy;
pub mod png_files;
pub mod synthetic;
