//! The look of a series: colour, marker and dash, which are the same in every figure for the same
//! index.
//!
//! The colours are those of Okabe and Ito ("Color Universal Design", 2008), which people with any
//! common colour blindness can distinguish. The order is our own: the first four are far apart in
//! hue and in lightness. Yellow is left out, because it is too light for a line on white paper.

/// A colour in sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Colour(pub(crate) u8, pub(crate) u8, pub(crate) u8);

/// The colour of the paper.
pub(crate) const WHITE: Colour = Colour(255, 255, 255);
/// The colour of text.
pub(crate) const INK: Colour = Colour(34, 34, 34);
/// The colour of axis lines and their ticks.
pub(crate) const AXIS: Colour = Colour(90, 90, 90);
/// The colour of grid lines, which are visible but behind everything.
pub(crate) const GRID: Colour = Colour(224, 224, 224);
/// The colour of shaded spans. Grid lines remain visible on it, and curves look as on paper.
pub(crate) const SPAN: Colour = Colour(232, 232, 232);
/// The edge of a span's key in the legend; the key is small and needs an edge.
pub(crate) const SPAN_EDGE: Colour = Colour(180, 180, 180);
/// The colour of areas with more than is needed. It is light, so that curves and their colours
/// stand out.
pub(crate) const SURPLUS: Colour = Colour(209, 229, 244);
/// The edge of a surplus area's key in the legend.
pub(crate) const SURPLUS_EDGE: Colour = Colour(120, 165, 200);
/// The colour of areas with less than is needed. Everyone except the fully colour-blind can
/// distinguish blue and orange.
pub(crate) const DEFICIT: Colour = Colour(253, 224, 196);
/// The hatch of deficit areas, which distinguishes them in gray print too.
pub(crate) const DEFICIT_HATCH: Colour = Colour(205, 120, 60);
/// The colour of reference curves.
pub(crate) const REFERENCE: Colour = Colour(85, 85, 85);

const PALETTE: [Colour; 7] = [
    Colour(0x00, 0x72, 0xb2), // blue
    Colour(0xd5, 0x5e, 0x00), // vermillion
    Colour(0x00, 0x9e, 0x73), // bluish green
    Colour(0xcc, 0x79, 0xa7), // reddish purple
    Colour(0xe6, 0x9f, 0x00), // orange
    Colour(0x56, 0xb4, 0xe9), // sky blue
    Colour(0x00, 0x00, 0x00), // black
];

/// The number of dashes for reference curves. More would be hard to distinguish without colour.
const REFERENCE_DASHES: usize = 4;

impl Colour {
    /// The colour mixed with white; `share` is the share of the colour, from 0 to 1.
    pub(crate) fn tint(self, share: f64) -> Self {
        let mix = |c: u8| (255.0 - (255.0 - f64::from(c)) * share).round() as u8;
        Self(mix(self.0), mix(self.1), mix(self.2))
    }

    /// The same hue, but darker, for edges.
    pub(crate) fn darker(self) -> Self {
        let mix = |c: u8| (f64::from(c) * 0.6).round() as u8;
        Self(mix(self.0), mix(self.1), mix(self.2))
    }
}

/// The shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Marker {
    /// ●
    Circle,
    /// ■
    Square,
    /// ▲
    Triangle,
    /// ◆
    Diamond,
    /// ▼
    TriangleDown,
    /// ✚
    Plus,
    /// ⬣
    Hexagon,
}

const MARKERS: [Marker; PALETTE.len()] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::TriangleDown,
    Marker::Plus,
    Marker::Hexagon,
];

/// The look of a series. Give a method the same look in every figure.
///
/// There are seven colours, each with its own marker. From the eighth series on they repeat with
/// hollow markers and with a dash (in bars and boxes: with stripes), which has one more dot
/// (stripe) in each further turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Look {
    /// The index of the series: 0 for the first one, and so on.
    pub index: usize,
}

impl Look {
    /// The look with an index.
    pub fn new(index: usize) -> Self {
        Self { index }
    }

    pub(crate) fn colour(self) -> Colour {
        PALETTE[self.index % PALETTE.len()]
    }

    pub(crate) fn marker(self) -> Marker {
        MARKERS[self.index % MARKERS.len()]
    }

    /// How often the colours have been used before: 0 means a solid line or fill.
    pub(crate) fn turn(self) -> usize {
        self.index / PALETTE.len()
    }

    /// Alternating lengths of strokes and gaps in pixels; empty for a solid line.
    pub(crate) fn dash_px(self) -> Vec<f64> {
        dash_px(self.turn())
    }

    /// The dash of a reference curve, which is never solid.
    pub(crate) fn reference_dash_px(self) -> Vec<f64> {
        dash_px(1 + self.index % REFERENCE_DASHES)
    }
}

/// The lengths of a stroke followed by `turn - 1` dots.
fn dash_px(turn: usize) -> Vec<f64> {
    const STROKE_PX: f64 = 6.0;
    const DOT_PX: f64 = 1.6;
    const GAP_PX: f64 = 3.0;
    match turn {
        0 => Vec::new(),
        _ => [STROKE_PX, GAP_PX]
            .into_iter()
            .chain((1..turn).flat_map(|_| [DOT_PX, GAP_PX]))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_series_look_alike() {
        let looks: Vec<_> = (0..60).map(Look::new).collect();
        for (i, a) in looks.iter().enumerate() {
            for b in &looks[..i] {
                let same_colour = a.colour() == b.colour();
                assert_eq!(same_colour, a.marker() == b.marker());
                assert!(!same_colour || a.dash_px() != b.dash_px(), "{a:?} {b:?}");
            }
        }
        assert!(looks.iter().all(|look| !look.reference_dash_px().is_empty()));
    }

    #[test]
    fn every_colour_is_seen_on_white() {
        for colour in PALETTE {
            let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
            let y =
                0.2126 * linear(colour.0) + 0.7152 * linear(colour.1) + 0.0722 * linear(colour.2);
            // The contrast is defined as in WCAG; yellow would have 1.3.
            assert!(1.05 / (y + 0.05) > 2.0, "{colour:?}");
        }
        assert_eq!(Colour(0, 100, 200).tint(0.0), WHITE);
        assert_eq!(Colour(0, 100, 200).tint(1.0), Colour(0, 100, 200));
    }
}
