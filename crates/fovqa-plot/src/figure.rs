//! A figure of any kind.

use crate::canvas::drawing::Drawing;
use crate::canvas::look::Look;
use crate::canvas::printed::Printed;
use crate::charts::bar::BarChart;
use crate::charts::line::LineChart;
use crate::charts::montage::MontageChart;
use crate::charts::panels::PanelChart;
use crate::charts::raster::RasterChart;
use crate::charts::spread::SpreadChart;
use crate::charts::unseen::{self, Unseen};
use crate::error::PlotError;
use crate::page::fitting;
use crate::page::paper::Paper;
use crate::page::style::Style;
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
    /// Pictures side by side.
    Montage(MontageChart),
}

impl Figure {
    /// The figure as it is printed in a style.
    ///
    /// If a name is too long for three lines, the picture shows its beginning. The [CSV](Self::csv)
    /// has the full name.
    ///
    /// # Errors
    /// When a series does not have one value per group, a picture does not have one value per cell
    /// or does not cover a part of the plane, or the figure does not fit into the width or height
    /// that the style asks for.
    pub fn print(&self, style: &Style) -> Result<Printed, PlotError> {
        let styled = self.styled(style);
        fitting::fit(style, |paper| styled.draw(paper))
    }

    /// The same figure with the looks and the title of a style.
    fn styled(&self, style: &Style) -> Self {
        let mut figure = self.clone();
        let look = |look: &mut Look| {
            *look = look.styled(style.palette, style.line_styles, style.markers);
        };
        let title = match &mut figure {
            Self::Line(chart) => {
                chart.looks().for_each(look);
                &mut chart.title
            }
            Self::Bar(chart) => {
                chart.series.iter_mut().for_each(|series| look(&mut series.look));
                &mut chart.title
            }
            Self::Spread(chart) => {
                chart.series.iter_mut().for_each(|series| look(&mut series.look));
                &mut chart.title
            }
            Self::Panels(chart) => {
                chart.panels.iter_mut().flat_map(LineChart::looks).for_each(look);
                &mut chart.title
            }
            Self::Raster(chart) => &mut chart.title,
            Self::Montage(chart) => &mut chart.title,
        };
        if !style.title {
            *title = None;
        }
        figure
    }

    fn draw(&self, paper: &Paper) -> Result<Drawing, PlotError> {
        match self {
            Self::Line(chart) => Ok(chart.draw(paper)),
            Self::Bar(chart) => chart.draw(paper),
            Self::Spread(chart) => chart.draw(paper),
            Self::Panels(chart) => Ok(chart.draw(paper)),
            Self::Raster(chart) => chart.draw(paper),
            Self::Montage(chart) => Ok(chart.draw(paper)),
        }
    }

    /// The charts whose axes were set so that they show none of their values.
    pub fn unseen(&self) -> Vec<Unseen> {
        match self {
            Self::Line(chart) => unseen::of_curves(chart).into_iter().collect(),
            Self::Bar(chart) => unseen::of_bars(chart).into_iter().collect(),
            Self::Spread(chart) => unseen::of_spread(chart).into_iter().collect(),
            Self::Panels(chart) => {
                let panel = |chart: &LineChart| {
                    Some(Unseen { panel: chart.title.clone(), ..unseen::of_curves(chart)? })
                };
                chart.panels.iter().filter_map(panel).collect()
            }
            Self::Raster(_) | Self::Montage(_) => Vec::new(),
        }
    }

    /// The data of the figure as CSV, with one row per value: `series,x,y`, `panel,series,x,y`,
    /// `group,series,value`, `panel,x,y,value` at the centre of a cell, or `row,column` of pictures.
    /// Where there are error bars, a column `error` has half their length. A missing value is an
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
            Self::Montage(chart) => tidy::montage(chart),
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests;
