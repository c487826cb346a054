//! Writes a drawing as SVG with plotters.

use std::error::Error;

use plotters::backend::{DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontTransform, IntoFont, RGBColor, ShapeStyle, TextStyle};

use crate::canvas::drawing::{Anchor, Drawing, Mark, Point, Stroke, Text};
use crate::canvas::look::{Colour, WHITE};
use crate::canvas::text::FAMILIES;
use crate::error::PlotError;

/// plotters writes whole numbers. This many units per pixel make positions exact to a tenth of a
/// pixel.
const UNITS: f64 = 10.0;

/// plotters divides font sizes by this number when it writes them.
const FONT_FACTOR: f64 = 1.24;

/// The end of a document.
const END: &str = "</svg>";

/// plotters places the baseline of a text this far below the given point, in units of the font
/// size.
const TOP_TO_BASELINE: f64 = 0.76;

/// Writes the drawing as a complete SVG document.
pub(crate) fn write(drawing: &Drawing) -> Result<String, PlotError> {
    let size = (units(drawing.width_px) as u32, units(drawing.height_px) as u32);
    let paper = (size.0 as i32, size.1 as i32);
    let mut body = elements(size, |backend| {
        backend.draw_rect((0, 0), paper, &filled(WHITE), true).map_err(refused)
    })?;
    let is_picture = |mark: &Mark| matches!(mark, Mark::Picture(..));
    for marks in drawing.marks.chunk_by(|a, b| is_picture(a) == is_picture(b)) {
        if is_picture(&marks[0]) {
            marks.iter().try_for_each(|mark| write_picture(&mut body, mark))?;
        } else {
            body +=
                &elements(size, |backend| marks.iter().try_for_each(|mark| draw(backend, mark)))?;
        }
    }
    Ok(with_header(&body, drawing, size))
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
fn write_picture(body: &mut String, mark: &Mark) -> Result<(), PlotError> {
    let Mark::Picture(rect, bitmap) = mark else { return Ok(()) };
    let ((left, top), (right, bottom)) =
        (place((rect.left, rect.top)), place((rect.right, rect.bottom)));
    let (width, height) = (right - left, bottom - top);
    let uri = bitmap.data_uri((rect.width(), rect.height()))?;
    let element = format!(
        "<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" \
         preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\" \
         style=\"image-rendering:pixelated\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         xlink:href=\"{uri}\"/>\n"
    );
    body.push_str(&element);
    Ok(())
}

/// The document with its size in pixels and its own units. Corners of lines are rounded, because a
/// sharp turn of a curve would have a spike.
fn with_header(body: &str, drawing: &Drawing, (width, height): (u32, u32)) -> String {
    format!(
        "<svg width=\"{}\" height=\"{}\" viewBox=\"0 0 {width} {height}\" \
         stroke-linejoin=\"round\" xmlns=\"http://www.w3.org/2000/svg\">\n{body}{END}\n",
        drawing.width_px, drawing.height_px
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
        Mark::Text(text) => return draw_text(backend, text),
        Mark::Picture(..) => return Ok(()),
    };
    drawn.map_err(refused)
}

fn draw_text(backend: &mut SVGBackend<'_>, text: &Text) -> Result<(), PlotError> {
    let down = TOP_TO_BASELINE * text.size_px;
    let (x, y) = text.at;
    let (at, turn) = if text.upwards {
        ((x - down, y), FontTransform::Rotate270)
    } else {
        ((x, y - down), FontTransform::None)
    };
    let h_pos = match text.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let font = (FAMILIES, text.size_px * UNITS * FONT_FACTOR).into_font().transform(turn);
    let colour = rgb(text.colour);
    let style = TextStyle::from(font).pos(Pos::new(h_pos, VPos::Top)).color(&colour);
    backend.draw_text(&text.line, &style, place(at)).map_err(refused)
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

    fn with_text(line: &str) -> String {
        let text = Text::new(line, (10.0, 20.0), 12.0, Anchor::Start);
        let drawing = Drawing { width_px: 48.0, height_px: 32.0, marks: vec![Mark::Text(text)] };
        write(&drawing).unwrap()
    }

    #[test]
    fn escapes_text() {
        let svg = with_text("A & B <x> \"q\" 'r'");
        assert!(svg.contains("A &amp; B &lt;x&gt; &quot;q&quot; &apos;r&apos;"), "{svg}");
        assert!(with_text("注視 עברית").contains("注視 עברית"));
    }

    #[test]
    fn has_its_size_and_font() {
        let svg = with_text("x");
        assert!(
            svg.starts_with("<svg width=\"48\" height=\"32\" viewBox=\"0 0 480 320\""),
            "{svg}"
        );
        assert!(svg.contains("font-family=\"DejaVu Sans, Verdana, sans-serif\""), "{svg}");
        assert!(
            svg.contains("font-size=\"120.0000000") && svg.trim_end().ends_with("</svg>"),
            "{svg}"
        );
    }

    #[test]
    fn text_stands_on_its_baseline() {
        // The baseline is 0.76 of 10 px further down or, for rotated text, further to the right.
        let text = Text::new("x", (20.0, 30.0), 10.0, Anchor::Start);
        let marks = vec![Mark::Text(text.clone()), Mark::Text(text.upwards())];
        let svg = write(&Drawing { width_px: 48.0, height_px: 32.0, marks }).unwrap();
        assert!(svg.contains("<text x=\"200\" y=\"224\" dy=\"0.76em\""), "{svg}");
        assert!(svg.contains("<text x=\"124\" y=\"300\" dy=\"0.76em\""), "{svg}");
        assert!(svg.contains("rotate(270, 124, 300)"), "{svg}");
    }
}
