//! How the codes of a video are to be understood, where the user says so.

use fovqa_params::{OrAuto, words};
use serde::{Deserialize, Serialize};

words! {
    /// Which codes stand for black and white.
    pub enum CodeRange {
        /// 16 to 235 for Y', 16 to 240 for Cb and Cr; four and sixteen times that at 10 and 12 bits.
        Limited "limited" "16 to 235 (of 8 bits) from black to white";
        /// All codes.
        Full "full" "All codes from black to white";
    }
}

impl OrAuto for CodeRange {
    const AUTO: &'static str = "What XCOLORRANGE says; limited where it says nothing";
}

words! {
    /// The weights of R', G' and B' in Y', which Cb and Cr were made with too. Primaries are left as they are.
    pub enum ColourMatrix {
        /// Rec. ITU-R BT.601: 0.299, 0.587, 0.114.
        Bt601 "bt601" "Rec. ITU-R BT.601, of standard definition";
        /// Rec. ITU-R BT.709: 0.2126, 0.7152, 0.0722.
        Bt709 "bt709" "Rec. ITU-R BT.709, of high definition";
        /// Rec. ITU-R BT.2020 with non-constant luminance: 0.2627, 0.6780, 0.0593.
        Bt2020 "bt2020" "Rec. ITU-R BT.2020, non-constant luminance";
    }
}

impl OrAuto for ColourMatrix {
    const AUTO: &'static str = "BT.709 from 720 lines up, else BT.601";
}

/// How the codes of a video are to be understood, where the user says so.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Y4mOptions {
    /// Which codes are black and white; `None`: as the header says, else limited.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<CodeRange>,
    /// What Y', Cb and Cr were made with; `None`: BT.709 from 720 lines up, else BT.601.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix: Option<ColourMatrix>,
}
