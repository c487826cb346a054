//! How figures are printed: `[figures]`, and `figure` of a single plot.

use std::fmt;

use fovqa_params::words;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

words! {
    /// A file format of figures.
    pub enum FigureFormat {
        /// SVG.
        Svg "svg" "SVG with text as outlines";
        /// PDF.
        Pdf "pdf" "PDF with text as text";
        /// PNG.
        Png "png" "PNG with 300 pixels per inch";
    }
}

words! {
    /// A named palette of colours.
    pub enum PaletteName {
        /// Okabe and Ito.
        OkabeIto "okabe-ito" "Okabe and Ito, distinct with colour blindness";
        /// Paul Tol's "bright".
        TolBright "tol-bright" "Paul Tol's bright colours";
        /// Grays.
        Gray "gray" "Grays, for print without colour";
    }
}

words! {
    /// How an axis is divided.
    pub enum AxisScale {
        /// Equal steps are equally long.
        Linear "linear" "Equal steps are equally long";
        /// Equal ratios are equally long.
        Log "log" "Equal ratios are equally long";
    }
}

/// The colours of series.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum PaletteChoice {
    /// A named palette.
    Named(PaletteName),
    /// Given colours.
    Colours(Vec<Colour>),
}

/// A colour in sRGB, written as `#0072b2`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// A colour from its notation, a `#` with six hexadecimal digits.
    pub fn of(text: &str) -> Option<Self> {
        let is_colour = |d: &&str| d.len() == 6 && d.bytes().all(|b| b.is_ascii_hexdigit());
        let digits = text.strip_prefix('#').filter(is_colour)?;
        let part = |from: usize| u8::from_str_radix(&digits[from..from + 2], 16).ok();
        Some(Self([part(0)?, part(2)?, part(4)?]))
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::of(&text).ok_or_else(|| de::Error::custom("a colour is written as #0072b2"))
    }
}

/// Settings of an axis; `None` leaves them to the figure.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct AxisSettings {
    /// How it is divided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<AxisScale>,
    /// Its first value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Its last value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Its title.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
}

/// How figures are printed; `None` leaves a setting to the kind of figure.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct FigureSettings {
    /// Width in inches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_in: Option<f64>,
    /// Height in inches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_in: Option<f64>,
    /// Width divided by height.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aspect: Option<f64>,
    /// Size of the smallest text in points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub font_pt: Option<f64>,
    /// Whether titles are shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<bool>,
    /// Whether curves have markers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub markers: Option<bool>,
    /// Whether curves have different dashes, and bars different hatches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line_styles: Option<bool>,
    /// Colours of series.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub palette: Option<PaletteChoice>,
    /// The files that are written of each figure, beside its data.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formats: Option<Vec<FigureFormat>>,
    /// The horizontal axis.
    #[serde(skip_serializing_if = "AxisSettings::is_default")]
    pub x: AxisSettings,
    /// The vertical axis.
    #[serde(skip_serializing_if = "AxisSettings::is_default")]
    pub y: AxisSettings,
}

impl AxisSettings {
    /// The keys that are set.
    fn keys(&self) -> impl Iterator<Item = &'static str> {
        let keys = [
            ("scale", self.scale.is_some()),
            ("min", self.min.is_some()),
            ("max", self.max.is_some()),
            ("label", self.label.is_some()),
        ];
        keys.into_iter().filter_map(|(key, is_set)| is_set.then_some(key))
    }

    fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// These settings, and those of `all` where these have none.
    fn over(self, all: &Self) -> Self {
        Self {
            scale: self.scale.or(all.scale),
            min: self.min.or(all.min),
            max: self.max.or(all.max),
            label: self.label.or_else(|| all.label.clone()),
        }
    }
}

impl FigureSettings {
    /// The longest side of a figure that is written as PNG, in inches: PNG has 300 pixels per inch,
    /// and at most 16384 on a side.
    pub const MOST_PNG_IN: f64 = 54.6;

    /// Whether a figure is written as PNG.
    pub fn has_png(&self) -> bool {
        self.formats.as_ref().is_none_or(|formats| formats.contains(&FigureFormat::Png))
    }

    /// The keys that are set; those of an axis as `x.min`.
    pub(crate) fn keys(&self) -> Vec<String> {
        let own = [
            ("width_in", self.width_in.is_some()),
            ("height_in", self.height_in.is_some()),
            ("aspect", self.aspect.is_some()),
            ("font_pt", self.font_pt.is_some()),
            ("title", self.title.is_some()),
            ("markers", self.markers.is_some()),
            ("line_styles", self.line_styles.is_some()),
            ("palette", self.palette.is_some()),
            ("formats", self.formats.is_some()),
        ];
        let own = own.into_iter().filter(|(_, is_set)| *is_set).map(|(key, _)| key.to_owned());
        let x = self.x.keys().map(|key| format!("x.{key}"));
        own.chain(x).chain(self.y.keys().map(|key| format!("y.{key}"))).collect()
    }

    /// Whether nothing was set.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// These settings, and those of `all` where these have none. A height in inches and an aspect
    /// replace each other.
    #[must_use]
    pub fn over(self, all: &Self) -> Self {
        let has_height = self.height_in.is_some() || self.aspect.is_some();
        let (height_in, aspect) =
            if has_height { (self.height_in, self.aspect) } else { (all.height_in, all.aspect) };
        Self {
            width_in: self.width_in.or(all.width_in),
            height_in,
            aspect,
            font_pt: self.font_pt.or(all.font_pt),
            title: self.title.or(all.title),
            markers: self.markers.or(all.markers),
            line_styles: self.line_styles.or(all.line_styles),
            palette: self.palette.or_else(|| all.palette.clone()),
            formats: self.formats.or_else(|| all.formats.clone()),
            x: self.x.over(&all.x),
            y: self.y.over(&all.y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_its_own_settings_before_those_of_all() {
        let all = FigureSettings {
            width_in: Some(7.0),
            height_in: Some(3.0),
            x: AxisSettings { min: Some(1.0), ..AxisSettings::default() },
            ..FigureSettings::default()
        };
        let own = FigureSettings {
            aspect: Some(2.0),
            x: AxisSettings { max: Some(9.0), ..AxisSettings::default() },
            ..FigureSettings::default()
        };
        let both = own.over(&all);
        assert_eq!((both.width_in, both.height_in, both.aspect), (Some(7.0), None, Some(2.0)));
        assert_eq!((both.x.min, both.x.max), (Some(1.0), Some(9.0)));
    }

    #[test]
    fn colours_have_six_digits() {
        assert_eq!(Colour::of("#0072B2"), Some(Colour([0, 0x72, 0xb2])));
        assert_eq!(Colour([0, 0x72, 0xb2]).to_string(), "#0072b2");
        for wrong in ["0072b2", "#0072b", "#0072b2f", "#00ü2b2", "#+072b2", ""] {
            assert_eq!(Colour::of(wrong), None, "{wrong}");
        }
    }
}
