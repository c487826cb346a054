//! Series to figures as SVG, and PNG from the SVG: curves, bars and distributions, made for half
//! the width of a page of a paper, panels of curves for the whole of it, and pictures for either.
//!
//! A figure is plain data ([`LineChart`], [`BarChart`], [`SpreadChart`], [`PanelChart`],
//! [`RasterChart`]); nothing here knows what was measured. The same figure gives the same bytes on every machine and thread: text is measured
//! and set in a bundled font, and no place depends on a function that differs between platforms.
//!
//! ```
//! use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look, png};
//!
//! let figure = Figure::Line(LineChart {
//!     x: Axis::new("Eccentricity (°)"),
//!     y: Axis::new("PSNR (dB)"),
//!     series: vec![LineSeries {
//!         name: "RMFR".to_owned(),
//!         look: Look::new(0),
//!         points: vec![(2.5, Some(38.2)), (7.5, Some(33.9)), (12.5, None)],
//!         ..LineSeries::default()
//!     }],
//!     ..LineChart::default()
//! });
//! let svg = figure.svg()?;
//! assert!(svg.contains("Eccentricity (°)"));
//! assert!(figure.csv().ends_with("RMFR,12.5,\n"));
//! assert!(png(&svg, 2.0)?.starts_with(b"\x89PNG"));
//! # Ok::<(), fovqa_plot::PlotError>(())
//! ```

mod axis;
mod bar;
mod bitmap;
mod box_summary;
mod clip;
mod colour_bar;
mod colour_map;
mod drawing;
mod error;
mod figure;
mod fill;
mod group_axis;
mod infinity;
mod layout;
mod left_out;
mod legend;
mod line;
mod look;
mod marker;
mod number;
mod overlay;
mod panel_grid;
mod panels;
mod path;
mod png;
mod position_axis;
mod raster;
mod scale;
mod smooth;
mod span;
mod spread;
mod svg;
mod swatch;
mod text;
mod ticks;
mod tidy;
mod value_axis;
mod value_label;
mod wrap;

pub use axis::Axis;
pub use bar::{BarChart, BarSeries};
pub use error::PlotError;
pub use figure::Figure;
pub use fill::{Fill, FillKind};
pub use line::{LineChart, LineSeries};
pub use look::Look;
pub use panels::PanelChart;
pub use png::png;
pub use raster::{RasterChart, RasterLine, RasterPanel};
pub use span::Span;
pub use spread::{SpreadChart, SpreadSeries};
