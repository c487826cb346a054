//! Every kind of file that is read, and what damaged files get.

mod bad_input;
mod decoding;
mod exr_layers;
mod jpeg;
mod motion_and_depth;
mod png;
mod special_files;
mod stereo_layers;
mod y4m;
mod y4m_golden;
