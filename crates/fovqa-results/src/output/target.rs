//! Finds the target that the bytes of an output are written to.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::folder_of;

/// The kind of an output.
#[derive(Debug, PartialEq)]
pub(super) enum Target {
    /// A file to be replaced or created. It is not a symbolic link.
    File(PathBuf),
    /// A device or a pipe.
    Special(PathBuf),
    /// Something that a process has open; it may be a file.
    Open(PathBuf, Stream),
}

/// The kind of stream that a process has open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stream {
    /// Standard output of this process.
    Output,
    /// Standard error of this process.
    Error,
    /// Another stream.
    Other,
}

impl Target {
    /// Follows symbolic links. The last target need not exist.
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        /// The same limit as in Linux.
        const MOST_LINKS: usize = 40;
        let mut at = path.to_owned();
        for _ in 0..=MOST_LINKS {
            if let Some(stream) = descriptor(&at) {
                return Ok(Self::Open(at, stream));
            }
            let kind = match fs::symlink_metadata(&at) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::File(at)),
                found => found?.file_type(),
            };
            if !kind.is_symlink() {
                // A folder is not a file, but renaming to it reports the error.
                let is_file = kind.is_file() || kind.is_dir();
                return Ok(if is_file { Self::File(at) } else { Self::Special(at) });
            }
            at = folder_of(&at).join(fs::read_link(&at)?);
        }
        Err(io::Error::other("too many symbolic links, one behind the other"))
    }

    /// The path of the file to be replaced, for a file of a run. Anything else at its path is
    /// replaced, including a link to a device.
    pub(super) fn file_at(path: &Path) -> io::Result<PathBuf> {
        Ok(match Self::of(path)? {
            Self::File(file) => file,
            Self::Special(_) | Self::Open(..) => path.to_owned(),
        })
    }
}

/// Opens a device or a pipe. Opening may wait for a reader.
pub(super) fn open_special(path: &Path) -> io::Result<Box<dyn Write>> {
    Ok(Box::new(File::options().write(true).open(path)?))
}

/// Opens a stream that a process has open, and continues after the data already written to it.
pub(super) fn open_again(path: &Path, stream: Stream) -> io::Result<Box<dyn Write>> {
    Ok(match stream {
        Stream::Output => Box::new(Stdout),
        Stream::Error => Box::new(io::stderr()),
        Stream::Other => Box::new(File::options().append(true).open(path)?),
    })
}

/// Standard output. If the reader closes its end, that is not an error, because it has read enough.
struct Stdout;

impl Write for Stdout {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        seen_enough(io::stdout().write(bytes), bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        seen_enough(io::stdout().flush(), ())
    }
}

fn seen_enough<T>(written: io::Result<T>, all: T) -> io::Result<T> {
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(all),
        written => written,
    }
}

/// Whether a path, such as `/dev/stdout` or `/dev/fd/3`, stands for something that a process has
/// open, and which stream it is. It may be a file. The process that has it open would not notice a
/// new file at its place.
#[cfg(unix)]
fn descriptor(path: &Path) -> Option<Stream> {
    let number: u32 = path.file_name()?.to_str()?.parse().ok()?;
    let folder = folder_of(path).canonicalize().ok()?;
    let own = Path::new("/proc").join(std::process::id().to_string());
    let is_own = folder == Path::new("/dev/fd") || folder.starts_with(own);
    let is_any = is_own || folder.starts_with("/proc");
    (is_any && folder.ends_with("fd")).then_some(match number {
        1 if is_own => Stream::Output,
        2 if is_own => Stream::Error,
        _ => Stream::Other,
    })
}

#[cfg(not(unix))]
fn descriptor(_: &Path) -> Option<Stream> {
    None
}
