//! Writes a drawing as SVG with plotters.

use std::error::Error;

use plotters::backend::{DrawingBackend, SVGBackend};
use plotters::style::{RGBColor, ShapeStyle};

use crate::canvas::colour::{Colour, WHITE};
use crate::canvas::drawing::{Drawing, Mark, Point, Rect, Stroke};
use crate::canvas::setting::SetLine;
use crate::canvas::svg_text::Outlines;
use crate::error::PlotError;

/// plotters writes whole numbers. This many units per pixel make positions exact to a tenth of a
/// pixel.
const UNITS: f64 = 10.0;

/// The end of a document.
const END: &str = "</svg>";

/// Writes the drawing on white paper, with its lines of text as they are set, as a complete SVG
/// document that is printed with this many points per pixel.
pub(crate) fn write(
    drawing: &Drawing,
    lines: &[SetLine],
    pt_per_px: f64,
) -> Result<String, PlotError> {
    write_on(Some(WHITE), drawing, lines, pt_per_px)
}

/// Writes the drawing as [`write`] does, on paper of a colour or on nothing.
pub(crate) fn write_on(
    paper: Option<Colour>,
    drawing: &Drawing,
    lines: &[SetLine],
    pt_per_px: f64,
) -> Result<String, PlotError> {
    let mut lines = lines.iter();
    let size = (units(drawing.width_px) as u32, units(drawing.height_px) as u32);
    let corner = (size.0 as i32, size.1 as i32);
    let mut body = elements(size, |backend| match paper {
        Some(paper) => backend.draw_rect((0, 0), corner, &filled(paper), true).map_err(refused),
        None => Ok(()),
    })?;
    let mut outlines = Outlines::default();
    for marks in drawing.marks.chunk_by(|a, b| by_plotters(a) == by_plotters(b)) {
        if by_plotters(&marks[0]) {
            body +=
                &elements(size, |backend| marks.iter().try_for_each(|mark| draw(backend, mark)))?;
            continue;
        }
        for mark in marks {
            match mark {
                Mark::Picture(rect, bitmap) => {
                    let uri = bitmap.data_uri((rect.width(), rect.height()))?;
                    write_picture(&mut body, *rect, &uri);
                }
                Mark::Photo(rect, photo) => {
                    write_picture(&mut body, *rect, &photo.data_uri(rect.width())?);
                }
                Mark::Text(text) => {
                    let Some(line) = lines.next() else { unreachable!("each text was set") };
                    outlines.write(&mut body, (text, line), UNITS);
                }
                Mark::Line(..) | Mark::Area(..) | Mark::Disc(..) => {}
            }
        }
    }
    let inches = |px: f64| (px * pt_per_px / 72.0 * 1e4).round() / 1e4;
    let printed = (inches(drawing.width_px), inches(drawing.height_px));
    Ok(with_header(&(outlines.definitions() + &body), printed, size))
}

/// Whether plotters writes a mark. It cannot write pictures, and would leave text to the fonts of
/// the viewer.
fn by_plotters(mark: &Mark) -> bool {
    matches!(mark, Mark::Line(..) | Mark::Area(..) | Mark::Disc(..))
}

/// The output of plotters for a drawing, without the surrounding element.
fn elements(
    size: (u32, u32),
    draw: impl FnOnce(&mut SVGBackend<'_>) -> Result<(), PlotError>,
) -> Result<String, PlotError> {
    let mut svg = String::new();
    let mut backend = SVGBackend::with_string(&mut svg, size);
    draw(&mut backend)?;
    backend.present().map_err(refused)?;
    drop(backend);
    let body = svg.split_once('\n').map_or("", |(_, body)| body);
    Ok(body.trim_end().strip_suffix(END).unwrap_or(body).to_owned())
}

/// Writes a picture, which plotters does not support. Both notations for pixels without
/// interpolation are written, and the older notation for references, because programs differ in
/// what they support.
fn write_picture(body: &mut String, rect: Rect, uri: &str) {
    let ((left, top), (right, bottom)) =
        (place((rect.left, rect.top)), place((rect.right, rect.bottom)));
    let (width, height) = (right - left, bottom - top);
    let element = format!(
        "<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" \
         preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\" \
         style=\"image-rendering:pixelated\" \
         xlink:href=\"{uri}\"/>\n"
    );
    body.push_str(&element);
}

/// The document with its size in inches and its own units. Corners of lines are rounded, because a
/// sharp turn of a curve would have a spike.
fn with_header(body: &str, printed_in: (f64, f64), (width, height): (u32, u32)) -> String {
    format!(
        "<svg width=\"{}in\" height=\"{}in\" viewBox=\"0 0 {width} {height}\" \
         stroke-linejoin=\"round\" xmlns=\"http://www.w3.org/2000/svg\" \
         xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n{body}{END}\n",
        printed_in.0, printed_in.1
    )
}

fn draw(backend: &mut SVGBackend<'_>, mark: &Mark) -> Result<(), PlotError> {
    let drawn = match mark {
        Mark::Line(points, stroke) => {
            backend.draw_path(points.iter().map(|&p| place(p)), &stroked(*stroke))
        }
        Mark::Area(points, colour) => {
            backend.fill_polygon(points.iter().map(|&p| place(p)), &filled(*colour))
        }
        Mark::Disc(centre, radius_px, colour) => {
            backend.draw_circle(place(*centre), units(*radius_px) as u32, &filled(*colour), true)
        }
        Mark::Text(..) | Mark::Picture(..) | Mark::Photo(..) => return Ok(()),
    };
    drawn.map_err(refused)
}

fn refused(error: impl Error + Send + Sync + 'static) -> PlotError {
    PlotError::Draw(Box::new(error))
}

fn units(px: f64) -> f64 {
    (px * UNITS).round()
}

fn place((x, y): Point) -> (i32, i32) {
    (units(x) as i32, units(y) as i32)
}

fn rgb(Colour(r, g, b): Colour) -> RGBColor {
    RGBColor(r, g, b)
}

fn filled(colour: Colour) -> ShapeStyle {
    ShapeStyle::from(&rgb(colour)).filled()
}

fn stroked(stroke: Stroke) -> ShapeStyle {
    ShapeStyle::from(&rgb(stroke.colour)).stroke_width(units(stroke.width_px) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::drawing::{Anchor, Text};
    use crate::canvas::printed::Printed;

    fn with_text(line: &str) -> String {
        let text = Text::new(line, (10.0, 20.0), 12.0, Anchor::Start);
        let drawing = Drawing { width_px: 48.0, height_px: 32.0, marks: vec![Mark::Text(text)] };
        Printed::new(drawing, 0.75).svg().unwrap()
    }

    #[test]
    fn escapes_text() {
        let svg = with_text("A & B <x> \"q\" 'r'");
        assert!(svg.contains("A &amp; B &lt;x&gt; &quot;q&quot; &apos;r&apos;"), "{svg}");
    }

    #[test]
    fn needs_no_installed_font() {
        let svg = with_text("xx עברית");
        assert!(!svg.contains("<text") && svg.contains("aria-label=\"xx עברית\""), "{svg}");
        // Two letters share one outline, and the second one is to the right of the first.
        assert_eq!(svg.matches("<use xlink:href=\"#g91\"").count(), 2, "{svg}");
        assert!(
            svg.contains("<path id=\"g91\" d=\"M") && svg.contains("#g91\" x=\"1212\""),
            "{svg}"
        );
        // The font has no ideographs.
        let foreign = with_text("注視");
        assert!(
            foreign.contains("DejaVu Sans, Verdana, sans-serif")
                && foreign.contains(">注視</text>")
        );
    }

    #[test]
    fn has_its_size_in_print() {
        let svg = with_text("x");
        let head = "<svg width=\"0.5in\" height=\"0.3333in\" viewBox=\"0 0 480 320\"";
        assert!(svg.starts_with(head) && svg.trim_end().ends_with("</svg>"), "{svg}");
    }

    #[test]
    fn text_stands_on_its_baseline() {
        let text = Text::new("x", (20.0, 30.0), 10.0, Anchor::Start);
        let marks = vec![Mark::Text(text.clone()), Mark::Text(text.upwards())];
        let drawing = Drawing { width_px: 48.0, height_px: 32.0, marks };
        let svg = Printed::new(drawing, 0.75).svg().unwrap();
        let scale = format!("scale({0:.5} -{0:.5})", 100.0 / 2048.0);
        assert!(svg.contains(&format!("translate(200 300) {scale}")), "{svg}");
        assert!(svg.contains(&format!("translate(200 300) rotate(-90) {scale}")), "{svg}");
    }
}
