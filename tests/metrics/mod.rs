//! The numbers: golden values, shapes, bands, maps.

pub(crate) mod fvvdp;
mod fvvdp_errors;
mod gmsd;
mod golden;
mod maps;
mod profiles;
mod temporal;
mod wide_fields;
