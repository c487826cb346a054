//! Small files that are read as a whole: experiments, gaze traces, baselines, results.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Opens a regular file.
///
/// Other kinds are refused, because opening a pipe without a writer waits forever, a device may
/// have no end, and the content must be readable a second time for its hash.
///
/// # Errors
/// When it does not exist, cannot be read, or is not a regular file.
pub fn open_regular_file(path: &Path) -> io::Result<File> {
    // This is checked before opening, since opening may wait forever.
    refuse_special(&std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    // Another entry may have replaced it in the meantime.
    refuse_special(&file.metadata()?)?;
    Ok(file)
}

/// Reads a regular file of at most `most_bytes` bytes. The UTF-8 byte order mark that some editors
/// write at its start is removed.
///
/// # Errors
/// As [`open_regular_file`], and when the file is larger.
pub fn read_small_file(path: &Path, most_bytes: u64) -> io::Result<Vec<u8>> {
    let file = open_regular_file(path)?;
    let too_large = || {
        let message = format!("it is larger than {} MiB", most_bytes >> 20);
        io::Error::new(io::ErrorKind::FileTooLarge, message)
    };
    let length = file.metadata()?.len();
    if length > most_bytes {
        return Err(too_large());
    }
    // Files in /proc and similar folders have a length of 0 but can be read. Interrupted reads are
    // repeated.
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    file.take(most_bytes.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most_bytes { Err(too_large()) } else { Ok(unmarked(bytes)) }
}

/// The first bytes of a regular file, up to a limit, without a byte order mark.
///
/// # Errors
/// As [`open_regular_file`].
pub fn read_head(path: &Path, most_bytes: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular_file(path)?.take(most_bytes).read_to_end(&mut bytes)?;
    Ok(unmarked(bytes))
}

/// Removes a byte order mark.
fn unmarked(mut bytes: Vec<u8>) -> Vec<u8> {
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    bytes
}

fn refuse_special(kind: &std::fs::Metadata) -> io::Result<()> {
    if kind.is_file() {
        return Ok(());
    }
    let what = if kind.is_dir() { "it is a folder, not a regular file" } else { special(kind) };
    Err(io::Error::new(io::ErrorKind::InvalidInput, what))
}

#[cfg(unix)]
fn special(kind: &std::fs::Metadata) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    if kind.file_type().is_fifo() {
        "it is a pipe, not a regular file: files are read more than once, so write it to a file first"
    } else {
        "it is not a regular file"
    }
}

#[cfg(not(unix))]
fn special(_: &std::fs::Metadata) -> &'static str {
    "it is not a regular file"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_whole_up_to_a_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, b"\xef\xbb\xbfabc").unwrap();
        assert_eq!(read_small_file(&path, 6).unwrap(), b"abc");
        assert_eq!(read_head(&path, 4).unwrap(), b"a");
        let large = read_small_file(&path, 5).unwrap_err();
        assert_eq!(large.kind(), io::ErrorKind::FileTooLarge);
        assert!(
            read_small_file(folder.path(), 5).unwrap_err().to_string().contains("it is a folder")
        );
        let gone = read_small_file(&folder.path().join("b"), 5).unwrap_err();
        assert_eq!(gone.kind(), io::ErrorKind::NotFound);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_are_refused() {
        for path in ["/dev/zero", "/dev/null"] {
            let error = read_small_file(Path::new(path), 5).unwrap_err();
            assert!(error.to_string().contains("not a regular file"), "{path}: {error}");
            assert!(read_head(Path::new(path), 5).is_err());
        }
    }
}
