//! How samples become the signal: transfer function, exposure, tone map, channels.

use fovqa_params::{OrAuto, words};
use serde::{Deserialize, Serialize};

use crate::frame::Frame;
use crate::tonemap::ToneMap;

words! {
    /// How the values of a file are encoded.
    pub enum Transfer {
        /// sRGB-encoded; values are used as they are.
        Srgb "srgb" "sRGB-encoded";
        /// Linear light: exposure, tone map and sRGB encoding follow.
        Linear "linear" "Linear light: exposure, tone map and sRGB encoding follow";
        /// SMPTE ST 2084 codes; values are used as they are.
        Pq "pq" "SMPTE ST 2084 codes, used as they are";
        /// A power of 2.2; values are used as they are.
        Gamma22 "gamma2.2" "A power of 2.2, used as it is";
    }
}

impl OrAuto for Transfer {
    const AUTO: &'static str = "sRGB for PNG, JPEG and y4m video, linear for OpenEXR";
}

words! {
    /// The channels of a picture that metrics compare.
    #[derive(Default)]
    pub enum SignalChannels {
        /// Three channels; a gray picture stands for three equal ones.
        #[default]
        Rgb "rgb" "Red, green and blue";
        /// One channel, see [`Luma`].
        Luma "luma" "0.2126 R + 0.7152 G + 0.0722 B of the encoded signal";
    }
}

/// The luma `Y = 0.2126 R + 0.7152 G + 0.0722 B` of the encoded signal (Rec. ITU-R BT.709).
#[derive(Debug, Clone, Copy)]
pub struct Luma;

impl Luma {
    /// Weights of red, green and blue.
    pub const WEIGHTS: [f32; 3] = [0.2126, 0.7152, 0.0722];
}

/// How samples become the signal.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SignalParams {
    /// The transfer function; `None` means sRGB for encoded frames and linear for others.
    pub transfer: Option<Transfer>,
    /// Exposure of linear input, in stops.
    pub exposure_stops: f64,
    /// Tone map of linear input.
    pub tonemap: ToneMap,
    /// RGB or luma.
    pub channels: SignalChannels,
}

impl SignalParams {
    /// The transfer function of a frame: the user's choice, or the default for its kind of file.
    pub fn transfer_of(&self, frame: &Frame) -> Transfer {
        self.transfer.unwrap_or(if frame.is_encoded() { Transfer::Srgb } else { Transfer::Linear })
    }
}
