//! What a check says.

use fovqa_params::words;

words! {
    /// What to do about pairs that cannot be what the user wants to compare.
    #[derive(Default)]
    pub enum Plausibility {
        /// Say it, once for each method of a scene.
        #[default]
        Warn "warn" "A warning that names the likely cause";
        /// Do not score the pair.
        Error "error" "The pair is not scored, and the command fails";
        /// Do not look for mistakes.
        Off "off" "Pairs are not checked";
    }
}

words! {
    /// A mistake that a check looks for.
    pub enum Check {
        /// A picture of one colour.
        Constant "constant" "One of the pictures is constant, or much of it is";
        /// Another scene, another camera or another frame.
        Scene "scene" "The pictures show different scenes";
        /// A picture that is mirrored or upside down.
        Mirrored "mirrored" "One of the pictures is mirrored or upside down";
        /// A picture that is shifted by whole pixels.
        Shifted "shifted" "One of the pictures is shifted by whole pixels";
        /// Different exposures.
        Exposure "exposure" "One of the pictures is brighter by some stops";
        /// Different transfer functions or tone maps.
        Transfer "transfer" "The pictures have different transfer functions or tone maps";
        /// Red and blue in the place of each other.
        Channels "channels" "Red and blue are swapped";
        /// Reference and test in the place of each other.
        Swapped "swapped" "Reference and test are swapped";
        /// A gaze that is not where the test is sharpest.
        Gaze "gaze" "The test is sharpest elsewhere than at the gaze";
        /// Methods whose files cannot be compared.
        Format "format" "The files of methods in one table lose different amounts of quality";
    }
}

/// A likely mistake in a pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Suspicion {
    /// The check.
    pub check: Check,
    /// What was seen, with numbers. The sentence begins with "the test" or "the reference".
    pub message: String,
    /// The likely cause, and how to correct it. Settings are named in braces.
    pub help: String,
}

impl Suspicion {
    /// A suspicion of a kind.
    pub(crate) fn new(check: Check, message: String, help: impl Into<String>) -> Self {
        Self { check, message, help: help.into() }
    }
}
