//! Options for the codes of a video, which override its header.

use fovqa_params::{OrAuto, words};
use serde::{Deserialize, Serialize};

words! {
    /// The codes that stand for black and white.
    pub enum CodeRange {
        /// 16 to 235 for Y', 16 to 240 for Cb and Cr; multiplied by four at 10 bits and by sixteen
        /// at 12 bits.
        Limited "limited" "16 to 235 (of 8 bits) from black to white";
        /// All codes.
        Full "full" "All codes from black to white";
    }
}

impl OrAuto for CodeRange {
    const AUTO: &'static str = "The value of XCOLORRANGE; limited if it is not given";
}

words! {
    /// The weights of R', G' and B' in Y', from which Cb and Cr are derived too. Primaries are not
    /// converted.
    pub enum ColourMatrix {
        /// Rec. ITU-R BT.601: 0.299, 0.587, 0.114.
        Bt601 "bt601" "Rec. ITU-R BT.601, for standard definition";
        /// Rec. ITU-R BT.709: 0.2126, 0.7152, 0.0722.
        Bt709 "bt709" "Rec. ITU-R BT.709, for high definition";
        /// Rec. ITU-R BT.2020 with non-constant luminance: 0.2627, 0.6780, 0.0593.
        Bt2020 "bt2020" "Rec. ITU-R BT.2020, non-constant luminance";
    }
}

impl OrAuto for ColourMatrix {
    const AUTO: &'static str = "BT.709 from 720 lines up, else BT.601";
}

/// Options for the codes of a video, which override its header.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Y4mOptions {
    /// The codes of black and white; `None` means as the header says, else limited.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<CodeRange>,
    /// The matrix of Y', Cb and Cr; `None` means BT.709 from 720 lines up, else BT.601.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix: Option<ColourMatrix>,
}
