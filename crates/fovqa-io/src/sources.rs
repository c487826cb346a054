//! The kinds of sources that a path argument may stand for.

use std::path::Path;
use std::sync::Arc;

use fovqa_frame::source::{Source, SourceError};
use thiserror::Error;

use crate::files::{Files, SourceOptions};
use crate::sequence::{FileListing, ListingError, list_below, shown};
use crate::y4m::{VideoKind, is_video_name, open_video, standard_input, video_kind};

/// A path argument that cannot be opened as a source.
#[derive(Debug, Error)]
pub enum OpenError {
    /// It stands for nothing, or for files that cannot be ordered.
    #[error(transparent)]
    Listing(#[from] ListingError),
    /// It exists but is not a sequence of frames.
    #[error(transparent)]
    Source(#[from] SourceError),
}

/// Opens the source of a path argument: a video (`*.y4m`, or a file that begins like one), `-` for
/// a video on standard input, an image, a folder, a glob or a pattern. Wildcard characters in the
/// folder `options.base` have no special meaning.
///
/// # Errors
/// When the argument stands for nothing, or for something that is not a sequence of frames.
pub fn open_source(argument: &Path, options: SourceOptions) -> Result<Arc<dyn Source>, OpenError> {
    if argument == Path::new("-") {
        return Ok(standard_input(&options.read)?);
    }
    let files = list_below(&options.base, argument)?;
    match files.files.as_slice() {
        [file] => match video_kind(&file.path) {
            Some(VideoKind::Y4m) => return Ok(open_video(&file.path, &options)?),
            Some(VideoKind::Other(what)) => {
                let argument = shown(&options.base, &file.path);
                let message =
                    format!("{argument}: it is {what} video, but only y4m video is supported");
                let help = "convert it with ffmpeg -i FILE -f yuv4mpegpipe -strict -1 FILE.y4m, or pipe it into `fovqa score … -`";
                return Err(SourceError::new(message, help).into());
            }
            None => {}
        },
        [first, .., last] if [first, last].iter().any(|file| is_video_name(&file.path)) => {
            return Err(several_videos(&files, &options).into());
        }
        _ => {}
    }
    Ok(Arc::new(Files::new(&files, options)))
}

fn several_videos(files: &FileListing, options: &SourceOptions) -> SourceError {
    let argument = shown(&options.base, &files.argument);
    let message = format!(
        "{argument} matches {} files, and some are videos; each video is a sequence of its own",
        files.files.len()
    );
    SourceError::new(message, "give one video")
}
