//! Writes a drawing as a PDF of one page, with its text as text in the bundled font, and pictures
//! whose cells are not smoothed. The bytes are the same on every machine: there is no date in it.

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::LineJoinStyle;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect as PdfRect, Ref, Str, TextStr};

use crate::canvas::colour::Colour;
use crate::canvas::colour_map::palette;
use crate::canvas::drawing::{Drawing, Mark, Point, Text};
use crate::canvas::pdf_font::Embedded;
use crate::canvas::setting::SetLine;
use crate::error::PlotError;

/// How hard streams are compressed, from 0 to 10.
const LEVEL: u8 = 8;
/// The name of the font in the page's resources.
const FONT_NAME: Name<'static> = Name(b"F");
/// A circle is four curves whose handles have this length, as a share of the radius.
const HANDLE: f64 = 0.552_284_8;

/// Writes the drawing, with its lines of text as they are set, as a complete PDF with `pt_per_px`
/// points per pixel and a title for the properties of the document.
pub(crate) fn write(
    drawing: &Drawing,
    lines: &[SetLine],
    (pt_per_px, title): (f64, &str),
) -> Result<Vec<u8>, PlotError> {
    let mut lines = lines.iter();
    let mut next = Ref::new(1);
    let [catalogue, pages, page, contents, info] = [(); 5].map(|()| next.bump());
    let mut font = Embedded::default();
    let mut pictures: Vec<(Ref, &Mark)> = Vec::new();

    let mut content = Content::new();
    let (width, height) = (drawing.width_px * pt_per_px, drawing.height_px * pt_per_px);
    // Pixels count from the top, points from the bottom.
    content.transform([short(pt_per_px), 0.0, 0.0, -short(pt_per_px), 0.0, short(height)]);
    content.set_line_join(LineJoinStyle::RoundJoin);
    for mark in &drawing.marks {
        match mark {
            Mark::Line(points, stroke) => {
                let [r, g, b] = rgb(stroke.colour);
                content.set_stroke_rgb(r, g, b).set_line_width(short(stroke.width_px));
                path(&mut content, points);
                content.stroke();
            }
            Mark::Area(points, colour) => {
                let [r, g, b] = rgb(*colour);
                content.set_fill_rgb(r, g, b);
                path(&mut content, points);
                content.close_path().fill_nonzero();
            }
            Mark::Disc(centre, radius_px, colour) => {
                let [r, g, b] = rgb(*colour);
                content.set_fill_rgb(r, g, b);
                circle(&mut content, *centre, *radius_px);
                content.fill_nonzero();
            }
            Mark::Picture(rect, _) | Mark::Photo(rect, _) => {
                let name = picture_name(pictures.len());
                pictures.push((next.bump(), mark));
                content.save_state();
                let (w, h) = (short(rect.width()), short(rect.height()));
                content.transform([w, 0.0, 0.0, -h, short(rect.left), short(rect.bottom)]);
                content.x_object(Name(&name)).restore_state();
            }
            Mark::Text(text) => {
                let Some(line) = lines.next() else { unreachable!("each text was set") };
                write_text(&mut content, &mut font, text, line);
            }
        }
    }
    let content = compress_to_vec_zlib(&content.finish(), LEVEL);

    let mut pdf = Pdf::new();
    pdf.catalog(catalogue).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    pdf.document_info(info).title(TextStr(title)).producer(TextStr("fovqa"));
    let mut leaf = pdf.page(page);
    leaf.media_box(PdfRect::new(0.0, 0.0, short(width), short(height)));
    leaf.parent(pages).contents(contents);
    let mut resources = leaf.resources();
    let font_ref = next.bump();
    if !font.is_empty() {
        resources.fonts().pair(FONT_NAME, font_ref);
    }
    if !pictures.is_empty() {
        let mut objects = resources.x_objects();
        for (i, (picture, _)) in pictures.iter().enumerate() {
            objects.pair(Name(&picture_name(i)), *picture);
        }
    }
    resources.finish();
    leaf.finish();
    pdf.stream(contents, &content).filter(Filter::FlateDecode);
    for (picture, mark) in &pictures {
        write_picture(&mut pdf, *picture, mark);
    }
    if !font.is_empty() {
        font.write(&mut pdf, font_ref, &mut next)?;
    }
    Ok(pdf.finish())
}

fn path(content: &mut Content, points: &[Point]) {
    for (i, (x, y)) in points.iter().enumerate() {
        if i == 0 {
            content.move_to(short(*x), short(*y));
        } else {
            content.line_to(short(*x), short(*y));
        }
    }
}

fn circle(content: &mut Content, (x, y): Point, r: f64) {
    let h = r * HANDLE;
    content.move_to(short(x + r), short(y));
    for [(ax, ay), (bx, by), (ex, ey)] in [
        [(r, h), (h, r), (0.0, r)],
        [(-h, r), (-r, h), (-r, 0.0)],
        [(-r, -h), (-h, -r), (0.0, -r)],
        [(h, -r), (r, -h), (r, 0.0)],
    ] {
        let [a, b, e] = [(x + ax, y + ay), (x + bx, y + by), (x + ex, y + ey)];
        content.cubic_to(short(a.0), short(a.1), short(b.0), short(b.1), short(e.0), short(e.1));
    }
    content.close_path();
}

/// Writes a line of text. Each glyph has the position that it has in the PNG.
fn write_text(content: &mut Content, font: &mut Embedded, text: &Text, line: &SetLine) {
    let [r, g, b] = rgb(text.colour);
    let whole = !line.is_complete();
    if whole {
        // Characters that the font lacks can still be copied from the page.
        content
            .begin_marked_content_with_properties(Name(b"Span"))
            .properties()
            .actual_text(TextStr(&text.line));
    }
    content.set_fill_rgb(r, g, b);
    content.begin_text();
    content.set_font(FONT_NAME, short(text.size_px));
    let (x, y) = text.at;
    for run in line.glyphs.chunk_by(|a, b| a.y_em.to_bits() == b.y_em.to_bits()) {
        let (along, up) = (run[0].x_em * text.size_px, run[0].y_em * text.size_px);
        content.set_text_matrix(if text.upwards {
            [0.0, -1.0, -1.0, 0.0, short(x - up), short(y - along)]
        } else {
            [1.0, 0.0, 0.0, -1.0, short(x + along), short(y - up)]
        });
        let mut shown = content.show_positioned();
        let mut items = shown.items();
        let mut reached = run[0].x_em;
        let mut codes: Vec<u8> = Vec::new();
        for glyph in run {
            let (code, advance_em) = font.add(glyph);
            // Thousandths of the font size, to the left.
            let back = ((reached - glyph.x_em) * 1000.0).round();
            if back != 0.0 {
                items.show(Str(&codes)).adjust(back as f32);
                codes.clear();
                reached -= back / 1000.0;
            }
            codes.extend(code.to_be_bytes());
            reached += advance_em;
        }
        items.show(Str(&codes));
    }
    content.end_text();
    if whole {
        content.end_marked_content();
    }
}

fn write_picture(pdf: &mut Pdf, picture: Ref, mark: &Mark) {
    let (columns, rows, samples, palette) = match mark {
        Mark::Picture(rect, bitmap) => {
            let (columns, rows, levels) = bitmap.enlarged((rect.width(), rect.height()));
            let colours = palette().into_iter().flat_map(|Colour(r, g, b)| [r, g, b]);
            (columns, rows, levels, Some(colours.collect::<Vec<u8>>()))
        }
        Mark::Photo(rect, photo) => {
            let (columns, rows, samples) = photo.enlarged(rect.width());
            (columns, rows, samples, None)
        }
        Mark::Line(..) | Mark::Area(..) | Mark::Disc(..) | Mark::Text(..) => return,
    };
    let samples = compress_to_vec_zlib(&samples, LEVEL);
    let mut object = pdf.image_xobject(picture, &samples);
    object.filter(Filter::FlateDecode);
    object.width(columns as i32).height(rows as i32);
    match palette {
        Some(colours) => {
            let highest = colours.len() as i32 / 3 - 1;
            object.color_space().indexed(Name(b"DeviceRGB"), highest, &colours);
        }
        None => object.color_space().device_rgb(),
    }
    object.bits_per_component(8).interpolate(false);
}

fn picture_name(index: usize) -> Vec<u8> {
    format!("P{index}").into_bytes()
}

fn rgb(Colour(r, g, b): Colour) -> [f32; 3] {
    [r, g, b].map(|c| short(f64::from(c) / 255.0))
}

/// A number with at most four decimals, which is finer than any printer.
fn short(value: f64) -> f32 {
    ((value * 1e4).round() / 1e4) as f32
}

#[cfg(test)]
mod tests {
    use miniz_oxide::inflate::decompress_to_vec_zlib;

    use super::*;
    use crate::canvas::drawing::{Anchor, Rect, Stroke};
    use crate::canvas::photo::Photo;
    use crate::canvas::printed::Printed;
    use crate::canvas::text::width_px;

    /// The instructions of the page, as text.
    fn page(marks: Vec<Mark>) -> String {
        let drawing = Drawing { width_px: 48.0, height_px: 32.0, marks };
        let pdf = Printed::new(drawing, 0.75).pdf("title").unwrap();
        let find = |what: &[u8], from: usize| {
            from + pdf[from..].windows(what.len()).position(|part| part == what).unwrap()
        };
        let begin = find(b"stream\n", find(b"4 0 obj", 0)) + 7;
        let content = decompress_to_vec_zlib(&pdf[begin..find(b"endstream", begin)]).unwrap();
        String::from_utf8_lossy(&content).into_owned()
    }

    #[test]
    fn pixels_count_from_the_top() {
        let stroke = Stroke { colour: Colour(255, 0, 51), width_px: 2.0 };
        let page = page(vec![Mark::Line(vec![(1.0, 2.0), (10.5, 20.25)], stroke)]);
        assert!(page.starts_with("0.75 0 0 -0.75 0 24 cm"), "{page}");
        assert!(page.contains("1 0 0.2 RG\n2 w\n1 2 m\n10.5 20.25 l\nS"), "{page}");
    }

    #[test]
    fn text_stands_where_it_stands_in_the_png() {
        let text = |anchor| Text::new("00", (20.0, 30.0), 10.0, anchor);
        let width = width_px("00", 10.0);
        for (anchor, x) in [(Anchor::Start, 20.0), (Anchor::End, 20.0 - width)] {
            let page = page(vec![Mark::Text(text(anchor))]);
            let matrix = page.lines().find(|line| line.ends_with("Tm")).unwrap().to_owned();
            let numbers: Vec<f64> =
                matrix.split(' ').filter_map(|word| word.parse().ok()).collect();
            assert_eq!(numbers[..4], [1.0, 0.0, 0.0, -1.0]);
            let off = (numbers[4] - x).abs() + (numbers[5] - 30.0).abs();
            assert!(off < 0.01, "{matrix}");
        }
        let page = page(vec![Mark::Text(text(Anchor::Start).upwards())]);
        assert!(page.contains("0 -1 -1 0 20 30 Tm"), "{page}");
    }

    #[test]
    fn a_picture_fills_its_rectangle_upright() {
        let rect = Rect { left: 5.0, top: 8.0, right: 25.0, bottom: 18.0 };
        let page = page(vec![Mark::Photo(rect, Photo { width: 1, rgb: vec![[9; 3]] })]);
        assert!(page.contains("20 0 0 -10 5 18 cm\n/P0 Do"), "{page}");
    }
}
