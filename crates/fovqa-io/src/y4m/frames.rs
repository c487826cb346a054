//! What the frames of a file and of a stream have in common.

use std::io::{self, BufRead, Read};
use std::path::PathBuf;

use fovqa_frame::Frame;
use fovqa_frame::source::{MissingGuides, Picture, PictureGuides, SourceError};

use super::convert::{BadCode, Conversion};
use super::header::{Header, MAX_LINE};
use crate::error::{ReadError, ReadErrorKind};
use crate::guides::{DepthChannels, GuideOptions, MotionChannels};
use crate::read_options::ReadOptions;

/// A line before pixels.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// Its bytes, without the end of the line.
    Whole(Vec<u8>),
    /// There is nothing more.
    None,
    /// All the bytes there are, without an end.
    Cut(Vec<u8>),
    /// The first bytes of a line of more than [`MAX_LINE`].
    TooLong(Vec<u8>),
}

/// The next line.
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

/// Why no frame begins with a line: what is wrong, and how to mend it. `None`: one does.
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
        let message = "another video begins here, whose frames may be of another size".to_owned();
        return Some((message, "give each video as a file of its own"));
    }
    let begins: String = String::from_utf8_lossy(&bytes[..bytes.len().min(16)]).into_owned();
    Some((format!("it begins with {begins:?} instead of FRAME"), AGAIN))
}

/// How to mend what is damaged.
pub(super) const AGAIN: &str = "copy or write the video again";

/// A video whose header is read.
#[derive(Debug)]
pub(super) struct Video {
    /// What it is called.
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

    /// There is no such frame.
    pub(super) fn ended(&self, frames: usize) -> SourceError {
        let frames = if frames == 1 { "1 frame" } else { &format!("{frames} frames") };
        self.end(&format!("ends after {frames}"))
    }

    /// There is no such frame that could be found.
    pub(super) fn damaged(&self, whole: usize) -> SourceError {
        match whole {
            0 => self.end("is damaged from its beginning"),
            1 => self.end("is damaged behind its first frame"),
            _ => self.end(&format!("is damaged behind its first {whole} frames")),
        }
    }

    fn end(&self, how: &str) -> SourceError {
        SourceError {
            has_ended: true,
            ..SourceError::new(format!("{} {how}", self.name), "check which frames are asked for")
        }
    }

    /// Of a frame whose pixels are not all there.
    pub(super) fn cut(&self, frame: usize, bytes: u64) -> SourceError {
        let what =
            format!("it is cut short: {bytes} of {} bytes are there", self.header.frame_bytes());
        self.error(frame, &what, AGAIN)
    }

    /// Bytes of a pixel in memory.
    pub(super) fn bytes_per_pixel(&self) -> u64 {
        if self.header.colour.chroma.is_some() { 12 } else { 4 }
    }

    /// The picture of the bytes of a frame.
    pub(super) fn picture(
        &self,
        frame: usize,
        bytes: &[u8],
        guides: bool,
    ) -> Result<Picture, SourceError> {
        let converted = self.conversion.frame(&self.header, bytes);
        let picture: Frame = converted.map_err(|BadCode { plane, x, y, code }| {
            let bits = self.header.colour.bits;
            let what =
                format!("{plane} at ({x}, {y}) of its plane is {code}, more than {bits} bits hold");
            self.error(frame, &what, "write it again with the colour tag that fits its samples")
        })?;
        let missing = if guides { self.missing() } else { MissingGuides::default() };
        Ok(Picture { missing, pixel_aspect: self.header.pixel_aspect, ..Picture::new(picture) })
    }

    /// There is nothing beside the colour.
    pub(super) fn no_guides(&self) -> Result<PictureGuides, SourceError> {
        Err(self.not_open_exr())
    }

    /// What a user has named is missing; what is only looked for need not be there.
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

/// The system refused.
pub(super) fn unreadable(name: &str, error: &io::Error) -> SourceError {
    SourceError::new(
        format!("{name}: it cannot be read: {error}"),
        "check that it is there and may be read",
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
