//! A picture as emulation computes with it: the display-encoded signal in `[0, 1]`, never rounded to
//! codes on the way.

use fovqa_frame::Channels;

use crate::image::Image;

/// A gray or colour picture of `f32` values of the encoded signal in `[0, 1]`.
#[derive(Debug, Clone, PartialEq)]
pub enum Picture {
    /// One channel.
    Gray(Image<1>),
    /// Red, green, blue.
    Rgb(Image<3>),
}

impl Picture {
    /// Width in pixels.
    pub fn width(&self) -> usize {
        match self {
            Self::Gray(image) => image.width(),
            Self::Rgb(image) => image.width(),
        }
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        match self {
            Self::Gray(image) => image.height(),
            Self::Rgb(image) => image.height(),
        }
    }

    /// Gray or colour.
    pub fn channels(&self) -> Channels {
        match self {
            Self::Gray(_) => Channels::Gray,
            Self::Rgb(_) => Channels::Rgb,
        }
    }

    /// All values, row by row, the channels of a pixel side by side.
    pub fn values(&self) -> &[f32] {
        match self {
            Self::Gray(image) => image.pixels().as_flattened(),
            Self::Rgb(image) => image.pixels().as_flattened(),
        }
    }
}
