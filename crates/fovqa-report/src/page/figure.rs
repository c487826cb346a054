//! Figures of a page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::address::address;

/// A figure on a page.
pub(crate) struct PageFigure<'a> {
    /// Its path relative to the page, without the file extension.
    pub(crate) path: String,
    pub(crate) caption: &'a str,
    /// What it shows, for readers who do not see it.
    pub(crate) alternative: String,
    /// The endings of its files.
    pub(crate) endings: Vec<&'static str>,
    /// Its width in pixels.
    pub(crate) width_px: f64,
    /// The picture as a `data:` address; `None` if it has only formats that no browser shows.
    pub(crate) image: Option<String>,
}

impl PageFigure<'_> {
    /// Its width as an attribute, in whole pixels.
    pub(crate) fn width(&self) -> String {
        format!("{:.0}", self.width_px)
    }

    /// Its files: the addresses, and what they are called.
    pub(crate) fn links(&self) -> Vec<(String, String)> {
        let link =
            |ending: &&str| (address(&format!("{}.{ending}", self.path)), ending.to_uppercase());
        self.endings.iter().map(link).collect()
    }
}

/// A picture as a `data:` address; `None` if it is of a format that no browser shows as an image.
pub(crate) fn data_image(ending: &str, bytes: &[u8]) -> Option<String> {
    let kind = match ending {
        "svg" => "svg+xml",
        "png" => "png",
        _ => return None,
    };
    Some(format!("data:image/{kind};base64,{}", STANDARD.encode(bytes)))
}
