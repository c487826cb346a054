//! A drawing is a list of marks in pixels, before it is written as SVG. Charts add marks to it, and
//! tests check their positions.

use crate::canvas::bitmap::Bitmap;
use crate::canvas::colour::{Colour, INK};
use crate::canvas::photo::Photo;
#[cfg(test)]
use crate::canvas::text::{CAPITAL, DESCENT, width_px};

/// A point in pixels, x to the right and y down.
pub(crate) type Point = (f64, f64);

/// A rectangle in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Rect {
    pub(crate) fn width(self) -> f64 {
        self.right - self.left
    }

    pub(crate) fn height(self) -> f64 {
        self.bottom - self.top
    }

    pub(crate) fn centre(self) -> Point {
        (self.left.midpoint(self.right), self.top.midpoint(self.bottom))
    }

    /// The corners in clockwise order, starting with the upper left one.
    pub(crate) fn corners(self) -> [Point; 4] {
        [
            (self.left, self.top),
            (self.right, self.top),
            (self.right, self.bottom),
            (self.left, self.bottom),
        ]
    }

    /// Whether two rectangles overlap in more than an edge.
    pub(crate) fn overlaps(self, other: Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }
}

/// The colour and width in pixels of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) colour: Colour,
    pub(crate) width_px: f64,
}

/// The part of a text that is at its anchor point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// One line of text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Text {
    pub(crate) line: String,
    /// The anchor point on the baseline.
    pub(crate) at: Point,
    pub(crate) size_px: f64,
    pub(crate) anchor: Anchor,
    /// Whether the text is rotated to read upwards.
    pub(crate) upwards: bool,
    pub(crate) colour: Colour,
}

impl Text {
    /// A horizontal line of text in ink.
    pub(crate) fn new(line: impl Into<String>, at: Point, size_px: f64, anchor: Anchor) -> Self {
        Self { line: line.into(), at, size_px, anchor, upwards: false, colour: INK }
    }

    /// The same text, rotated around its anchor to read upwards.
    pub(crate) fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }

    /// The area that the text covers.
    #[cfg(test)]
    pub(crate) fn bounds(&self) -> Rect {
        let width = width_px(&self.line, self.size_px);
        let start = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -width / 2.0,
            Anchor::End => -width,
        };
        let (up, down) = (CAPITAL * self.size_px, DESCENT * self.size_px);
        let (x, y) = self.at;
        if self.upwards {
            Rect { left: x - up, top: y - start - width, right: x + down, bottom: y - start }
        } else {
            Rect { left: x + start, top: y - up, right: x + start + width, bottom: y + down }
        }
    }
}

/// One drawn element.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Mark {
    /// A line through these points.
    Line(Vec<Point>, Stroke),
    /// A filled area.
    Area(Vec<Point>, Colour),
    /// A filled disc with a centre and a radius.
    Disc(Point, f64, Colour),
    /// A picture that fills a rectangle.
    Picture(Rect, Bitmap),
    /// A picture of colours that fills a rectangle.
    Photo(Rect, Photo),
    /// A line of text.
    Text(Text),
}

/// A drawing: its size and its marks.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drawing {
    pub(crate) width_px: f64,
    pub(crate) height_px: f64,
    /// The marks in drawing order; the first one is behind all others.
    pub(crate) marks: Vec<Mark>,
}

impl Drawing {
    pub(crate) fn line(&mut self, points: &[Point], stroke: Stroke) {
        self.marks.push(Mark::Line(points.to_vec(), stroke));
    }

    /// Adds a line of alternating strokes and gaps of the given lengths. Without lengths it is
    /// solid.
    pub(crate) fn dashed(&mut self, points: &[Point], stroke: Stroke, dash_px: &[f64]) {
        if dash_px.iter().sum::<f64>() <= 0.0 {
            return self.line(points, stroke);
        }
        for piece in dashes(points, dash_px) {
            self.line(&piece, stroke);
        }
    }

    pub(crate) fn area(&mut self, points: Vec<Point>, colour: Colour) {
        self.marks.push(Mark::Area(points, colour));
    }

    pub(crate) fn disc(&mut self, centre: Point, radius_px: f64, colour: Colour) {
        self.marks.push(Mark::Disc(centre, radius_px, colour));
    }

    pub(crate) fn picture(&mut self, rect: Rect, bitmap: Bitmap) {
        self.marks.push(Mark::Picture(rect, bitmap));
    }

    pub(crate) fn photo(&mut self, rect: Rect, photo: Photo) {
        self.marks.push(Mark::Photo(rect, photo));
    }

    pub(crate) fn text(&mut self, text: Text) {
        if !text.line.is_empty() {
            self.marks.push(Mark::Text(text));
        }
    }

    /// Adds a filled rectangle with an edge.
    pub(crate) fn rect(&mut self, rect: Rect, fill: Colour, edge: Stroke) {
        self.area(rect.corners().to_vec(), fill);
        self.frame(rect, edge);
    }

    /// Adds the edge of a rectangle.
    pub(crate) fn frame(&mut self, rect: Rect, edge: Stroke) {
        let corners = rect.corners();
        // The first line is drawn twice, so that the last joint is as square as the others.
        self.line(&[&corners[..], &corners[..2]].concat(), edge);
    }

    /// Moves all marks to the right.
    pub(crate) fn shift(&mut self, right_px: f64) {
        self.shift_from(0, right_px);
    }

    /// Moves the marks from this number on to the right.
    pub(crate) fn shift_from(&mut self, first: usize, right_px: f64) {
        for mark in self.marks.iter_mut().skip(first) {
            match mark {
                Mark::Line(points, _) | Mark::Area(points, _) => {
                    for point in points {
                        point.0 += right_px;
                    }
                }
                Mark::Disc(centre, ..) => centre.0 += right_px,
                Mark::Picture(rect, _) | Mark::Photo(rect, _) => {
                    rect.left += right_px;
                    rect.right += right_px;
                }
                Mark::Text(text) => text.at.0 += right_px,
            }
        }
    }

    #[cfg(test)]
    pub(crate) fn texts(&self) -> Vec<&Text> {
        self.marks
            .iter()
            .filter_map(|mark| if let Mark::Text(text) = mark { Some(text) } else { None })
            .collect()
    }
}

/// The strokes of a dashed line. Dashes continue around corners.
fn dashes(points: &[Point], dash_px: &[f64]) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<Point> = points.first().copied().into_iter().collect();
    let (mut phase, mut left) = (0, dash_px[0]);
    for ends in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (ends[0], ends[1]);
        let length = (x1 - x0).hypot(y1 - y0);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let at = (x0 + (x1 - x0) * done / length, y0 + (y1 - y0) * done / length);
            if phase % 2 == 0 {
                piece.push(at);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![at];
            }
            phase = (phase + 1) % dash_px.len();
            left = dash_px[phase];
        }
        left -= length - done;
        if phase % 2 == 0 {
            piece.push((x1, y1));
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn dashes_run_around_corners() {
        let pieces = dashes(&[(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)], &[4.0, 2.0]);
        let want = [vec![(0.0, 0.0), (4.0, 0.0)], vec![(5.0, 1.0), (5.0, 5.0)]];
        assert_eq!(pieces, want);
        let around = dashes(&[(0.0, 0.0), (3.0, 0.0), (3.0, 3.0)], &[4.0, 2.0]);
        assert_eq!(around, [[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0)]]);
    }

    #[test]
    fn text_knows_its_bounds() {
        let level = Text::new("00", (50.0, 40.0), 10.0, Anchor::Middle);
        let width = width_px("00", 10.0);
        let bounds = level.bounds();
        assert!((bounds.left - (50.0 - width / 2.0)).abs() < 1e-9 && bounds.top < 33.0);
        let upright = Text::new("00", (50.0, 40.0), 10.0, Anchor::Start).upwards().bounds();
        assert!((upright.top - (40.0 - width)).abs() < 1e-9 && upright.bottom == 40.0);
        assert!(upright.left < 43.0 && upright.right > 50.0);
        assert!(
            bounds.overlaps(upright)
                && !bounds.overlaps(Rect { left: 90.0, right: 95.0, ..bounds })
        );
    }
}
