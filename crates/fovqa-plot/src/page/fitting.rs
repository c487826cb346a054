//! Fits a figure into the width and height that its style asks for.

use crate::canvas::drawing::Drawing;
use crate::canvas::printed::Printed;
use crate::canvas::text::VALUE_PX;
use crate::error::PlotError;
use crate::limits::LEAST_PT;
use crate::page::paper::Paper;
use crate::page::style::{Height, Style};

/// How often the height of the plot areas is corrected: another height may have other ticks, and
/// these another width, and so a title of more lines.
const TRIES: usize = 8;
/// A height is met if it differs less than this.
const CLOSE_PX: f64 = 1.0;
/// The smallest height of a plot area.
const LEAST_PLOT_HEIGHT_PX: f64 = 48.0;

/// Draws a figure on paper of the size that a style asks for.
pub(crate) fn fit(
    style: &Style,
    draw: impl Fn(&Paper) -> Result<Drawing, PlotError>,
) -> Result<Printed, PlotError> {
    let paper = Paper::new(style);
    let drawing = match style.height {
        Height::Suited => draw(&paper)?,
        Height::Inches(inches) => {
            let wanted_px = |_: &Drawing| inches / paper.inches(1.0);
            with_height(&paper, wanted_px, &draw)?
        }
        Height::Aspect(aspect) => {
            with_height(&paper, |drawing: &Drawing| drawing.width_px / aspect, &draw)?
        }
    };
    let Some(width_in) = style.width_in else {
        return Ok(Printed::new(drawing, paper.pt_per_px));
    };
    let drawing = centred(drawing, paper.column_px);
    // Labels that need more room make everything smaller.
    let pt_per_px = paper.pt_per_px * paper.column_px / drawing.width_px;
    if pt_per_px * VALUE_PX < LEAST_PT * (1.0 - 1e-6) {
        let least_in = width_in * LEAST_PT / (pt_per_px * VALUE_PX);
        return Err(PlotError::Narrow { width_in, least_in: up(least_in) });
    }
    Ok(Printed::new(drawing, pt_per_px))
}

/// Draws with plot areas whose height makes that of the whole figure right.
fn with_height(
    paper: &Paper,
    wanted_px: impl Fn(&Drawing) -> f64,
    draw: impl Fn(&Paper) -> Result<Drawing, PlotError>,
) -> Result<Drawing, PlotError> {
    let mut paper = *paper;
    let mut drawing = draw(&paper)?;
    // How much the figure grows with its plot areas: once for each row of them.
    let step_px = 20.0;
    let rows = ((draw(&paper.higher(step_px))?.height_px - drawing.height_px) / step_px).round();
    for _ in 0..TRIES {
        let wanted = wanted_px(&drawing);
        let missing = wanted - drawing.height_px;
        if missing.abs() < CLOSE_PX {
            break;
        }
        if rows < 1.0 {
            return Err(PlotError::FollowsFromWidth { height_in: paper.inches(wanted) });
        }
        let next = paper.higher(missing / rows);
        if next.plot_height_px.min(next.panel_height_px) < LEAST_PLOT_HEIGHT_PX {
            let least_px = drawing.height_px
                - rows * (paper.plot_height_px.min(paper.panel_height_px) - LEAST_PLOT_HEIGHT_PX);
            return Err(PlotError::Low {
                height_in: round(paper.inches(wanted)),
                least_in: up(paper.inches(least_px)),
            });
        }
        paper = next;
        drawing = draw(&paper)?;
    }
    // What is left is less than a pixel, unless ticks do not settle.
    let wanted = wanted_px(&drawing);
    drawing.height_px = drawing.height_px.max(wanted);
    Ok(drawing)
}

/// A drawing that is narrower than the paper, in its middle.
fn centred(mut drawing: Drawing, width_px: f64) -> Drawing {
    if drawing.width_px < width_px {
        drawing.shift(((width_px - drawing.width_px) / 2.0).floor());
        drawing.width_px = width_px;
    }
    drawing
}

/// Inches with two decimals, rounded up.
fn up(inches: f64) -> f64 {
    (inches * 100.0).ceil() / 100.0
}

fn round(inches: f64) -> f64 {
    (inches * 100.0).round() / 100.0
}
