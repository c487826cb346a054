//! Lines, labels and the cross over a picture: light with a dark edge, so that they are visible on
//! every colour.

use crate::canvas::clip;
use crate::canvas::colour::{Colour, INK, WHITE};
use crate::canvas::drawing::{Anchor, Drawing, Point, Rect, Stroke, Text};
use crate::canvas::path;
use crate::canvas::text::{CAPITAL, VALUE_PX, width_px};
use crate::canvas::wrap::wrap;
use crate::charts::raster_panel::{RasterPanel, along};

const EDGE: Stroke = Stroke { colour: INK, width_px: 3.2 };
const CORE: Stroke = Stroke { colour: WHITE, width_px: 1.4 };
/// The edge of a label.
const LABEL_EDGE: Stroke = Stroke { colour: INK, width_px: 0.8 };
/// The colour and the radius of a dot.
const DOT: Colour = Colour(0, 80, 140);
const DOT_PX: f64 = 0.9;
/// Distance from a label's text to its edge.
const PADDING_PX: f64 = 2.5;
/// Distance between labels, and from them to the border.
const APART_PX: f64 = 2.0;
/// Distance from a line to a label beside it.
const BESIDE_PX: f64 = 4.0;
/// The length of each arm of the cross.
const ARM_PX: f64 = 8.0;
/// The possible positions of a label along a line in the order of preference, as shares of its
/// length.
const PLACES: [f64; 8] = [0.0, 0.25, 0.5, 0.75, 0.125, 0.375, 0.625, 0.875];
/// The possible positions of a label there: on the line, or on one of its sides.
const SIDES: [Point; 5] = [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0)];

/// The values at the left and right edges, and those at the upper and lower edges.
type Ranges = ((f64, f64), (f64, f64));

/// Draws the lines and the cross over a picture.
pub(crate) fn draw(drawing: &mut Drawing, plot: Rect, panel: &RasterPanel) {
    let placed = |(x, y): Point| (along(x, panel.x.log), along(y, panel.y.log));
    let range = |(from, to): Point, log: bool| (along(from, log), along(to, log));
    let ranges = (range(panel.x_range, panel.x.log), range(panel.y_range, panel.y.log));
    let seen: Vec<Vec<Vec<Point>>> = panel
        .lines
        .iter()
        .map(|line| {
            let points: Vec<Point> = line.points.iter().copied().map(placed).collect();
            pieces(plot, ranges, &points)
        })
        .collect();
    let middle = |at: &Point| share(ranges, *at).filter(|(x, y)| inside(*x) && inside(*y));
    for (x, y) in panel.dots.iter().copied().map(placed).filter_map(|at| middle(&at)) {
        let at = (plot.left + x * plot.width(), plot.top + y * plot.height());
        drawing.disc(at, DOT_PX, DOT);
    }
    let arms = panel.cross.map(|at| arms(plot, ranges, placed(at))).unwrap_or_default();
    for stroke in [EDGE, CORE] {
        for piece in seen.iter().flatten().chain(&arms) {
            drawing.line(piece, stroke);
        }
    }
    cover_border(drawing, plot);
    let mut taken: Vec<Rect> = arms.iter().map(|arm| around(arm)).collect();
    for (line, pieces) in panel.lines.iter().zip(&seen) {
        if let Some(piece) = pieces.first() {
            label(drawing, plot, &line.name, piece, &mut taken);
        }
    }
}

/// Covers the parts that extend over the border: half the width of a line along it, and the pixel
/// in which a line ends.
fn cover_border(drawing: &mut Drawing, plot: Rect) {
    let out = EDGE.width_px / 2.0 + 1.0;
    let around = Rect {
        left: plot.left - out,
        top: plot.top - out,
        right: plot.right + out,
        bottom: plot.bottom + out,
    };
    let sides = [
        Rect { bottom: plot.top, ..around },
        Rect { top: plot.bottom, ..around },
        Rect { right: plot.left, ..around },
        Rect { left: plot.right, ..around },
    ];
    for side in sides {
        drawing.area(side.corners().to_vec(), WHITE);
    }
}

/// The parts of a line within the picture, in pixels.
fn pieces(plot: Rect, ranges: Ranges, points: &[Point]) -> Vec<Vec<Point>> {
    let shares: Vec<Option<Point>> = points.iter().map(|at| share(ranges, *at)).collect();
    let turned = |line: Vec<Point>| line.into_iter().map(|(x, y)| (y, x)).collect::<Vec<_>>();
    let px = |(x, y): Point| (plot.left + x * plot.width(), plot.top + y * plot.height());
    shares
        .split(Option::is_none)
        .map(|run| run.iter().copied().flatten().collect::<Vec<Point>>())
        .flat_map(|run| clip::level(&run))
        .flat_map(|piece| clip::level(&turned(piece)))
        .map(|piece| turned(piece).into_iter().map(px).collect())
        .collect()
}

/// The position of a point as shares of the picture's width and height.
fn share(((left, right), (top, bottom)): Ranges, (x, y): Point) -> Option<Point> {
    let along = |value: f64, from: f64, to: f64| {
        ((value - from) / (to - from)).clamp(-clip::FAR, clip::FAR)
    };
    let finite = x.is_finite() && y.is_finite();
    finite.then(|| (along(x, left, right), along(y, top, bottom)))
}

fn inside(share: f64) -> bool {
    (0.0..=1.0).contains(&share)
}

/// The two arms of the cross within the picture; none if its centre is outside.
fn arms(plot: Rect, ranges: Ranges, at: Point) -> Vec<Vec<Point>> {
    let middle = share(ranges, at).filter(|(x, y)| inside(*x) && inside(*y));
    let Some((x, y)) = middle else { return Vec::new() };
    let (x, y) = (plot.left + x * plot.width(), plot.top + y * plot.height());
    let (left, right) = ((x - ARM_PX).max(plot.left), (x + ARM_PX).min(plot.right));
    let (top, bottom) = ((y - ARM_PX).max(plot.top), (y + ARM_PX).min(plot.bottom));
    vec![vec![(left, y), (right, y)], vec![(x, top), (x, bottom)]]
}

/// Writes a name on a line or beside it, at the first position along it that is free.
fn label(drawing: &mut Drawing, plot: Rect, name: &str, piece: &[Point], taken: &mut Vec<Rect>) {
    let lines = wrap(name, VALUE_PX, plot.width() / 3.0, 1);
    let Some(line) = lines.first() else { return };
    let half = (width_px(line, VALUE_PX) / 2.0 + PADDING_PX, CAPITAL * VALUE_PX / 2.0 + PADDING_PX);
    let within = |at: f64, half: f64, low: f64, high: f64| {
        at.clamp(low + half + APART_PX, (high - half - APART_PX).max(low + half + APART_PX))
    };
    let length = path::length(piece);
    let places = PLACES.iter().filter_map(|share| path::place(piece, share * length));
    let sides = places.flat_map(|(x, y)| {
        SIDES.map(|(right, down)| {
            (x + right * (half.0 + BESIDE_PX), y + down * (half.1 + BESIDE_PX))
        })
    });
    let mut rects = sides.map(|(x, y)| {
        let x = within(x, half.0, plot.left, plot.right);
        let y = within(y, half.1, plot.top, plot.bottom);
        Rect { left: x - half.0, right: x + half.0, top: y - half.1, bottom: y + half.1 }
    });
    let free = |rect: &Rect| !taken.iter().any(|other| other.overlaps(*rect));
    let Some(rect) = rects.find(free) else { return };
    drawing.rect(rect, WHITE, LABEL_EDGE);
    let (x, y) = rect.centre();
    let at = (x, y + CAPITAL * VALUE_PX / 2.0);
    drawing.text(Text::new(line, at, VALUE_PX, Anchor::Middle));
    taken.push(around(&rect.corners()));
}

/// The bounding box of a set of points, with a little space.
fn around(points: &[Point]) -> Rect {
    let start = Rect {
        left: f64::INFINITY,
        top: f64::INFINITY,
        right: f64::NEG_INFINITY,
        bottom: f64::NEG_INFINITY,
    };
    points.iter().fold(start, |rect, (x, y)| Rect {
        left: rect.left.min(x - APART_PX),
        top: rect.top.min(y - APART_PX),
        right: rect.right.max(x + APART_PX),
        bottom: rect.bottom.max(y + APART_PX),
    })
}
