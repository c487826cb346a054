//! How a figure is printed: its size, the size of its text, and how its series are told apart.

use crate::canvas::palette::Palette;

/// How a figure is printed.
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    /// Its width in inches. `None` means 3.3 (a column) for one chart and 7 (a page) for several
    /// side by side; bars and boxes of many groups then widen it up to a page.
    pub width_in: Option<f64>,
    /// Its height.
    pub height: Height,
    /// The size of its smallest text in points, from 6; titles have 1.2 times as much. If a width
    /// was asked for that is too narrow for the labels, the text becomes smaller, down to 6 points.
    pub font_pt: f64,
    /// Whether its title is shown.
    pub title: bool,
    /// Whether curves have markers.
    pub markers: bool,
    /// Whether curves are told apart by their dashes and bars by their hatches, and not only by
    /// colours and markers.
    pub line_styles: bool,
    /// The colours of series.
    pub palette: Palette,
}

/// The height of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Height {
    /// As high as suits its kind.
    #[default]
    Suited,
    /// In inches.
    Inches(f64),
    /// As its width divided by its height.
    Aspect(f64),
}

impl Default for Style {
    fn default() -> Self {
        Self {
            width_in: None,
            height: Height::Suited,
            font_pt: 7.0,
            title: true,
            markers: true,
            line_styles: true,
            palette: Palette::default(),
        }
    }
}
