//! Errors of files that cannot be read.

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
    /// It is not a regular file but a device, a pipe or the like.
    #[error("it is not a regular file")]
    NotRegular,
    /// It is a link to a file that does not exist, as git-annex and DVC leave them.
    #[error("it is a link to {}, which does not exist", .0.display())]
    Dangling(PathBuf),
    /// The operating system reports an error.
    #[error("{}", io_reason(.0))]
    Io(#[from] io::Error),
    /// Its first bytes are not those of PNG, JPEG or OpenEXR.
    #[error("this is not a PNG, JPEG or OpenEXR file")]
    NotAnImage,
    /// The decoder cannot decode it.
    #[error("the {format} data is damaged or cut short: {detail}")]
    Damaged {
        /// `PNG`, `JPEG` or `OpenEXR`.
        format: &'static str,
        /// The decoder's message.
        detail: String,
    },
    /// The file is intact, but of a kind that fovqa does not read.
    #[error("this kind of OpenEXR file is not supported: {detail}")]
    Unsupported {
        /// The decoder's message.
        detail: String,
    },
    /// The JPEG may be intact, but is of a kind that fovqa does not read.
    #[error("this kind of JPEG file is not supported: {0}")]
    UnsupportedJpeg(JpegKind),
    /// It has more pixels than the limit.
    #[error(
        "it declares {width}x{height} pixels, more than the limit of {limit_megapixels} megapixels"
    )]
    TooLarge {
        /// Declared width.
        width: u64,
        /// Declared height.
        height: u64,
        /// The limit in megapixels.
        limit_megapixels: u64,
    },
    /// One block has more bytes than the largest frame.
    #[error("it declares blocks of {bytes} bytes, more than the largest frame may have")]
    BlockTooLarge {
        /// Size of one block with all its channels, in bytes.
        bytes: u64,
    },
    /// Alpha is not 1 everywhere.
    #[error(
        "its alpha is not 1 everywhere ({transparent} pixels, the first at ({x}, {y}) with {value})"
    )]
    Alpha {
        /// Number of pixels whose alpha is not 1.
        transparent: u64,
        /// Column of the first one.
        x: usize,
        /// Row of the first one.
        y: usize,
        /// Alpha of the first one, 0 to 1.
        value: f32,
    },
    /// Alpha is 0 everywhere.
    #[error("its alpha is 0 everywhere, as in engine captures without alpha")]
    AllTransparent,
    /// It holds deep data.
    #[error("it contains deep data, which is not supported: a pixel has no single colour")]
    Deep,
    /// It has no colour channels.
    #[error("it has no colour: no layer has R, G and B, or Y alone; its channels are {channels}")]
    NoColour {
        /// The channels that it has.
        channels: String,
    },
    /// A layer has a luminance whose chroma channels are missing or not supported.
    #[error("its layer {layer} has the channels {channels}; this colour encoding is not supported")]
    OtherEncoding {
        /// The layer.
        layer: String,
        /// The channels of the layer.
        channels: String,
    },
    /// A layer of Cryptomatte was asked for as colour.
    #[error("its layer {layer:?} contains Cryptomatte IDs, not colour")]
    Cryptomatte {
        /// The layer.
        layer: String,
    },
    /// Its headers have too many or too long attributes.
    #[error("its header has {what}, more than the limit of {limit}")]
    Header {
        /// What exceeds the limit.
        what: String,
        /// The limit.
        limit: String,
    },
    /// It has several colour layers.
    #[error("it has several colour layers: {layers}")]
    SeveralLayers {
        /// Names of the layers.
        layers: String,
    },
    /// The layer does not exist.
    #[error("it has no colour layer {wanted:?}; it has: {layers}")]
    NoSuchLayer {
        /// The layer that was asked for.
        wanted: String,
        /// The layers that exist.
        layers: String,
    },
    /// A channel has a lower resolution than the picture.
    #[error("channel {channel} is subsampled; files with such channels are not supported")]
    Subsampled {
        /// The channel.
        channel: String,
    },
    /// Data window and display window have no pixel in common.
    #[error("its data window {data} lies outside its display window {display}")]
    DisjointWindows {
        /// The data window as `WxH+X+Y`.
        data: String,
        /// The display window as `WxH+X+Y`.
        display: String,
    },
    /// The chromaticities do not span a colour space.
    #[error("its chromaticities attribute does not span a colour space")]
    Chromaticities,
    /// A file of motion or depth is not OpenEXR.
    #[error("this is not an OpenEXR file; motion and depth are only read from OpenEXR")]
    NotOpenExr,
    /// It has no motion, or no depth.
    #[error("it has no {what} channel (searched for {wanted}); its channels are {channels}")]
    NoGuide {
        /// `motion` or `depth`.
        what: &'static str,
        /// The names that were looked for.
        wanted: String,
        /// The channels that exist.
        channels: String,
    },
    /// Several channels could be the motion, or the depth.
    #[error("several of its channels could be the {what}: {channels}")]
    SeveralGuides {
        /// `motion` or `depth`.
        what: &'static str,
        /// These channels.
        channels: String,
    },
    /// Motion, or depth, exists only for another view or layer.
    #[error("it has no {what} for the view and layer of the colour, only {channels}")]
    GuidesElsewhere {
        /// `motion` or `depth`.
        what: &'static str,
        /// These channels.
        channels: String,
    },
    /// Parts have different display windows, so that their pixels do not coincide.
    #[error("its parts have different display windows")]
    DisplayWindows,
}

impl ReadErrorKind {
    pub(crate) fn at(self, path: &Path) -> ReadError {
        ReadError { path: path.to_owned(), kind: self }
    }

    /// How to correct the error. Settings are in braces, as in `{alpha=ignore}`: the caller shows
    /// them in the user's notation.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Io(error) if error.kind() == io::ErrorKind::NotFound => {
                "check the path; a relative one starts in {start}"
            }
            Self::NotRegular => "give a file, a folder or a pattern",
            Self::Dangling(_) => "fetch the file (git annex get, dvc pull), or render it again",
            Self::Io(_) => "check that it is a file and can be read",
            Self::NotAnImage => "convert it to PNG or OpenEXR",
            Self::Damaged { .. } => "render or copy it again",
            Self::Unsupported { .. } => "save it again with another compression, such as ZIP",
            Self::UnsupportedJpeg(kind) => kind.help(),
            Self::TooLarge { .. } | Self::BlockTooLarge { .. } => {
                "raise {max_megapixels} if the size is correct"
            }
            Self::Alpha { .. } => {
                "{alpha=ignore} ignores it, {alpha=over-black} composites the image over black"
            }
            Self::AllTransparent => "use {alpha=ignore}: the colours are usually complete",
            Self::Deep => "flatten it to one colour a pixel first",
            Self::NoColour { .. } => {
                "give the file that holds the beauty pass, as R, G and B (X, Y, Z and H, S, V are not converted)"
            }
            Self::OtherEncoding { .. } => {
                "save it as R, G and B, or as Y, RY and BY at full resolution"
            }
            Self::Cryptomatte { .. } => "name a colour layer with {layer}, or leave it out",
            Self::Header { .. } => {
                "save the file again without attributes that are not needed for its pixels"
            }
            Self::SeveralLayers { .. } => "name one with {layer}",
            Self::NoSuchLayer { .. } => "name one of these with {layer}",
            Self::Subsampled { .. } => "save it with every channel at full resolution",
            Self::DisjointWindows { .. } => {
                "no pixel would be visible: check the region of the render"
            }
            Self::Chromaticities => "write the file with valid primaries, or without the attribute",
            Self::NotOpenExr => "save motion and depth as OpenEXR",
            Self::NoGuide { .. } => "render them, or name the channels with {guides}",
            Self::SeveralGuides { .. } | Self::GuidesElsewhere { .. } => {
                "name the right one, with its layer in front, with {guides}"
            }
            Self::DisplayWindows => "save all parts with the display window of the colour",
        }
    }
}

/// Names separated by commas, limited to what a message can hold.
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
