//! Text in HTML.

use crate::text_table::printable;

/// Escapes text for HTML, for use between tags and in attributes.
pub(crate) fn escaped(text: &str) -> String {
    let mut plain = String::new();
    for c in printable(text).chars() {
        match c {
            '&' => plain.push_str("&amp;"),
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '"' => plain.push_str("&quot;"),
            c => plain.push(c),
        }
    }
    plain
}
