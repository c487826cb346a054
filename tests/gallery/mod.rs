//! The built-in scenes: in experiments, and as files.

mod experiments;
mod files;
mod reproject;
