//! Draws series as figures in SVG, PDF and PNG. Unless the [`Style`] says otherwise, curves, bars and
//! distributions have the width of a column (3.3 in), panels of curves have that of a page (7 in),
//! and pictures have either.
//!
//! A figure is plain data ([`LineChart`], [`BarChart`], [`SpreadChart`], [`PanelChart`],
//! [`RasterChart`], [`MontageChart`]); nothing here knows what was measured. The same figure gives the same bytes on
//! every machine and thread: text is measured and set in a bundled font, and no position depends on
//! a function that differs between platforms.
//!
//! ```
//! use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look, Style};
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
//! let printed = figure.print(&Style::default())?;
//! assert_eq!(printed.size_in().0.round(), 3.0);
//! assert!(printed.svg()?.contains("Eccentricity (°)"));
//! assert!(printed.pdf("PSNR of RMFR")?.starts_with(b"%PDF"));
//! assert!(printed.png(300.0)?.starts_with(b"\x89PNG"));
//! assert!(figure.csv().ends_with("RMFR,12.5,\n"));
//! # Ok::<(), fovqa_plot::PlotError>(())
//! ```

mod axes;
mod canvas;
mod charts;
mod error;
mod figure;
mod limits;
mod marks;
mod page;
mod scales;
mod tidy;

pub use axes::axis::Axis;
pub use canvas::colour_map::{MAP_NO_VALUE, map_palette};
pub use canvas::look::Look;
pub use canvas::palette::Palette;
pub use canvas::photo::Photo;
pub use canvas::printed::Printed;
pub use charts::bar::{BarChart, BarSeries, Bracket, ReferenceLine};
pub use charts::heat_map::{HeatMap, HeatMapLayout};
pub use charts::heat_overlay::HeatRing;
pub use charts::heat_scale::HeatScale;
pub use charts::line::{LineChart, LineSeries};
pub use charts::montage::{MontageChart, MontageRow};
pub use charts::panels::PanelChart;
pub use charts::raster::RasterChart;
pub use charts::raster_panel::{GridPlaces, RasterLine, RasterPanel};
pub use charts::spread::SpreadChart;
pub use charts::spread_series::SpreadSeries;
pub use charts::unseen::Unseen;
pub use error::PlotError;
pub use figure::Figure;
pub use limits::LEAST_PT;
pub use marks::fill::Fill;
pub use marks::fill_kind::FillKind;
pub use marks::span::Span;
pub use page::style::{Height, Style};
