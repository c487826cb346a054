//! A video in a file, with random access to its frames.

use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use fovqa_frame::source::{
    InputId, Length, Listing, Origin, Picture, PictureGuides, Source, SourceError,
};

use super::frames::{Line, Video, not_a_frame, read_line, unreadable};
use super::header::MAGIC;
use crate::files::SourceOptions;
use crate::input_id::id_of_file;
use crate::sequence::shown;
use crate::small_file::{open_regular_file, read_head};

/// The kind of video in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum VideoKind {
    /// YUV4MPEG2, which is supported.
    Y4m,
    /// A kind that is not supported, named with its article.
    Other(&'static str),
}

/// The kind of video in a file, by its name or by its first bytes. The name also recognises a video
/// that is empty or truncated. `None` if the file is not a video.
pub(crate) fn video_kind(path: &Path) -> Option<VideoKind> {
    if is_video_name(path) {
        return Some(VideoKind::Y4m);
    }
    match read_head(path, 12).ok()?.as_slice() {
        head if head.starts_with(MAGIC) => Some(VideoKind::Y4m),
        [0x1a, 0x45, 0xdf, 0xa3, ..] => Some(VideoKind::Other("a Matroska or WebM")),
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => Some(VideoKind::Other("an MP4 or QuickTime")),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'A', b'V', b'I', b' ', ..] => {
            Some(VideoKind::Other("an AVI"))
        }
        _ => None,
    }
}

/// Whether a file has the name of a video.
pub(crate) fn is_video_name(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("y4m"))
}

/// A video in a file.
#[derive(Debug)]
struct VideoFile {
    path: PathBuf,
    video: Video,
    listing: Listing,
    /// The position of the pixels of each complete frame.
    frames: Vec<u64>,
    /// The error for the data after them, if it is not a frame.
    rest: Option<SourceError>,
    /// Size and hash, if they are computed.
    id: Option<OnceLock<Result<InputId, SourceError>>>,
}

/// Reads the header of a video and finds its frames.
pub(crate) fn open_video(
    path: &Path,
    options: &SourceOptions,
) -> Result<Arc<dyn Source>, SourceError> {
    let name = shown(&options.base, path);
    let file = open_regular_file(path).map_err(|error| unreadable(&name, &error))?;
    let length = file.metadata().map_err(|error| unreadable(&name, &error))?.len();
    let mut reader = BufReader::new(file);
    let video = Video::begin(name, &mut reader, &options.read)?;
    let (frames, rest) = find_frames(&video, reader, length)?;
    let count = frames.len() + usize::from(rest.is_some());
    if count == 0 {
        let message = format!("{}: it has a header but no frames", video.name);
        return Err(SourceError::new(message, "check how it was written"));
    }
    let length = if rest.is_some() { Length::Damaged(count) } else { Length::Whole(count) };
    let listing = Listing::counted(video.name.clone(), length);
    let id = options.hash.then(OnceLock::new);
    Ok(Arc::new(VideoFile { path: path.to_owned(), video, listing, frames, rest, id }))
}

/// The positions of the pixels of each frame, and the error for the rest of the file, if there is a
/// rest.
fn find_frames(
    video: &Video,
    mut reader: BufReader<std::fs::File>,
    length: u64,
) -> Result<(Vec<u64>, Option<SourceError>), SourceError> {
    let failed = |error| unreadable(&video.name, &error);
    let bytes = video.header.frame_bytes() as u64;
    let mut frames = Vec::new();
    loop {
        let line = read_line(&mut reader).map_err(failed)?;
        if line == Line::None {
            return Ok((frames, None));
        }
        if let Some((what, help)) = not_a_frame(&line) {
            let error = video.error(frames.len(), &what, help);
            return Ok((frames, Some(error)));
        }
        let start = reader.stream_position().map_err(failed)?;
        let there = length.saturating_sub(start);
        if there < bytes {
            let error = video.cut(frames.len(), there);
            return Ok((frames, Some(error)));
        }
        frames.push(start);
        // `seek` would discard the buffer, which may hold several small frames.
        reader.seek_relative(bytes as i64).map_err(failed)?;
    }
}

impl VideoFile {
    fn bytes(&self, frame: usize) -> Result<Vec<u8>, SourceError> {
        let Some(start) = self.frames.get(frame) else {
            let whole = self.frames.len();
            return Err(match &self.rest {
                None => self.video.ended(whole),
                Some(damage) if frame == whole => damage.clone(),
                Some(_) => self.video.damaged(whole),
            });
        };
        let failed = |error| unreadable(&self.listing.label(frame), &error);
        let mut file = open_regular_file(&self.path).map_err(failed)?;
        let mut bytes = vec![0; self.video.header.frame_bytes()];
        file.seek(SeekFrom::Start(*start)).map_err(failed)?;
        file.read_exact(&mut bytes).map_err(failed)?;
        Ok(bytes)
    }

    fn inputs(&self) -> Result<Vec<(String, InputId)>, SourceError> {
        let Some(id) = &self.id else { return Ok(Vec::new()) };
        let hashed =
            || id_of_file(&self.path).map_err(|error| unreadable(&self.video.name, &error));
        let id = id.get_or_init(hashed).clone()?;
        Ok(vec![(self.video.name.clone(), id)])
    }
}

impl Source for VideoFile {
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
        let picture = self.video.picture(frame, &bytes, guides)?;
        Ok(Picture { inputs: self.inputs()?, ..picture })
    }

    fn read_guides(&self, _frame: usize) -> Result<PictureGuides, SourceError> {
        self.video.no_guides()
    }

    fn origins(&self, _frame: usize) -> Vec<(String, Origin)> {
        vec![(self.video.name.clone(), Origin::File(self.path.clone()))]
    }

    fn fps(&self) -> Option<f64> {
        self.video.header.fps
    }

    fn code_bits(&self) -> Option<u32> {
        Some(self.video.header.colour.bits)
    }
}
