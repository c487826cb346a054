//! Code that videos in files and in streams share.

use std::io::{self, BufRead, Read};
use std::path::PathBuf;

use fovqa_frame::Frame;
use fovqa_frame::source::{MissingGuides, Picture, PictureGuides, SourceError};

use super::convert::{BadCode, Conversion};
use super::header::{Header, MAX_LINE};
use crate::error::{ReadError, ReadErrorKind};
use crate::guides::{DepthChannels, GuideOptions, MotionChannels};
use crate::read_options::ReadOptions;

/// The line in front of the pixels.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// A complete line, without its line end.
    Whole(Vec<u8>),
    /// The video has ended.
    None,
    /// The remaining bytes, which have no line end.
    Cut(Vec<u8>),
    /// The first bytes of a line that is longer than [`MAX_LINE`].
    TooLong(Vec<u8>),
}

/// Reads the next line.
pub(super) fn read_line(reader: &mut impl BufRead) -> io::Result<Line> {
    let mut line = Vec::new();
    reader.by_ref().take(MAX_LINE as u64).read_until(b'\n', &mut line)?;
    Ok(match line.pop() {
        None => Line::None,
        Some(b'\n') => Line::Whole(line),
        Some(last) => {
            line.push(last);
            if line.len() == MAX_LINE { Line::TooLong(line) } else { Line::Cut(line) }
        }
    })
}

/// The reason why a line does not begin a frame, and how to correct it. `None` if it does begin
/// one.
pub(super) fn not_a_frame(line: &Line) -> Option<(String, &'static str)> {
    let (bytes, cut) = match line {
        Line::Whole(bytes) if bytes == b"FRAME" || bytes.starts_with(b"FRAME ") => return None,
        Line::Whole(bytes) | Line::TooLong(bytes) => (bytes, false),
        Line::Cut(bytes) => (bytes, b"FRAME".starts_with(bytes) || bytes.starts_with(b"FRAME ")),
        Line::None => (&Vec::new(), true),
    };
    if cut {
        return Some(("it is cut short before its pixels".to_owned(), AGAIN));
    }
    if bytes.starts_with(super::header::MAGIC) {
        let message = "another video begins here, whose frames may have another size".to_owned();
        return Some((message, "give each video as a separate file"));
    }
    let begins: String = String::from_utf8_lossy(&bytes[..bytes.len().min(16)]).into_owned();
    Some((format!("it begins with {begins:?} instead of FRAME"), AGAIN))
}

/// How to repair a damaged video.
pub(super) const AGAIN: &str = "copy or write the video again";

/// A video whose header has been read.
#[derive(Debug)]
pub(super) struct Video {
    /// The name of the video in results and messages.
    pub(super) name: String,
    pub(super) header: Header,
    conversion: Conversion,
    guides: GuideOptions,
}

impl Video {
    /// Reads the header.
    pub(super) fn begin(
        name: String,
        reader: &mut impl BufRead,
        options: &ReadOptions,
    ) -> Result<Self, SourceError> {
        let refused =
            |what: &str, help: &str| SourceError::new(format!("{name}: {what}"), help.to_owned());
        let write = "give a video that ffmpeg -f yuv4mpegpipe has written";
        let line = match read_line(reader).map_err(|error| unreadable(&name, &error))? {
            Line::Whole(line) => line,
            Line::None => {
                return Err(refused("it is empty, where a y4m video should begin", write));
            }
            Line::Cut(line) | Line::TooLong(line) if !line.starts_with(super::header::MAGIC) => {
                return Err(refused("it does not begin with YUV4MPEG2", write));
            }
            Line::Cut(_) => return Err(refused("its header is cut short", write)),
            Line::TooLong(_) => {
                let what = format!("its header is longer than {MAX_LINE} bytes");
                return Err(refused(&what, write));
            }
        };
        let header = Header::parse(&line, options.max_megapixels)
            .map_err(|(message, help)| refused(&message, help))?;
        let conversion = Conversion::new(&header, options.formats.y4m);
        Ok(Self { name, header, conversion, guides: options.guides.clone() })
    }

    /// An error of a frame.
    pub(super) fn error(&self, frame: usize, what: &str, help: &str) -> SourceError {
        SourceError::new(format!("{}, frame {frame}: {what}", self.name), help)
    }

    /// The error for a frame after the end.
    pub(super) fn ended(&self, frames: usize) -> SourceError {
        let frames = if frames == 1 { "1 frame" } else { &format!("{frames} frames") };
        self.end(&format!("ends after {frames}"))
    }

    /// The error for a frame after a damaged one.
    pub(super) fn damaged(&self, whole: usize) -> SourceError {
        match whole {
            0 => self.end("is damaged from its beginning"),
            1 => self.end("is damaged after its first frame"),
            _ => self.end(&format!("is damaged after its first {whole} frames")),
        }
    }

    fn end(&self, how: &str) -> SourceError {
        SourceError {
            has_ended: true,
            ..SourceError::new(format!("{} {how}", self.name), "check which frames are requested")
        }
    }

    /// The error for a frame whose pixels are incomplete.
    pub(super) fn cut(&self, frame: usize, bytes: u64) -> SourceError {
        let what = format!(
            "it is cut short: only {bytes} of {} bytes are present",
            self.header.frame_bytes()
        );
        self.error(frame, &what, AGAIN)
    }

    /// The memory for a pixel, in bytes.
    pub(super) fn bytes_per_pixel(&self) -> u64 {
        if self.header.colour.chroma.is_some() { 12 } else { 4 }
    }

    /// The picture of a frame's bytes.
    pub(super) fn picture(
        &self,
        frame: usize,
        bytes: &[u8],
        guides: bool,
    ) -> Result<Picture, SourceError> {
        let converted = self.conversion.frame(&self.header, bytes);
        let picture: Frame = converted.map_err(|BadCode { plane, x, y, code }| {
            let bits = self.header.colour.bits;
            let what = format!(
                "{plane} at ({x}, {y}) of its plane is {code}, more than {bits} bits can hold"
            );
            self.error(frame, &what, "write it again with the colour tag that fits its samples")
        })?;
        let missing = if guides { self.missing() } else { MissingGuides::default() };
        Ok(Picture { missing, pixel_aspect: self.header.pixel_aspect, ..Picture::new(picture) })
    }

    /// The error that a video has neither motion nor depth.
    pub(super) fn no_guides(&self) -> Result<PictureGuides, SourceError> {
        Err(self.not_open_exr())
    }

    /// The motion or depth that the user has named. What is looked for automatically may be
    /// missing.
    fn missing(&self) -> MissingGuides {
        let motion = !matches!(self.guides.motion, MotionChannels::None | MotionChannels::Auto);
        let depth = !matches!(self.guides.depth, DepthChannels::None | DepthChannels::Auto);
        MissingGuides {
            motion: motion.then(|| self.not_open_exr()),
            depth: depth.then(|| self.not_open_exr()),
        }
    }

    fn not_open_exr(&self) -> SourceError {
        let path = PathBuf::from(&self.name);
        SourceError::from(ReadError { path, kind: ReadErrorKind::NotOpenExr })
    }
}

/// An error of the operating system.
pub(super) fn unreadable(name: &str, error: &io::Error) -> SourceError {
    SourceError::new(
        format!("{name}: it cannot be read: {error}"),
        "check that it exists and can be read",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_an_end_and_a_limit() {
        let of = |bytes: &[u8]| read_line(&mut &bytes[..]).unwrap();
        assert_eq!(of(b""), Line::None);
        assert_eq!(of(b"\n"), Line::Whole(Vec::new()));
        assert_eq!(of(b"FRAME Ip\nab"), Line::Whole(b"FRAME Ip".to_vec()));
        assert_eq!(of(b"FRA"), Line::Cut(b"FRA".to_vec()));
        assert_eq!(of(&[b'a'; MAX_LINE]), Line::TooLong(vec![b'a'; MAX_LINE]));
        let mut longest = vec![b'a'; MAX_LINE - 1];
        longest.push(b'\n');
        assert_eq!(of(&longest), Line::Whole(vec![b'a'; MAX_LINE - 1]));
    }

    #[test]
    fn a_frame_begins_with_its_word() {
        let why = |line: Line| not_a_frame(&line).map(|(message, _)| message);
        assert_eq!(why(Line::Whole(b"FRAME".to_vec())), None);
        assert_eq!(why(Line::Whole(b"FRAME Ip".to_vec())), None);
        for (line, said) in [
            (Line::Whole(b"FRAMES".to_vec()), "it begins with \"FRAMES\" instead"),
            (Line::Whole(b"YUV4MPEG2 W2 H2".to_vec()), "another video begins"),
            (Line::Cut(b"FRA".to_vec()), "cut short before its pixels"),
            (Line::Cut(b"XYZ".to_vec()), "it begins with \"XYZ\""),
            (Line::TooLong(vec![0; 40]), "instead of FRAME"),
        ] {
            let message = why(line).unwrap();
            assert!(message.contains(said), "{message}");
        }
    }
}
