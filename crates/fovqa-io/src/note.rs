//! Notes about files that can be read, but have a property that the user should know.

/// A property of a file that the user should know, although the file can be read.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Note {
    /// The named colour chunks are not applied.
    ColourChunks(String),
    /// The data window does not cover the display window; the other pixels are 0.
    UncoveredPixels,
    /// Chromaticities were converted to Rec.709.
    ConvertedPrimaries,
    /// An Exif orientation is not applied.
    Orientation,
    /// Inks were converted to RGB without a colour profile.
    Inks,
    /// The data window of motion or depth does not cover the display window; the other pixels are
    /// NaN.
    UncoveredGuides,
    /// Motion or depth exists only for another view or layer than the colour, and is not read.
    GuidesElsewhere {
        /// `motion` or `depth`.
        what: &'static str,
        /// The channels that exist.
        channels: String,
    },
    /// Motion is encoded as Unreal writes it, and its scale has no official source.
    UnrealMotion,
    /// The motion in R and G of a separate file is read as Falcor writes it.
    AssumedFalcor,
}

impl Note {
    /// The note as one sentence. Settings are in braces, as in [`ReadErrorKind::help`].
    pub fn in_words(&self) -> String {
        match self {
            Note::ColourChunks(names) => {
                format!(
                    "the colour chunk {names} is not applied; values are read as sRGB unless {{transfer}} is given"
                )
            }
            Note::UncoveredPixels => {
                "the data window does not cover the display window; uncovered pixels are 0"
                    .to_owned()
            }
            Note::ConvertedPrimaries => {
                "the chromaticities attribute is not Rec.709; colours were converted".to_owned()
            }
            Note::Orientation => "the EXIF orientation is not applied".to_owned(),
            Note::Inks => {
                "its CMYK inks are converted to RGB without a colour profile, as ink times black"
                    .to_owned()
            }
            Note::GuidesElsewhere { what, channels } => {
                format!(
                    "{channels} is not used as the {what}: it belongs to another view or layer than the colour; \
                     to use it, give its full name with {{guides}}"
                )
            }
            Note::UnrealMotion => {
                "Unreal's motion is read as 2 (v - 0.5) of the frame, x from right to left, y from bottom to top; \
                 Unreal documents neither scale nor direction: check it with a known motion (an experiment can give \
                 channels, sign, scale and unit instead)"
                    .to_owned()
            }
            Note::AssumedFalcor => {
                "R and G are read as the motion that Falcor writes, in fractions of the frame; \
                 if another renderer wrote them, name it with {guides}"
                    .to_owned()
            }
            Note::UncoveredGuides => {
                "the data window of motion or depth does not cover the display window; uncovered pixels have none"
                    .to_owned()
            }
        }
    }
}
