//! The colour tag of a header: bits, subsampling, and the position of chroma samples.

/// The format of a video's samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Colour {
    /// 8, 10 or 12. Above 8 bits, a sample is a little-endian word of two bytes.
    pub(super) bits: u32,
    /// The sampling of Cb and Cr; `None` if there is only Y'.
    pub(super) chroma: Option<Chroma>,
}

/// The sampling of Cb and Cr.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Chroma {
    pub(super) across: Sampling,
    pub(super) down: Sampling,
}

/// The chroma samples in one direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sampling {
    /// One per pixel.
    Each,
    /// One per two pixels, halfway between them.
    HalfCentred,
    /// One per two pixels, at the position of the first.
    HalfFirst,
}

impl Sampling {
    /// The number of samples in a direction with this number of pixels.
    pub(super) fn count(self, pixels: usize) -> usize {
        match self {
            Self::Each => pixels,
            Self::HalfCentred | Self::HalfFirst => pixels.div_ceil(2),
        }
    }
}

const FULL: Chroma = Chroma { across: Sampling::Each, down: Sampling::Each };
const HALF_ACROSS: Chroma = Chroma { across: Sampling::HalfFirst, down: Sampling::Each };
const CENTRED: Chroma = Chroma { across: Sampling::HalfCentred, down: Sampling::HalfCentred };
const LEFT: Chroma = Chroma { across: Sampling::HalfFirst, down: Sampling::HalfCentred };

/// All tags that are supported. 4:2:0 with more than 8 bits is left-sited, as today's encoders
/// write it.
const TAGS: [(&str, u32, Option<Chroma>); 15] = [
    ("420", 8, Some(CENTRED)),
    ("420jpeg", 8, Some(CENTRED)),
    ("420mpeg2", 8, Some(LEFT)),
    ("420paldv", 8, Some(LEFT)),
    ("420p10", 10, Some(LEFT)),
    ("420p12", 12, Some(LEFT)),
    ("422", 8, Some(HALF_ACROSS)),
    ("422p10", 10, Some(HALF_ACROSS)),
    ("422p12", 12, Some(HALF_ACROSS)),
    ("444", 8, Some(FULL)),
    ("444p10", 10, Some(FULL)),
    ("444p12", 12, Some(FULL)),
    ("mono", 8, None),
    ("mono10", 10, None),
    ("mono12", 12, None),
];

impl Colour {
    /// The format that a tag stands for. The error says why the tag is not supported.
    pub(super) fn of_tag(tag: &str) -> Result<Self, String> {
        if let Some((_, bits, chroma)) = TAGS.iter().find(|(name, ..)| *name == tag) {
            return Ok(Self { bits: *bits, chroma: *chroma });
        }
        let why = if tag.contains("alpha") { ", which has alpha" } else { "" };
        let known: Vec<&str> = TAGS.iter().map(|(name, ..)| *name).collect();
        let tag: String = tag.chars().take(32).flat_map(char::escape_debug).collect();
        Err(format!("its colour tag is C{tag}{why}; the supported tags are {}", known.join(", ")))
    }

    /// The format of a video without a tag.
    pub(super) fn untagged() -> Self {
        Self { bits: 8, chroma: Some(CENTRED) }
    }

    /// Size of a sample in bytes.
    pub(super) fn sample_bytes(self) -> usize {
        if self.bits > 8 { 2 } else { 1 }
    }

    /// The largest code.
    pub(super) fn greatest(self) -> u16 {
        (1 << self.bits) - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsupported_tags_are_reported() {
        assert_eq!(Colour::of_tag("420jpeg"), Ok(Colour::untagged()));
        let error = Colour::of_tag("444alpha").unwrap_err();
        assert!(error.starts_with("its colour tag is C444alpha, which has alpha; "), "{error}");
        let error = Colour::of_tag("420p16").unwrap_err();
        assert!(error.contains("C420p16; the supported tags are 420, 420jpeg, "), "{error}");
        assert!(!Colour::of_tag("4\u{1b}[2J").unwrap_err().contains('\u{1b}'));
    }

    #[test]
    fn an_odd_side_has_half_a_sample_more() {
        assert_eq!(Sampling::HalfFirst.count(5), 3);
        assert_eq!(Sampling::HalfCentred.count(1), 1);
        assert_eq!(Sampling::Each.count(5), 5);
    }
}
