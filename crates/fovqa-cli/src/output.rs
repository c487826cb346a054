//! Results on stdout.

use std::io::{self, BufWriter, ErrorKind, Write};

use crate::diagnostic;
use crate::exit::Exit;

/// Writes results to stdout.
pub(crate) fn write(results: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Exit {
    let mut out = BufWriter::new(io::stdout().lock());
    outcome(results(&mut out).and_then(|()| out.flush()))
}

/// How the command ends after writing to stdout. If the reader has closed its end, that is a
/// success, because it has read enough.
pub(crate) fn outcome(written: io::Result<()>) -> Exit {
    match written {
        Ok(()) => Exit::Done,
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Exit::Done,
        Err(error) => {
            let help = "free some space, or send the results elsewhere";
            diagnostic::error(&format!("the results cannot be written: {error}"), help);
            Exit::Input
        }
    }
}
