//! Widths of terminals, in columns.

use std::ffi::OsStr;

/// The least width for which text is laid out. Below it, lines would be single words.
const LEAST: usize = 20;

/// Width of the terminal that shows stdout; `None` if there is none.
pub(crate) fn of_stdout() -> Option<usize> {
    of(&std::io::stdout())
}

/// Width of the terminal that shows stderr; `None` if there is none.
pub(crate) fn of_stderr() -> Option<usize> {
    of(&std::io::stderr())
}

#[cfg(unix)]
fn of(stream: &(impl std::io::IsTerminal + std::os::fd::AsFd)) -> Option<usize> {
    stream.is_terminal().then(|| chosen(terminal_size::terminal_size_of(stream)))?
}

#[cfg(windows)]
fn of(stream: &(impl std::io::IsTerminal + std::os::windows::io::AsHandle)) -> Option<usize> {
    stream.is_terminal().then(|| chosen(terminal_size::terminal_size_of(stream)))?
}

/// The width that the user has set with the variable `COLUMNS`, or that of the terminal.
fn chosen(size: Option<(terminal_size::Width, terminal_size::Height)>) -> Option<usize> {
    let set = std::env::var_os("COLUMNS");
    let own = size.map(|(terminal_size::Width(width), _)| usize::from(width));
    columns(set.as_deref()).or(own).map(|width| width.max(LEAST))
}

fn columns(set: Option<&OsStr>) -> Option<usize> {
    set?.to_str()?.parse().ok().filter(|width| *width > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_number_of_columns_counts() {
        let of = |text: &str| columns(Some(OsStr::new(text)));
        assert_eq!((of("50"), of("0"), of(""), of("wide")), (Some(50), None, None, None));
    }
}
