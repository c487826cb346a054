//! The look of a series: colour, marker, dash and hatch, which are the same in every figure for the
//! same index.

use crate::canvas::colour::Colour;
use crate::canvas::palette::Palette;

/// Alternating lengths of strokes and gaps in pixels. The first one is solid; neighbours differ most.
const DASHES_PX: [&[f64]; 8] = [
    &[],
    &[6.0, 3.0],
    &[1.6, 2.6],
    &[6.0, 3.0, 1.6, 3.0],
    &[11.0, 3.5],
    &[6.0, 3.0, 1.6, 3.0, 1.6, 3.0],
    &[3.4, 2.2],
    &[11.0, 3.0, 1.6, 3.0],
];

/// How far dashes and hatches go on with each turn of the palette. Without a common divisor with
/// their number, no two series have the same colour and dash for as long as possible.
const TURN: usize = 3;

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

const MARKERS: [Marker; 7] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::TriangleDown,
    Marker::Plus,
    Marker::Hexagon,
];

/// The lines over the fill of bars and boxes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hatch {
    Plain,
    /// Lines that rise to the right.
    Rising,
    /// Lines that fall to the right.
    Falling,
    Level,
    Upright,
    /// Lines that rise and lines that fall.
    Crossed,
    /// Level and upright lines.
    Grid,
}

const HATCHES: [Hatch; 7] = [
    Hatch::Plain,
    Hatch::Rising,
    Hatch::Level,
    Hatch::Falling,
    Hatch::Upright,
    Hatch::Crossed,
    Hatch::Grid,
];

/// The look of a series. Give a method the same look in every figure.
///
/// There are seven colours, each with its own marker, and eight dashes (for bars and boxes: seven
/// hatches). From the eighth series on, colours repeat with other dashes and with hollow markers.
/// The figure's [`Style`](crate::Style) may set other colours, or leave out dashes and markers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Look {
    /// The index of the series: 0 for the first one, and so on.
    pub index: usize,
    /// Which of the curves that share its colour it is; each has its own dash and marker.
    pub variant: usize,
    palette: Palette,
    line_styles: bool,
    markers: bool,
}

impl Look {
    /// The look with an index.
    pub fn new(index: usize) -> Self {
        let palette = Palette::default();
        Self { index, variant: 0, palette, line_styles: true, markers: true }
    }

    /// The look of another curve of the same method, such as at another resolution: the same colour
    /// with another dash and marker. The variant 0 is the look itself.
    #[must_use]
    pub fn with_variant(self, variant: usize) -> Self {
        Self { variant, ..self }
    }

    /// The look with the colours of a palette, with or without dashes and markers.
    pub(crate) fn styled(self, palette: Palette, line_styles: bool, markers: bool) -> Self {
        Self { palette, line_styles, markers, ..self }
    }

    pub(crate) fn colour(self) -> Colour {
        self.palette.colour(self.index).0
    }

    pub(crate) fn marker(self) -> Marker {
        MARKERS[(self.palette.position(self.index) + self.variant) % MARKERS.len()]
    }

    /// Whether its curves have markers.
    pub(crate) fn has_markers(self) -> bool {
        self.markers
    }

    /// How often the colours have been used before.
    pub(crate) fn turn(self) -> usize {
        self.palette.colour(self.index).1
    }

    /// Alternating lengths of strokes and gaps in pixels; empty for a solid line.
    pub(crate) fn dash_px(self) -> &'static [f64] {
        DASHES_PX[self.kind(DASHES_PX.len())]
    }

    /// The lines over the fill of its bars and boxes.
    pub(crate) fn hatch(self) -> Hatch {
        HATCHES[self.kind(HATCHES.len())]
    }

    /// The dash of a reference curve, which is never solid.
    pub(crate) fn reference_dash_px(self) -> &'static [f64] {
        DASHES_PX[1 + self.index % (DASHES_PX.len() - 1)]
    }

    /// One of this many kinds of dashes or hatches. Without line styles they change only when the
    /// colours repeat.
    fn kind(self, kinds: usize) -> usize {
        let first = if self.line_styles { self.palette.position(self.index) } else { 0 };
        (first + TURN * self.turn() + self.variant) % kinds
    }
}

impl Default for Look {
    fn default() -> Self {
        Self::new(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that no two of the first looks have the same colour and dash, or colour and hatch.
    fn differ(looks: &[Look]) {
        for (i, a) in looks.iter().enumerate() {
            for b in &looks[..i] {
                let same_colour = a.colour() == b.colour();
                assert!(!same_colour || a.dash_px() != b.dash_px(), "{a:?} {b:?}");
                assert!(!same_colour || a.hatch() != b.hatch(), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn no_two_series_look_alike() {
        let looks: Vec<_> = (0..49).map(Look::new).collect();
        differ(&looks);
        for palette in [Palette::TOL_BRIGHT, Palette::GRAY, Palette::new(&[[9; 3]; 1]).unwrap()] {
            let count = if palette == Palette::TOL_BRIGHT { 42 } else { 7 };
            differ(
                &looks[..count].iter().map(|l| l.styled(palette, true, true)).collect::<Vec<_>>(),
            );
        }
        let plain: Vec<_> =
            looks.iter().map(|look| look.styled(Palette::OKABE_ITO, false, false)).collect();
        differ(&plain);
        assert!(plain[..7].iter().all(|look| look.dash_px().is_empty()));
        // In print without colour, neighbours have different dashes and hatches.
        for pair in looks.windows(2) {
            assert!(pair[0].dash_px() != pair[1].dash_px() && pair[0].hatch() != pair[1].hatch());
        }
        assert!(looks.iter().all(|look| !look.reference_dash_px().is_empty()));
    }
}
