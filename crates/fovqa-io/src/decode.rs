//! One file to one frame.

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

use fovqa_frame::source::InputId;
use fovqa_frame::{Frame, Guides, Mask};
use serde::{Deserialize, Serialize};

use crate::alpha::AlphaPolicy;
use crate::contain::contained;
use crate::error::{ReadError, ReadErrorKind};
use crate::guides::{GuideOptions, GuideSearch};
use crate::input_id::id_of;
use crate::sources::FormatOptions;
use crate::{exr, jpeg, png};

/// How files are read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReadOptions {
    /// The colour layer of OpenEXR files that have several.
    pub layer: Option<String>,
    /// What to do with alpha.
    pub alpha: AlphaPolicy,
    /// Most pixels a file may declare, in millions.
    pub max_megapixels: u64,
    /// Motion and depth to read beside the colour.
    pub guides: GuideOptions,
    /// What is of one format alone.
    #[serde(default)]
    pub formats: FormatOptions,
}

impl Default for ReadOptions {
    /// No layer, alpha an error, no guides, 256 megapixels: three times the retinal resolution of
    /// the papers (11520x6480), 768 MB of 8-bit RGB.
    fn default() -> Self {
        Self {
            layer: None,
            alpha: AlphaPolicy::Error,
            max_megapixels: 256,
            guides: GuideOptions::default(),
            formats: FormatOptions::default(),
        }
    }
}

impl ReadOptions {
    /// Refuses a declared size before anything is allocated for it.
    pub(crate) fn check_size(&self, width: u64, height: u64) -> Result<(), ReadErrorKind> {
        let limit = self.max_megapixels.saturating_mul(1_000_000);
        if width.saturating_mul(height) > limit {
            let limit_megapixels = self.max_megapixels;
            return Err(ReadErrorKind::TooLarge { width, height, limit_megapixels });
        }
        Ok(())
    }

    /// Refuses a block that no frame within the limit could have: decoders allocate it whole.
    pub(crate) fn check_block(&self, bytes: u64) -> Result<(), ReadErrorKind> {
        /// Three floats and something to spare for each pixel of the largest frame.
        const BYTES_A_PIXEL: u64 = 16;
        let limit = self.max_megapixels.saturating_mul(1_000_000 * BYTES_A_PIXEL);
        if bytes > limit { Err(ReadErrorKind::BlockTooLarge { bytes }) } else { Ok(()) }
    }
}

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

/// A frame and what there is to say about its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded {
    /// The frame.
    pub frame: Frame,
    /// Remarks.
    pub notes: Vec<Note>,
    /// Motion and depth, where they were asked for and are there.
    pub guides: Guides,
    /// What was looked for to find them.
    pub guide_search: GuideSearch,
    /// Width of a pixel over its height, as the file declares it; 1 where it declares nothing.
    pub pixel_aspect: f32,
}

impl Decoded {
    /// A frame of a file that cannot hold guides.
    pub(crate) fn without_guides(frame: Frame, notes: Vec<Note>, options: &ReadOptions) -> Self {
        let guide_search = GuideSearch::in_vain(&options.guides);
        Self { frame, notes, guides: Guides::default(), guide_search, pixel_aspect: 1.0 }
    }
}

const PNG_MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";
const JPEG_MAGIC: &[u8] = b"\xff\xd8\xff";
pub(crate) const EXR_MAGIC: &[u8] = b"\x76\x2f\x31\x01";

/// Reads a PNG, JPEG or OpenEXR file; its first bytes tell which, not its name.
///
/// # Errors
/// When the file cannot be read, is none of these, is damaged or too large, or does not fit the
/// options. A decoder that panics is an error too.
pub fn read_frame(path: &Path, options: &ReadOptions) -> Result<Decoded, ReadError> {
    open(path).and_then(|file| decode(file, options)).map_err(|kind| kind.at(path))
}

/// The same, and the identity of the bytes that were decoded.
///
/// # Errors
/// As [`read_frame`].
pub fn read_frame_and_hash(
    path: &Path,
    options: &ReadOptions,
) -> Result<(Decoded, InputId), ReadError> {
    hashed(path, |file| decode(file, options))
}

/// What is decoded of a file, with the identity of its bytes.
pub(crate) fn hashed<T>(
    path: &Path,
    decode: impl FnOnce(File) -> Result<T, ReadErrorKind>,
) -> Result<(T, InputId), ReadError> {
    let read = || {
        let mut file = open(path)?;
        // One more pass over the file, whose pages are in memory from then on: no decoder reads all
        // of its bytes in order. The same open file, so that another one put in its place is not
        // taken for it.
        let id = id_of(&mut file)?;
        file.rewind()?;
        Ok((decode(file)?, id))
    };
    read().map_err(|kind: ReadErrorKind| kind.at(path))
}

/// Opens a regular file.
pub(crate) fn open(path: &Path) -> Result<File, ReadErrorKind> {
    let kind = match std::fs::metadata(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Err(std::fs::read_link(path).map_or(error.into(), ReadErrorKind::Dangling));
        }
        found => found?,
    };
    if kind.is_dir() {
        return Err(std::io::Error::from(std::io::ErrorKind::IsADirectory).into());
    }
    // Before it is opened, which a pipe without a writer would never end.
    if !kind.is_file() {
        return Err(ReadErrorKind::NotRegular);
    }
    Ok(File::open(path)?)
}

fn decode(file: File, options: &ReadOptions) -> Result<Decoded, ReadErrorKind> {
    contained(|| decode_by_magic(file, options)).unwrap_or_else(|| {
        let detail = "the decoder broke down on it".to_owned();
        Err(ReadErrorKind::Damaged { format: "image", detail })
    })
}

/// A file, and its first bytes.
pub(crate) fn buffered(file: File) -> Result<(BufReader<File>, Vec<u8>), ReadErrorKind> {
    /// Large enough to keep system calls rare, small enough for the second-level cache.
    const BUFFER: usize = 256 << 10;
    let mut file = BufReader::with_capacity(BUFFER, file);
    let mut magic = Vec::with_capacity(8);
    file.by_ref().take(8).read_to_end(&mut magic)?;
    file.rewind()?;
    Ok((file, magic))
}

fn decode_by_magic(file: File, options: &ReadOptions) -> Result<Decoded, ReadErrorKind> {
    let (file, magic) = buffered(file)?;
    if magic.starts_with(PNG_MAGIC) {
        png::read(file, options)
    } else if magic.starts_with(JPEG_MAGIC) {
        jpeg::read(file, options)
    } else if magic.starts_with(EXR_MAGIC) {
        exr::read(file, options)
    } else {
        Err(ReadErrorKind::NotAnImage)
    }
}

/// The size of the frame in a file: its declared width and height, or those of its display window.
/// Reads its header alone.
///
/// # Errors
/// When the header cannot be read; whether the rest can is not known then.
pub fn frame_size(path: &Path) -> Result<(usize, usize), ReadError> {
    let read = || {
        let file = open(path)?;
        contained(|| {
            let mut file = BufReader::new(file);
            let mut magic = Vec::with_capacity(8);
            file.by_ref().take(8).read_to_end(&mut magic)?;
            file.rewind()?;
            if magic.starts_with(EXR_MAGIC) {
                exr::size(file)
            } else if magic.starts_with(PNG_MAGIC) {
                png::size(file)
            } else if magic.starts_with(JPEG_MAGIC) {
                jpeg::size(file)
            } else {
                Err(ReadErrorKind::NotAnImage)
            }
        })
        .unwrap_or(Err(ReadErrorKind::NotAnImage))
    };
    read().map_err(|kind| kind.at(path))
}

/// Reads a mask: white (every channel above half of full scale) is visible. Alpha is ignored.
///
/// # Errors
/// As [`read_frame`].
pub fn read_mask(path: &Path, options: &ReadOptions) -> Result<Mask, ReadError> {
    let guides = GuideOptions::default();
    let options = ReadOptions { alpha: AlphaPolicy::Ignore, guides, ..options.clone() };
    let frame = read_frame(path, &options)?.frame;
    let (width, height, channels) = (frame.width(), frame.height(), frame.channels().count());
    let half = match frame.samples() {
        fovqa_frame::Samples::U8(_) => 127.5,
        fovqa_frame::Samples::U16(_) => 32767.5,
        fovqa_frame::Samples::F16(_) | fovqa_frame::Samples::F32(_) => 0.5,
    };
    let valid = (0..width * height)
        .map(|i| (0..channels).all(|c| frame.sample(c, i % width, i / width) > half))
        .collect();
    Ok(Mask::new(width, height, valid).unwrap_or_else(|| unreachable!("one flag a pixel")))
}
