//! Reads and parses a TOML file, and checks it against a grammar.

use std::path::Path;

use fovqa_io::read_small_file;
use toml::de::DeTable;

use crate::fault::{ExperimentError, Fault, Faults};
use crate::grammar::{Key, check};
use crate::node::Node;

/// Maximum size of a file in bytes, far more than anybody writes.
const MAX_BYTES: u64 = 4 << 20;

/// Reads the text of a file. No other file is read.
pub(crate) fn read(path: &Path) -> Result<String, ExperimentError> {
    let unreadable = |reason: String| ExperimentError::Unreadable { path: path.to_owned(), reason };
    let bytes = read_small_file(path, MAX_BYTES).map_err(|error| unreadable(reason(&error)))?;
    String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))
}

fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => error.to_string(),
    }
}

/// The content of a text, if neither the grammar nor `resolve` finds a mistake. `what` is what messages
/// call it: `the experiment`.
pub(crate) fn parse<T>(
    path: &Path,
    text: &str,
    (what, keys): (&str, &[Key]),
    resolve: impl FnOnce(Node<'_>, &mut Faults) -> T,
) -> Result<T, ExperimentError> {
    parsed(text, (what, keys), resolve).map_err(|faults| {
        let faults = faults.in_order();
        ExperimentError::Faults { path: path.to_owned(), text: text.to_owned(), faults }
    })
}

fn parsed<T>(
    text: &str,
    (what, keys): (&str, &[Key]),
    resolve: impl FnOnce(Node<'_>, &mut Faults) -> T,
) -> Result<T, Faults> {
    let mut faults = Faults::default();
    let document = match document(text) {
        Ok(document) => document,
        Err(fault) => {
            faults.push(fault);
            return Err(faults);
        }
    };
    check(keys, document.get_ref(), what, 0..0, &mut faults);
    // References are checked only in a file that the grammar accepts. If the name of a table is
    // misspelled, every reference to it would be reported as well.
    if !faults.is_empty() {
        return Err(faults);
    }
    let resolved = resolve(Node::new(document.get_ref()), &mut faults);
    if faults.is_empty() { Ok(resolved) } else { Err(faults) }
}

fn document(text: &str) -> Result<serde_spanned::Spanned<DeTable<'_>>, Fault> {
    DeTable::parse(text).map_err(|error| {
        // A mistake at the end of the file has no character that it could point to.
        let span = error.span().unwrap_or_default();
        let span = span.start.min(text.len())..span.end.min(text.len());
        Fault::new(span, format!("this is not TOML: {}", error.message()))
    })
}

/// The keys at the top level of a text; none if it is not TOML.
pub(crate) fn keys(text: &str) -> Vec<String> {
    let document = document(text);
    let keys = document.iter().flat_map(|document| document.get_ref().keys());
    keys.map(|key| key.get_ref().to_string()).collect()
}
