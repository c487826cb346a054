//! y4m video: as a file and as a stream, which have to tell the same, in every range and matrix.

#![no_main]

use std::io::Cursor;

use fovqa_frame::source::{Picture, Source, SourceError};
use fovqa_fuzz::{abort_on_escaping_panics, decode_on_one_thread, with_file};
use fovqa_io::{CodeRange, ColourMatrix, SourceOptions, open_source, video_stream};
use libfuzzer_sys::fuzz_target;

/// Frames that are looked at.
const FRAMES: usize = 6;

fn prepare() {
    abort_on_escaping_panics();
    decode_on_one_thread();
}

fn read(source: &dyn Source, frame: usize) -> Result<Picture, SourceError> {
    let read = source.read(frame, false);
    if let Ok(Picture { frame, pixel_aspect, .. }) = &read {
        assert_eq!(source.size(0).ok(), Some(frame.file_size()), "what its header says");
        let (low, high) = frame.range();
        assert!(0.0 <= low && high <= 1.0, "{low} to {high}");
        assert!(frame.bad_pixel().is_none() && pixel_aspect.is_finite());
    }
    read
}

fuzz_target!(init: prepare(), |bytes: &[u8]| {
    // Anything else is a picture, which another target has.
    if !bytes.starts_with(b"YUV4MPEG2") {
        return;
    }
    let mut options = SourceOptions::default();
    options.read.max_megapixels = 1;
    match bytes.len() % 4 {
        0 => {}
        1 => options.read.formats.y4m.range = Some(CodeRange::Full),
        2 => options.read.formats.y4m.matrix = Some(ColourMatrix::Bt2020),
        _ => options.read.formats.y4m.range = Some(CodeRange::Limited),
    }
    with_file(bytes, |path| {
        let name = path.display().to_string();
        let stream = video_stream(name, Cursor::new(bytes.to_vec()), &options.read);
        let file = open_source(path, options.clone());
        let (file, stream) = match (file, stream) {
            (Ok(file), Ok(stream)) => (file, stream),
            (Ok(_), Err(error)) => panic!("as a stream: {error}"),
            (Err(error), Ok(stream)) => {
                assert!(read(&*stream, 0).is_err(), "as a file: {error}");
                return;
            }
            (Err(_), Err(_)) => return,
        };
        assert!(file.fps().is_none_or(|fps| fps > 0.0 && fps.is_finite()));
        for frame in 0..FRAMES {
            match (read(&*file, frame), read(&*stream, frame)) {
                (Ok(file), Ok(stream)) => assert_eq!(file, stream),
                (Err(file), Err(stream)) => assert_eq!(file, stream),
                (file, stream) => panic!("{file:?} as a file, {stream:?} as a stream"),
            }
        }
    });
});
