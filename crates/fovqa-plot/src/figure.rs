//! A figure of any kind.

use crate::canvas::drawing::Drawing;
use crate::canvas::svg;
use crate::charts::bar::BarChart;
use crate::charts::line::LineChart;
use crate::charts::panels::PanelChart;
use crate::charts::raster::RasterChart;
use crate::charts::spread::SpreadChart;
use crate::error::PlotError;
use crate::tidy;

/// A figure of any kind.
#[derive(Debug, Clone, PartialEq)]
pub enum Figure {
    /// Curves.
    Line(LineChart),
    /// Bars in groups.
    Bar(BarChart),
    /// Distributions in groups.
    Spread(SpreadChart),
    /// Several charts of curves with one legend.
    Panels(PanelChart),
    /// Pictures of a quantity over a plane.
    Raster(RasterChart),
}

impl Figure {
    /// The figure as an SVG document, which is the same on any machine.
    ///
    /// If a name is too long for three lines, the picture shows its beginning. The [CSV](Self::csv)
    /// has the full name.
    ///
    /// # Errors
    /// When a series does not have one value per group, or a picture does not have one value per
    /// cell or does not cover a part of the plane.
    pub fn svg(&self) -> Result<String, PlotError> {
        svg::write(&self.draw()?)
    }

    fn draw(&self) -> Result<Drawing, PlotError> {
        match self {
            Self::Line(chart) => Ok(chart.draw()),
            Self::Bar(chart) => chart.draw(),
            Self::Spread(chart) => chart.draw(),
            Self::Panels(chart) => Ok(chart.draw()),
            Self::Raster(chart) => chart.draw(),
        }
    }

    /// The data of the figure as CSV, with one row per value: `series,x,y`, `panel,series,x,y`,
    /// `group,series,value`, or `panel,x,y,value` at the centre of a cell. A missing value is an
    /// empty field, and an infinite value is `inf` or `-inf`. A span has two rows, one for each
    /// end, with an empty `y`, after the series of its chart. Areas between curves have no rows,
    /// because their edges are curves already.
    pub fn csv(&self) -> String {
        match self {
            Self::Line(chart) => tidy::line(chart),
            Self::Bar(chart) => tidy::bar(chart),
            Self::Spread(chart) => tidy::spread(chart),
            Self::Panels(chart) => tidy::panels(chart),
            Self::Raster(chart) => tidy::raster(chart),
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests;
