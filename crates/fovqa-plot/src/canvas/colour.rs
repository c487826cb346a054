//! Colours, and those of everything that belongs to no series.

/// A colour in sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
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

impl Colour {
    /// The colour mixed with white; `share` is the share of the colour, from 0 to 1.
    pub(crate) fn tint(self, share: f64) -> Self {
        let mix = |c: u8| (255.0 - (255.0 - f64::from(c)) * share).round() as u8;
        Self(mix(self.0), mix(self.1), mix(self.2))
    }

    /// The colour in the notation of SVG, such as `#0072b2`.
    pub(crate) fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }

    /// The same hue, but darker, for edges.
    pub(crate) fn darker(self) -> Self {
        let mix = |c: u8| (f64::from(c) * 0.6).round() as u8;
        Self(mix(self.0), mix(self.1), mix(self.2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tint_is_between_white_and_the_colour() {
        assert_eq!(Colour(0, 100, 200).tint(0.0), WHITE);
        assert_eq!(Colour(0, 100, 200).tint(1.0), Colour(0, 100, 200));
    }
}
