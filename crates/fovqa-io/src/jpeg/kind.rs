//! Kinds of JPEG that are not supported, although the file may be intact.

use std::fmt;

/// The reason why an intact JPEG is not supported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum JpegKind {
    /// Arithmetic instead of Huffman coding.
    Arithmetic,
    /// Lossless coding (SOF3).
    Lossless,
    /// Hierarchical coding: several frames of growing size.
    Hierarchical,
    /// JPEG-LS, a different standard with the same markers.
    JpegLs,
    /// More or fewer than 8 bits per sample.
    Precision {
        /// Bits per sample.
        bits: u8,
    },
    /// The number of components is not 1, 3 or 4.
    Components {
        /// The number of components.
        count: usize,
    },
    /// The ratio of a component's resolution to the image's is not 1 divided by a whole number.
    Sampling {
        /// The sampling factors of the component, horizontal x vertical.
        factors: (usize, usize),
        /// The largest sampling factors of the file.
        largest: (usize, usize),
    },
    /// Adobe's marker does not define this colour transform for this number of components.
    ColourTransform {
        /// The number of the transform.
        transform: u8,
        /// The number of components of the file.
        components: usize,
    },
}

impl fmt::Display for JpegKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Arithmetic => f.write_str("arithmetic coding"),
            Self::Lossless => f.write_str("lossless coding"),
            Self::Hierarchical => f.write_str("hierarchical coding"),
            Self::JpegLs => f.write_str("JPEG-LS"),
            Self::Precision { bits } => write!(f, "{bits} bits per sample"),
            Self::Components { count } => write!(f, "{count} components"),
            Self::Sampling { factors: (h, v), largest: (max_h, max_v) } => write!(
                f,
                "a component with {h}x{v} samples where others have {max_h}x{max_v}, which is not an integer ratio"
            ),
            Self::ColourTransform { transform, components } => {
                write!(f, "colour transform {transform} with {components} components")
            }
        }
    }
}

impl JpegKind {
    /// How to convert the file to a supported kind.
    pub(crate) fn help(&self) -> &'static str {
        match self {
            Self::Arithmetic => {
                "convert it to PNG, for instance with `djpeg in.jpg | pnmtopng > out.png` or `magick in.jpg out.png`"
            }
            Self::Lossless | Self::Precision { .. } => {
                "convert it to PNG with a program that reads this kind, for instance with libjpeg-turbo 3: `djpeg in.jpg | pnmtopng > out.png`"
            }
            Self::JpegLs => {
                "convert it to PNG with a program that reads JPEG-LS, for instance with `ffmpeg -i in.jpg out.png`"
            }
            Self::Hierarchical => {
                "save the image as PNG with the program that wrote it; common decoders do not read this kind"
            }
            Self::Components { .. } | Self::ColourTransform { .. } => {
                "save the image as PNG, gray or RGB, with the program that wrote it"
            }
            Self::Sampling { .. } => {
                "save the image as PNG, or as JPEG with another chroma subsampling such as 4:2:0; common decoders do not read this kind"
            }
        }
    }
}
