//! What can be wrong with a file.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::jpeg::kind::JpegKind;

/// A file that could not be read as a frame, and why.
#[derive(Debug, Error)]
#[error("{}: {kind}", path.display())]
pub struct ReadError {
    /// The file.
    pub path: PathBuf,
    /// The reason.
    #[source]
    pub kind: ReadErrorKind,
}

/// Why a file could not be read as a frame.
#[derive(Debug, Error)]
pub enum ReadErrorKind {
    /// A device, a pipe or the like.
    #[error("it is not a regular file")]
    NotRegular,
    /// A link to something that is not there, as git-annex and DVC leave them.
    #[error("it is a link to {}, which is not there", .0.display())]
    Dangling(PathBuf),
    /// The operating system refused.
    #[error("{}", io_reason(.0))]
    Io(#[from] io::Error),
    /// Neither PNG, JPEG nor OpenEXR by its first bytes.
    #[error("this is not a PNG, JPEG or OpenEXR file")]
    NotAnImage,
    /// The decoder gave up.
    #[error("the {format} data is damaged or cut short: {detail}")]
    Damaged {
        /// `PNG`, `JPEG` or OpenEXR.
        format: &'static str,
        /// The decoder's words.
        detail: String,
    },
    /// A file that is whole, but of a kind that is not read.
    #[error("it is an OpenEXR file of a kind that is not read: {detail}")]
    Unsupported {
        /// The decoder's words.
        detail: String,
    },
    /// A JPEG that may be whole, but of a kind that is not read.
    #[error("it is a JPEG of a kind that is not read: {0}")]
    UnsupportedJpeg(JpegKind),
    /// More pixels than the limit.
    #[error(
        "it declares {width}x{height} pixels, more than the limit of {limit_megapixels} megapixels"
    )]
    TooLarge {
        /// Declared width.
        width: u64,
        /// Declared height.
        height: u64,
        /// The limit.
        limit_megapixels: u64,
    },
    /// One block of more bytes than the largest frame.
    #[error("it declares blocks of {bytes} bytes, more than the largest frame may have")]
    BlockTooLarge {
        /// Bytes of one block with all its channels.
        bytes: u64,
    },
    /// Alpha that is not 1 everywhere.
    #[error(
        "its alpha is not 1 everywhere ({transparent} pixels, the first at ({x}, {y}) with {value})"
    )]
    Alpha {
        /// Pixels whose alpha is not 1.
        transparent: u64,
        /// Column of the first.
        x: usize,
        /// Row of the first.
        y: usize,
        /// Its alpha, 0 to 1.
        value: f32,
    },
    /// Alpha that is 0 everywhere.
    #[error("its alpha is 0 everywhere, as engines leave it when they capture without alpha")]
    AllTransparent,
    /// Deep data.
    #[error("it holds deep data, which has no single colour a pixel")]
    Deep,
    /// No colour channels.
    #[error("it has no colour: no layer has R, G and B, or Y alone; its channels are {channels}")]
    NoColour {
        /// The channels there are.
        channels: String,
    },
    /// A luminance whose chroma is not there or not read.
    #[error(
        "its layer {layer} has the channels {channels}, an encoding of colour that is not read"
    )]
    OtherEncoding {
        /// The layer.
        layer: String,
        /// The channels.
        channels: String,
    },
    /// A layer of Cryptomatte that was asked for as colour.
    #[error("its layer {layer:?} holds the IDs of a Cryptomatte, which are no colour")]
    Cryptomatte {
        /// The layer.
        layer: String,
    },
    /// Headers with too many attributes, or too long ones.
    #[error("its header has {what}, more than the limit of {limit}")]
    Header {
        /// What there is too much of.
        what: String,
        /// The limit.
        limit: String,
    },
    /// Several colour layers.
    #[error("it has several colour layers: {layers}")]
    SeveralLayers {
        /// Their names.
        layers: String,
    },
    /// A layer that is not there.
    #[error("it has no colour layer {wanted:?}; it has: {layers}")]
    NoSuchLayer {
        /// What was asked for.
        wanted: String,
        /// What is there.
        layers: String,
    },
    /// Channels at a lower resolution than the picture.
    #[error("channel {channel} is subsampled, and files with such channels are not read")]
    Subsampled {
        /// The channel.
        channel: String,
    },
    /// Data window and display window without a common pixel.
    #[error("its data window {data} lies outside its display window {display}")]
    DisjointWindows {
        /// Data window as `WxH+X+Y`.
        data: String,
        /// Display window as `WxH+X+Y`.
        display: String,
    },
    /// Chromaticities that span no colour space.
    #[error("its chromaticities attribute does not span a colour space")]
    Chromaticities,
    /// A file of motion or depth that is not OpenEXR.
    #[error("this is not an OpenEXR file, the only kind that motion and depth are read from")]
    NotOpenExr,
    /// No motion, or no depth.
    #[error("it has no {what}, which was looked for as {wanted}; its channels are {channels}")]
    NoGuide {
        /// `motion` or `depth`.
        what: &'static str,
        /// The names that were looked for.
        wanted: String,
        /// The channels there are.
        channels: String,
    },
    /// Several channels that could be the motion, or the depth.
    #[error("several of its channels could be the {what}: {channels}")]
    SeveralGuides {
        /// `motion` or `depth`.
        what: &'static str,
        /// These channels.
        channels: String,
    },
    /// Motion, or depth, of another view or layer alone.
    #[error("it has no {what} of the colour's view and layer, only {channels}")]
    GuidesElsewhere {
        /// `motion` or `depth`.
        what: &'static str,
        /// These channels.
        channels: String,
    },
    /// Parts whose pixels do not lie on each other.
    #[error("its parts have different display windows")]
    DisplayWindows,
}

impl ReadErrorKind {
    pub(crate) fn at(self, path: &Path) -> ReadError {
        ReadError { path: path.to_owned(), kind: self }
    }

    /// How to mend it. Settings stand in braces, `{alpha=ignore}`: whoever shows it knows how its
    /// user writes them.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Io(error) if error.kind() == io::ErrorKind::NotFound => {
                "check the path; a relative one starts in {start}"
            }
            Self::NotRegular => "give a file, a folder or a pattern",
            Self::Dangling(_) => "fetch the file (git annex get, dvc pull), or render it again",
            Self::Io(_) => "check that it is a file and may be read",
            Self::NotAnImage => "convert it to PNG or OpenEXR",
            Self::Damaged { .. } => "render or copy it again",
            Self::Unsupported { .. } => "save it again with another compression, such as ZIP",
            Self::UnsupportedJpeg(kind) => kind.help(),
            Self::TooLarge { .. } | Self::BlockTooLarge { .. } => {
                "raise {max_megapixels} if the size is meant"
            }
            Self::Alpha { .. } => {
                "{alpha=ignore} drops it, {alpha=over-black} lays the image over black"
            }
            Self::AllTransparent => "use {alpha=ignore}: the colours are usually whole",
            Self::Deep => "flatten it to one colour a pixel first",
            Self::NoColour { .. } => {
                "give the file that holds the beauty pass, as R, G and B (X, Y, Z and H, S, V are not converted)"
            }
            Self::OtherEncoding { .. } => {
                "save it as R, G and B, or as Y, RY and BY at full resolution"
            }
            Self::Cryptomatte { .. } => "name a layer of colour with {layer}, or none",
            Self::Header { .. } => {
                "save the file again without attributes that are not needed for its pixels"
            }
            Self::SeveralLayers { .. } => "name one with {layer}",
            Self::NoSuchLayer { .. } => "name one of these with {layer}",
            Self::Subsampled { .. } => "save it with every channel at full resolution",
            Self::DisjointWindows { .. } => {
                "nothing of it would be seen: check the render's region"
            }
            Self::Chromaticities => "write the file with valid primaries, or without the attribute",
            Self::NotOpenExr => "save motion and depth as OpenEXR",
            Self::NoGuide { .. } => "render them, or name the channels with {guides}",
            Self::SeveralGuides { .. } | Self::GuidesElsewhere { .. } => {
                "name the one that is meant, its layer in front, with {guides}"
            }
            Self::DisplayWindows => "save all parts with the display window of the colour",
        }
    }
}

/// Names with commas between them, not more than a message holds.
pub(crate) fn listed(names: impl Iterator<Item = String>) -> String {
    const SHOWN: usize = 24;
    let names: Vec<String> = names.collect();
    let more = names.len().saturating_sub(SHOWN);
    let shown = names[..names.len() - more].join(", ");
    if more > 0 { format!("{shown} and {more} more") } else { shown }
}

fn io_reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder".to_owned(),
        _ => format!("it cannot be read: {error}"),
    }
}
