//! Motion and depth of OpenEXR files, as a caller of this crate reads them.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::float_cmp, reason = "what is only passed on comes back exactly")]

mod beside_colour;
mod files;
mod hostile_files;
mod names;
mod separate_files;
mod values;
mod windows;
