//! The numbers: golden values, shapes, bands, maps.

mod flicker;
mod flip;
pub(crate) mod fvvdp;
mod fvvdp_errors;
mod gmsd;
mod golden;
mod maps;
mod more;
mod profiles;
mod profiles_of_eyes;
mod spectrum;
mod temporal;
mod temporal_masks;
mod wide_fields;
