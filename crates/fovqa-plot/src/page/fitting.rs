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
/// A figure whose layout is up to this factor wider or narrower than a column or a page is printed
/// with exactly that width; the smallest text stays above 6 points.
const SLACK: f64 = 1.12;
/// A step of the height of plot areas, to find out how the figure grows with it.
const PROBE_PX: f64 = 20.0;
/// The smallest height of a plot area.
const LEAST_PLOT_HEIGHT_PX: f64 = 48.0;

/// Draws a figure on paper of the size that a style asks for.
pub(crate) fn fit(
    style: &Style,
    draw: impl Fn(&Paper) -> Result<Drawing, PlotError>,
) -> Result<Printed, PlotError> {
    let paper = Paper::new(style);
    let scale_of = |drawing: &Drawing| scale(style, &paper, drawing);
    let drawing = match style.height {
        Height::Suited => draw(&paper)?,
        Height::Inches(inches) => {
            let wanted_px = |drawing: &Drawing| inches / paper.inches(scale_of(drawing));
            with_height(&paper, (wanted_px, scale_of), &draw)?
        }
        Height::Aspect(aspect) => {
            let wanted_px =
                |drawing: &Drawing| drawing.width_px.max(width_px(style, &paper, drawing)) / aspect;
            with_height(&paper, (wanted_px, scale_of), &draw)?
        }
    };
    let pt_per_px = paper.pt_per_px * scale_of(&drawing);
    let width_px = width_px(style, &paper, &drawing);
    let drawing = centred(drawing, width_px);
    let Some(width_in) = style.width_in else { return Ok(Printed::new(drawing, pt_per_px)) };
    if pt_per_px * VALUE_PX < LEAST_PT * (1.0 - 1e-6) {
        let least_in = width_in * LEAST_PT / (pt_per_px * VALUE_PX);
        return Err(PlotError::Narrow { width_in, least_in: up(least_in) });
    }
    Ok(Printed::new(drawing, pt_per_px))
}

/// The width that a drawing is printed at, in pixels of the paper.
fn width_px(style: &Style, paper: &Paper, drawing: &Drawing) -> f64 {
    if style.width_in.is_some() {
        return paper.column_px;
    }
    // A little more than a column or a page is made as wide as it, with smaller text.
    let close = |usual: &f64| (usual / SLACK..=usual * SLACK).contains(&drawing.width_px);
    let usual = [paper.column_px, paper.page_px].into_iter().find(close);
    usual.unwrap_or(drawing.width_px)
}

/// How much smaller a drawing is printed than it was laid out: labels that need more room than the
/// width has make everything smaller.
fn scale(style: &Style, paper: &Paper, drawing: &Drawing) -> f64 {
    (width_px(style, paper, drawing) / drawing.width_px).min(1.0)
}

/// Draws with plot areas whose height makes that of the whole figure right.
fn with_height(
    paper: &Paper,
    (wanted_px, scale): (impl Fn(&Drawing) -> f64, impl Fn(&Drawing) -> f64),
    draw: impl Fn(&Paper) -> Result<Drawing, PlotError>,
) -> Result<Drawing, PlotError> {
    let of_height = |height_px: f64| draw(&paper.with_plot_height(height_px));
    let mut height_px = paper.plot_height_px;
    let mut drawing = of_height(height_px)?;
    // How much the figure grows with its plot areas: once for each row of them.
    let rows =
        ((of_height(height_px + PROBE_PX)?.height_px - drawing.height_px) / PROBE_PX).round();
    if rows < 1.0 {
        let height_in = paper.inches(wanted_px(&drawing));
        return Err(PlotError::FollowsFromWidth { height_in });
    }
    for _ in 0..TRIES {
        let wanted = wanted_px(&drawing);
        let missing = wanted - drawing.height_px;
        if missing.abs() < CLOSE_PX {
            break;
        }
        // Ticks and labels change with the height, so the smallest one is tried before it is refused.
        height_px = (height_px + missing / rows).max(LEAST_PLOT_HEIGHT_PX);
        drawing = of_height(height_px)?;
        let beyond = drawing.height_px - wanted_px(&drawing);
        if height_px <= LEAST_PLOT_HEIGHT_PX && beyond >= CLOSE_PX {
            let inches = |px: f64| paper.inches(px * scale(&drawing));
            return Err(PlotError::Low {
                height_in: round(inches(wanted_px(&drawing))),
                least_in: up(inches(drawing.height_px)),
            });
        }
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
