//! Spells settings in the user's terms: options of the command line, keys of an experiment file, or arguments
//! in Python.
//!
//! The library crates name settings in braces, `{alpha=ignore}`, because they do not know which of
//! these the user writes.

/// The terms in which settings are named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dialect {
    /// Options of the command line.
    #[default]
    Options,
    /// Keys of an experiment file.
    Experiment,
    /// Arguments of a function in Python, whose tables have the keys of an experiment file.
    Arguments,
}

/// Setting, option, key, and argument.
const SETTINGS: [(&str, &str, &str, &str); 31] = [
    ("allow_missing", "--allow-missing", "allow_missing = true", "allow_missing=True"),
    ("alpha=ignore", "--alpha ignore", "alpha = \"ignore\"", "signal={\"alpha\": \"ignore\"}"),
    (
        "alpha=over-black",
        "--alpha over-black",
        "alpha = \"over-black\"",
        "signal={\"alpha\": \"over-black\"}",
    ),
    ("baseline", "--baseline", "--baseline", "baseline"),
    ("buffer", "--buffer", "--buffer", "buffers=True"),
    ("crop", "--crop X,Y,W,H", "crop = [X, Y, W, H]", "crop=(x, y, width, height)"),
    ("exposure", "--exposure", "exposure_stops", "exposure_stops in signal"),
    ("experiment", "--frames=EXPERIMENT", "--frames=EXPERIMENT", "--frames=EXPERIMENT"),
    ("experiment_of_shards", "--experiment FILE", "--experiment FILE", "experiment"),
    ("fps", "--fps", "fps", "fps"),
    ("frames", "--frames A..B", "frames = \"A..B\" (or --frames A..B)", "frames=\"A..B\""),
    ("gaze", "X,Y", "[X, Y]", "(x, y)"),
    ("gaze_px", "--gaze X,Y", "gaze = [X, Y]", "gaze=(x, y)"),
    (
        "gaze_hold",
        "--gaze-hold",
        "hold = true next to trace",
        "gaze={\"trace\": …, \"hold\": True}",
    ),
    (
        "guides",
        "--motion or --depth: --motion RENDERER:X,Y for two channels as that renderer (blender, falcor, \
         unreal, mitsuba) encodes them, --motion X,Y for pixels to the right and down, X,-Y for y up, \
         --depth CHANNEL",
        "motion = { channels = [\"…\", \"…\"], encoding = \"blender\" } (or another renderer, or sign, \
         scale and unit) or depth = { channel = \"…\" }",
        "motion={\"channels\": [\"…\", \"…\"], \"encoding\": \"blender\"} (or another renderer, or sign, scale and unit) or depth={\"channel\": \"…\"}",
    ),
    (
        "layer",
        "--layer (for the test only: --test-layer)",
        "layer = \"…\" (in the method, for its tests only)",
        "signal={\"layer\": \"…\"}",
    ),
    (
        "luminance",
        "the display's photometry with --luminance",
        "the display's photometry with luminance in [view]",
        "the display's photometry with luminance in view",
    ),
    ("maps", "--maps", "--maps", "maps"),
    ("mask", "--mask", "mask", "mask"),
    ("max_megapixels", "--max-megapixels", "max_megapixels", "max_megapixels in signal"),
    ("metrics", "--metrics", "[metrics]", "metrics"),
    ("motion", "--motion or --motion-files", "motion", "motion"),
    (
        "nonfinite=mask",
        "--nonfinite mask",
        "nonfinite = \"mask\"",
        "signal={\"nonfinite\": \"mask\"}",
    ),
    ("output", "--output", "--output", "output"),
    (
        "plausibility=warn",
        "--plausibility warn",
        "plausibility = \"warn\"",
        "signal={\"plausibility\": \"warn\"}",
    ),
    ("resume", "--resume", "--resume", "resume=True"),
    (
        "start",
        "the working directory",
        "the folder of the experiment file",
        "the working directory",
    ),
    ("tonemap", "--tonemap", "tonemap", "tonemap in signal"),
    ("transfer", "--transfer", "transfer", "transfer in signal"),
    ("values", "--values", "--values", "values"),
    (
        "view",
        "a view (--fov-vertical, --fov-horizontal, --fov-diagonal, --frustum, --display, or \
         --distance-m with --pixel-pitch-mm)",
        "a view (in [view]: fov_vertical_deg, fov_horizontal_deg, fov_diagonal_deg, frustum, display, \
         or distance_m with pixel_pitch_mm)",
        "a view (such as view=\"vive-pro-eye\", or view={\"fov_vertical_deg\": 100})",
    ),
];

impl Dialect {
    /// The text with its settings spelled out.
    pub fn spell(self, text: &str) -> String {
        SETTINGS.iter().fold(text.to_owned(), |text, (setting, option, key, argument)| {
            let word = match self {
                Dialect::Options => option,
                Dialect::Experiment => key,
                Dialect::Arguments => argument,
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
        let argument = "use signal={\"alpha\": \"ignore\"} in {scene}";
        assert_eq!(Dialect::Arguments.spell(text), argument);
    }
}
