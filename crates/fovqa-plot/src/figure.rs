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
    /// The figure as an SVG document: the same text for the same figure, on any machine.
    ///
    /// Of a name too long for three lines the picture shows the beginning; the [CSV](Self::csv)
    /// has all of it.
    ///
    /// # Errors
    /// When a series does not have one value for each group, or a picture one for each cell of a
    /// part of the plane.
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

    /// The data of the figure as CSV, a row for each value: `series,x,y`, `panel,series,x,y`,
    /// `group,series,value`, or `panel,x,y,value` at the middle of a cell. A missing value is an empty field, an infinite one `inf` or `-inf`. A
    /// span has two rows, one for each end, with an empty `y`, after the series of its chart. Areas
    /// between curves have none: their edges are curves already.
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
