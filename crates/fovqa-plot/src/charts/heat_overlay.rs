//! Rings and the gaze over a heat map: light lines with a dark edge, so that they are visible on
//! every colour. They are drawn once and then laid over many maps.

use resvg::tiny_skia::PremultipliedColorU8;

use crate::canvas::colour::{INK, WHITE};
use crate::canvas::drawing::{Anchor, Drawing, Point, Rect, Stroke, Text};
use crate::canvas::printed::{PT_PER_PX, Printed};
use crate::canvas::text::{CAPITAL, VALUE_PX, width_px};
use crate::canvas::wrap::clean;
use crate::error::PlotError;

/// Widths of lines, for a unit of 1.
const RING_EDGE_PX: f64 = 1.7;
const RING_CORE_PX: f64 = 0.7;
const CROSS_EDGE_PX: f64 = 3.0;
const CROSS_CORE_PX: f64 = 1.3;
/// Widths of lines in pixels below which they would be hard to see.
const LEAST_EDGE_PX: f64 = 2.4;
const LEAST_CORE_PX: f64 = 1.0;
/// The length of each arm of the cross.
const ARM_PX: f64 = 7.0;
/// The width of a label's edge, and the distance from its text to the edge.
const LABEL_EDGE_PX: f64 = 0.6;
const PADDING_PX: f64 = 2.0;
/// Distance between labels, and from them to the border.
const APART_PX: f64 = 2.0;
/// The largest angle by which a label evades another one, in radians, seen from the gaze.
const MOST_EVASION: f64 = 0.05;

/// A ring of equal eccentricity, in pixels of the frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HeatRing {
    /// Its label, such as "10°".
    pub label: String,
    /// Its lines. Only the part within the frame is visible.
    pub lines: Vec<Vec<[f64; 2]>>,
}

/// The pixels of the drawing that are not empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct HeatOverlay {
    /// The number of the first pixel of each row, then that of all pixels.
    rows: Vec<usize>,
    /// The column of each pixel, and its red, green and blue, multiplied by its opacity, and the
    /// opacity.
    pixels: Vec<(u32, [u8; 4])>,
}

impl HeatOverlay {
    /// Draws rings and gaze for frames of a size in pixels. `unit` is the factor of widths and text.
    pub(crate) fn new(
        (width, height): (usize, usize),
        rings: &[HeatRing],
        gaze: Option<[f64; 2]>,
        unit: f64,
    ) -> Result<Self, PlotError> {
        let drawing = draw((width as f64, height as f64), rings, gaze, unit);
        if drawing.marks.is_empty() {
            return Ok(Self::default());
        }
        let size = (width as u32, height as u32);
        let rows = Printed::new(drawing, PT_PER_PX).rows(size, seen)?;
        let mut overlay = Self { rows: vec![0], pixels: Vec::new() };
        for row in rows {
            overlay.pixels.extend(row);
            overlay.rows.push(overlay.pixels.len());
        }
        Ok(overlay)
    }

    /// Lays row `y` over a row of red, green and blue codes.
    pub(crate) fn blend(&self, y: usize, row: &mut [u8]) {
        let (Some(&from), Some(&to)) = (self.rows.get(y), self.rows.get(y + 1)) else { return };
        for (x, [r, g, b, opacity]) in &self.pixels[from..to] {
            let below = 255 - u32::from(*opacity);
            let at = 3 * *x as usize;
            for (code, over) in row[at..at + 3].iter_mut().zip([r, g, b]) {
                let seen = (u32::from(*code) * below + 127) / 255 + u32::from(*over);
                *code = seen.min(255) as u8;
            }
        }
    }

    /// Whether it covers a pixel, even partly.
    #[cfg(test)]
    pub(crate) fn covers(&self, x: usize, y: usize) -> bool {
        let (Some(&from), Some(&to)) = (self.rows.get(y), self.rows.get(y + 1)) else {
            return false;
        };
        self.pixels[from..to].iter().any(|(column, _)| *column as usize == x)
    }
}

/// The pixels of a row that are not empty.
fn seen(row: &[PremultipliedColorU8]) -> Vec<(u32, [u8; 4])> {
    let pixels = (0..).zip(row).filter(|(_, pixel)| pixel.alpha() > 0);
    pixels.map(|(x, p)| (x, [p.red(), p.green(), p.blue(), p.alpha()])).collect()
}

fn draw(
    (width_px, height_px): Point,
    rings: &[HeatRing],
    gaze: Option<[f64; 2]>,
    unit: f64,
) -> Drawing {
    let mut drawing = Drawing { width_px, height_px, marks: Vec::new() };
    let point = |[x, y]: [f64; 2]| (x, y);
    let width = |of: f64, least: f64| (of * unit).max(least);
    let strokes = [
        Stroke { colour: INK, width_px: width(RING_EDGE_PX, LEAST_EDGE_PX) },
        Stroke { colour: WHITE, width_px: width(RING_CORE_PX, LEAST_CORE_PX) },
    ];
    for stroke in strokes {
        for line in rings.iter().flat_map(|ring| &ring.lines) {
            let points: Vec<Point> = line.iter().copied().map(point).collect();
            drawing.line(&points, stroke);
        }
    }
    let frame = Rect { left: 0.0, top: 0.0, right: width_px, bottom: height_px };
    let mut taken = Vec::new();
    if let Some((x, y)) = gaze.map(point) {
        let arm = ARM_PX * unit;
        for (of, colour, more) in [(CROSS_EDGE_PX, INK, 0.85), (CROSS_CORE_PX, WHITE, 0.0)] {
            let (stroke, arm) = (Stroke { colour, width_px: of * unit }, arm + more * unit);
            drawing.line(&[(x - arm, y), (x + arm, y)], stroke);
            drawing.line(&[(x, y - arm), (x, y + arm)], stroke);
        }
        taken.push(Rect { left: x - arm, top: y - arm, right: x + arm, bottom: y + arm });
    }
    let gaze = gaze.map_or(frame.centre(), point);
    for ring in rings {
        let points = ring.lines.iter().flatten().copied().map(point);
        label(&mut drawing, (frame, unit), (&ring.label, gaze), points, &mut taken);
    }
    drawing
}

/// Writes the label of a ring where the ring is nearest to the horizontal line from the gaze to the
/// farther side of the frame; nowhere if other labels leave no room there.
fn label(
    drawing: &mut Drawing,
    (frame, unit): (Rect, f64),
    (label, gaze): (&str, Point),
    points: impl Iterator<Item = Point>,
    taken: &mut Vec<Rect>,
) {
    let (text, size_px) = (clean(label), VALUE_PX * unit);
    let apart = APART_PX * unit;
    let half = (
        width_px(&text, size_px) / 2.0 + PADDING_PX * unit,
        CAPITAL * size_px / 2.0 + PADDING_PX * unit,
    );
    let (centre_x, centre_y) = frame.centre();
    let is_inside = gaze.0 > 0.0 && gaze.0 < frame.right && gaze.1 > 0.0 && gaze.1 < frame.bottom;
    let towards = if is_inside {
        (if gaze.0 > centre_x { -1.0 } else { 1.0 }, 0.0)
    } else {
        (centre_x - gaze.0, centre_y - gaze.1)
    };
    let angle = |at: Point| {
        let (dx, dy) = (at.0 - gaze.0, at.1 - gaze.1);
        let (along, across) = (dx * towards.0 + dy * towards.1, dx * towards.1 - dy * towards.0);
        libm::atan2(across, along).abs()
    };
    let place = |at: Point| Rect {
        left: at.0 - half.0,
        right: at.0 + half.0,
        top: at.1 - half.1,
        bottom: at.1 + half.1,
    };
    let fits = |rect: &Rect| {
        rect.left >= apart
            && rect.top >= apart
            && rect.right <= frame.right - apart
            && rect.bottom <= frame.bottom - apart
    };
    let places = points.map(|at| (angle(at), place(at))).filter(|(_, rect)| fits(rect));
    let mut places: Vec<(f64, Rect)> = places.collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some(&(nearest, _)) = places.first() else { return };
    let is_free = |rect: &Rect| !taken.iter().any(|other| other.overlaps(*rect));
    let mut near = places.iter().take_while(|(angle, _)| *angle <= nearest + MOST_EVASION);
    let Some(&(_, rect)) = near.find(|(_, rect)| is_free(rect)) else { return };
    drawing.rect(rect, WHITE, Stroke { colour: INK, width_px: LABEL_EDGE_PX * unit });
    let (x, y) = rect.centre();
    let at = (x, y + CAPITAL * size_px / 2.0);
    drawing.text(Text::new(text, at, size_px, Anchor::Middle));
    taken.push(Rect {
        left: rect.left - apart,
        top: rect.top - apart,
        right: rect.right + apart,
        bottom: rect.bottom + apart,
    });
}
