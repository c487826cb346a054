//! Results on stdout.

use std::io::{self, BufWriter, ErrorKind, Write};

use fovqa_report::Text;

use crate::exit::Exit;
use crate::{diagnostic, width};

/// Writes results to stdout.
pub(crate) fn write(results: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Exit {
    let mut out = BufWriter::new(io::stdout().lock());
    outcome(results(&mut out).and_then(|()| out.flush()))
}

/// Writes text to stdout. On a terminal, lines and tables are laid out for its width.
pub(crate) fn text(text: &Text) -> Exit {
    let shown = match width::of_stdout() {
        Some(columns) => text.within(columns),
        None => text.to_string(),
    };
    write(|out| out.write_all(shown.as_bytes()))
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
