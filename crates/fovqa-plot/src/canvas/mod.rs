//! The elements of a drawing: shapes, text and colours, and the SVG, PDF and PNG made of them.

pub(crate) mod bitmap;
pub(crate) mod clip;
pub(crate) mod colour;
pub(crate) mod colour_map;
pub(crate) mod drawing;
pub(crate) mod look;
pub(crate) mod palette;
pub(crate) mod path;
pub(crate) mod pdf;
pub(crate) mod pdf_font;
pub(crate) mod photo;
pub(crate) mod png;
pub(crate) mod printed;
pub(crate) mod setting;
pub(crate) mod smooth;
pub(crate) mod svg;
pub(crate) mod svg_joined;
pub(crate) mod svg_text;
pub(crate) mod text;
pub(crate) mod thin;
pub(crate) mod wrap;
