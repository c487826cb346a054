//! The kinds of charts.

pub(crate) mod bar;
pub(crate) mod box_summary;
pub(crate) mod dodge;
pub(crate) mod heat_map;
pub(crate) mod heat_overlay;
pub(crate) mod heat_scale;
pub(crate) mod heat_strip;
pub(crate) mod left_out;
pub(crate) mod line;
pub(crate) mod montage;
pub(crate) mod overlay;
pub(crate) mod panels;
pub(crate) mod raster;
pub(crate) mod raster_panel;
pub(crate) mod spread;
pub(crate) mod spread_series;
pub(crate) mod unseen;
pub(crate) mod violin;
