//! A video that is read from a stream such as standard input: each frame once, in order, without
//! keeping any.

use std::fmt;
use std::io::{self, BufRead, BufReader, IsTerminal, Read};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use fovqa_frame::source::{Length, Listing, Origin, Picture, PictureGuides, Source, SourceError};

use super::frames::{Line, Video, not_a_frame, read_line, unreadable};
use crate::read_options::ReadOptions;

/// The name of standard input in messages.
const STANDARD_INPUT: &str = "standard input";

/// Bytes that are read from the system at a time.
const BUFFER: usize = 1 << 16;

/// The video on standard input. It can be opened once per process.
pub(crate) fn standard_input(options: &ReadOptions) -> Result<Arc<dyn Source>, SourceError> {
    static IS_TAKEN: AtomicBool = AtomicBool::new(false);
    let refused = |what: &str, help: &str| {
        Err(SourceError::new(format!("{STANDARD_INPUT}: {what}"), help.to_owned()))
    };
    if io::stdin().is_terminal() {
        let help = "pipe a y4m video into it, such as from ffmpeg -i FILE -f yuv4mpegpipe -";
        return refused("it is a terminal, but a video is expected", help);
    }
    if IS_TAKEN.swap(true, Ordering::Relaxed) {
        return refused("it is used twice, but can only be read once", "give a file for the other");
    }
    video_stream(STANDARD_INPUT.to_owned(), io::stdin(), options)
}

/// A video that is read from any byte source, such as a pipe or a socket. The header is read
/// immediately, and each frame when it is asked for, so that only one frame is in memory. `name` is
/// the name in results and messages.
///
/// # Errors
/// When the data does not begin with a supported header.
pub fn video_stream(
    name: String,
    reader: impl Read + Send + 'static,
    options: &ReadOptions,
) -> Result<Arc<dyn Source>, SourceError> {
    let reader: Box<dyn Read + Send> = Box::new(reader);
    let mut reader = BufReader::with_capacity(BUFFER, reader);
    let video = Video::begin(name, &mut reader, options)?;
    let listing = Listing::counted(video.name.clone(), Length::Open);
    let state = Mutex::new(State { reader, next: 0, end: None });
    Ok(Arc::new(VideoStream { video, listing, state }))
}

struct VideoStream {
    video: Video,
    listing: Listing,
    state: Mutex<State>,
}

struct State {
    reader: BufReader<Box<dyn Read + Send>>,
    /// The index of the next frame.
    next: usize,
    /// How the stream ended, once it has ended.
    end: Option<End>,
}

/// How a stream ended.
enum End {
    /// After a complete frame.
    Whole,
    /// In a frame that cannot be read. The start of the next frame is not known.
    Damaged,
}

impl fmt::Debug for VideoStream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("VideoStream").field("video", &self.video).finish_non_exhaustive()
    }
}

impl VideoStream {
    fn lock(&self) -> MutexGuard<'_, State> {
        // A reader that panicked has left the position in the stream unknown, but the following
        // data is checked.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The bytes of a frame. Frames before it are skipped.
    fn bytes(&self, frame: usize) -> Result<Vec<u8>, SourceError> {
        let mut state = self.lock();
        if state.end.is_none() && frame < state.next {
            let what = "it has already passed: a stream can only be read once and in order";
            return Err(self.video.error(frame, what, "write the stream to a file first"));
        }
        let mut bytes = Vec::new();
        while state.next <= frame {
            match state.end {
                Some(End::Whole) => return Err(self.video.ended(state.next)),
                Some(End::Damaged) => return Err(self.video.damaged(state.next)),
                None => {}
            }
            bytes.clear();
            state.read(&self.video, &mut bytes)?;
        }
        Ok(bytes)
    }
}

impl State {
    /// Reads the next frame.
    fn read(&mut self, video: &Video, bytes: &mut Vec<u8>) -> Result<(), SourceError> {
        let result = self.read_frame(video, bytes);
        match &result {
            Ok(()) => self.next += 1,
            Err(error) if error.has_ended => self.end = Some(End::Whole),
            Err(_) => self.end = Some(End::Damaged),
        }
        result
    }

    fn read_frame(&mut self, video: &Video, bytes: &mut Vec<u8>) -> Result<(), SourceError> {
        let frame = self.next;
        let failed = |error| unreadable(&format!("{}, frame {frame}", video.name), &error);
        let line = read_line(&mut self.reader).map_err(failed)?;
        if line == Line::None {
            return Err(video.ended(frame));
        }
        if let Some((what, help)) = not_a_frame(&line) {
            return Err(video.error(frame, &what, help));
        }
        // The buffer grows with the data, so that a header alone does not allocate memory.
        let wanted = video.header.frame_bytes() as u64;
        self.reader.by_ref().take(wanted).read_to_end(bytes).map_err(failed)?;
        let there = bytes.len() as u64;
        if there < wanted { Err(video.cut(frame, there)) } else { Ok(()) }
    }
}

impl Source for VideoStream {
    fn listing(&self) -> &Listing {
        &self.listing
    }

    fn size(&self, _frame: usize) -> Result<(usize, usize), SourceError> {
        Ok((self.video.header.width, self.video.header.height))
    }

    fn bytes_per_pixel(&self) -> u64 {
        self.video.bytes_per_pixel()
    }

    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError> {
        let bytes = self.bytes(frame)?;
        self.video.picture(frame, &bytes, guides)
    }

    fn read_guides(&self, _frame: usize) -> Result<PictureGuides, SourceError> {
        self.video.no_guides()
    }

    /// A stream has no inputs that could be read again.
    fn origins(&self, _frame: usize) -> Vec<(String, Origin)> {
        Vec::new()
    }

    fn fps(&self) -> Option<f64> {
        self.video.header.fps
    }

    fn code_bits(&self) -> Option<u32> {
        Some(self.video.header.colour.bits)
    }

    fn is_read_once(&self) -> bool {
        true
    }

    fn has_more(&self) -> Result<bool, SourceError> {
        let mut state = self.lock();
        if state.end.is_some() {
            return Ok(false);
        }
        let next = state.reader.fill_buf();
        next.map(|bytes| !bytes.is_empty()).map_err(|error| unreadable(&self.video.name, &error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stream(bytes: &'static [u8]) -> Arc<dyn Source> {
        video_stream("clip".to_owned(), bytes, &ReadOptions::default()).unwrap()
    }

    fn message(source: &dyn Source, frame: usize) -> (String, bool) {
        let error = source.read(frame, false).unwrap_err();
        (error.message, error.has_ended)
    }

    const THREE: &[u8] = b"YUV4MPEG2 W2 H1 Cmono\nFRAME\nabFRAME Ip\ncdFRAME\nef";

    #[test]
    fn frames_come_once_and_in_order() {
        let clip = stream(THREE);
        assert!(clip.read(0, false).is_ok());
        assert_eq!(clip.has_more(), Ok(true));
        let third = clip.read(2, false).unwrap().frame.sample(0, 0, 0);
        assert!((third - (101.0 - 16.0) / 219.0).abs() < 1e-6);
        let gone =
            "clip, frame 1: it has already passed: a stream can only be read once and in order";
        assert_eq!(message(&*clip, 1), (gone.to_owned(), false));
        assert_eq!(clip.has_more(), Ok(false));
        assert_eq!(message(&*clip, 3), ("clip ends after 3 frames".to_owned(), true));
        assert_eq!(message(&*clip, 9), ("clip ends after 3 frames".to_owned(), true));
    }

    #[test]
    fn whole_frames_before_a_damaged_one_count() {
        let clip = stream(&THREE[..THREE.len() - 1]);
        assert!(clip.read(1, false).is_ok());
        let cut = "clip, frame 2: it is cut short: only 1 of 2 bytes are present";
        assert_eq!(message(&*clip, 2), (cut.to_owned(), false));
        let end = "clip is damaged after its first 2 frames";
        assert_eq!(message(&*clip, 3), (end.to_owned(), true));
        let other = stream(b"YUV4MPEG2 W2 H1 Cmono\nFRAME\nabYUV4MPEG2 W4 H1\nFRAME\n");
        assert!(other.read(0, false).is_ok());
        assert!(message(&*other, 1).0.starts_with("clip, frame 1: another video begins here"));
        let end = "clip is damaged after its first frame";
        assert_eq!(message(&*other, 2), (end.to_owned(), true));
    }
}
