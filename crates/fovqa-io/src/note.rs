//! Remarks about a file that can be read, but whose reader should know something.

/// Something about a file that its reader should know, though it can be read.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Note {
    /// Colour chunks that are not applied: their names.
    ColourChunks(String),
    /// The data window does not cover the display window; the rest is 0.
    UncoveredPixels,
    /// Chromaticities were converted to Rec.709.
    ConvertedPrimaries,
    /// An EXIF orientation that is not applied.
    Orientation,
    /// Inks were converted to RGB without a colour profile.
    Inks,
    /// The data window of motion or depth does not cover the display window; the rest is NaN.
    UncoveredGuides,
    /// Motion or depth is there, but not for the colour's view or layer, and is not taken.
    GuidesElsewhere {
        /// `motion` or `depth`.
        what: &'static str,
        /// The channels there are.
        channels: String,
    },
    /// Motion as Unreal encodes it, whose scale has no official source.
    UnrealMotion,
    /// Motion in R and G of a file of its own, taken as Falcor writes it.
    AssumedFalcor,
}

impl Note {
    /// The note as one sentence; settings stand in braces, as in [`ReadErrorKind::help`].
    pub fn in_words(&self) -> String {
        match self {
            Note::ColourChunks(names) => {
                format!(
                    "the colour chunk {names} is not applied; values are taken as sRGB unless {{transfer}} says otherwise"
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
                    "{channels} is not taken for the {what}: it belongs to another view or layer than the colour; \
                     if it is meant, name it in full with {{guides}}"
                )
            }
            Note::UnrealMotion => {
                "Unreal's motion is read as 2 (v - 0.5) of the frame, x from right to left, y from bottom to top; \
                 Unreal documents neither scale nor direction: try it on a known motion (an experiment may give \
                 channels, sign, scale and unit instead)"
                    .to_owned()
            }
            Note::AssumedFalcor => {
                "R and G are read as the motion that Falcor writes, in fractions of the frame; \
                 name the renderer with {guides} if it is another one"
                    .to_owned()
            }
            Note::UncoveredGuides => {
                "the data window of motion or depth does not cover the display window; uncovered pixels have none"
                    .to_owned()
            }
        }
    }
}
