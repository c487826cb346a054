//! Spells settings in the user's terms: options of the command line, or keys of an experiment file.
//!
//! The library crates name settings in braces, `{alpha=ignore}`, because they do not know which of
//! the two the user writes.

/// The terms in which settings are named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Dialect {
    /// Options of the command line.
    #[default]
    Options,
    /// Keys of an experiment file.
    Experiment,
}

/// Setting, option, and key.
const SETTINGS: [(&str, &str, &str); 29] = [
    ("allow_missing", "--allow-missing", "allow_missing = true"),
    ("alpha=ignore", "--alpha ignore", "alpha = \"ignore\""),
    ("alpha=over-black", "--alpha over-black", "alpha = \"over-black\""),
    ("baseline", "--baseline", "--baseline"),
    ("buffer", "--buffer", "--buffer"),
    ("crop", "--crop X,Y,W,H", "crop = [X, Y, W, H]"),
    ("exposure", "--exposure", "exposure_stops"),
    ("experiment", "--frames=EXPERIMENT", "--frames=EXPERIMENT"),
    ("fps", "--fps", "fps"),
    ("frames", "--frames A..B", "frames = \"A..B\" (or --frames A..B)"),
    ("gaze", "X,Y", "[X, Y]"),
    ("gaze_px", "--gaze X,Y", "gaze = [X, Y]"),
    ("gaze_hold", "--gaze-hold", "hold = true next to trace"),
    (
        "guides",
        "--motion or --depth: --motion RENDERER:X,Y for two channels as that renderer (blender, falcor, \
         unreal, mitsuba) encodes them, --motion X,Y for pixels to the right and down, X,-Y for y up, \
         --depth CHANNEL",
        "motion = { channels = [\"…\", \"…\"], encoding = \"blender\" } (or another renderer, or sign, \
         scale and unit) or depth = { channel = \"…\" }",
    ),
    (
        "layer",
        "--layer (for the test only: --test-layer)",
        "layer = \"…\" (in the method, for its tests only)",
    ),
    (
        "luminance",
        "the display's photometry with --luminance",
        "the display's photometry with luminance in [view]",
    ),
    ("maps", "--maps", "--maps"),
    ("mask", "--mask", "mask"),
    ("max_megapixels", "--max-megapixels", "max_megapixels"),
    ("metrics", "--metrics", "[metrics]"),
    ("motion", "--motion or --motion-files", "motion"),
    ("nonfinite=mask", "--nonfinite mask", "nonfinite = \"mask\""),
    ("output", "--output", "--output"),
    ("plausibility=warn", "--plausibility warn", "plausibility = \"warn\""),
    ("resume", "--resume", "--resume"),
    ("start", "the working directory", "the folder of the experiment file"),
    ("tonemap", "--tonemap", "tonemap"),
    ("transfer", "--transfer", "transfer"),
    (
        "view",
        "a view (--fov-vertical, --fov-horizontal, --fov-diagonal, --frustum, --display, or \
         --distance-m with --pixel-pitch-mm)",
        "a view (in [view]: fov_vertical_deg, fov_horizontal_deg, fov_diagonal_deg, frustum, display, \
         or distance_m with pixel_pitch_mm)",
    ),
];

impl Dialect {
    /// The text with its settings spelled out.
    pub(crate) fn spell(self, text: &str) -> String {
        SETTINGS.iter().fold(text.to_owned(), |text, (setting, option, key)| {
            let word = match self {
                Dialect::Options => option,
                Dialect::Experiment => key,
            };
            text.replace(&format!("{{{setting}}}"), word)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_spelled_and_other_braces_stay() {
        let text = "use {alpha=ignore} in {scene}";
        assert_eq!(Dialect::Options.spell(text), "use --alpha ignore in {scene}");
        assert_eq!(Dialect::Experiment.spell(text), "use alpha = \"ignore\" in {scene}");
    }
}
