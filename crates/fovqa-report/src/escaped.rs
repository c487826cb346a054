//! How the pages escape text. `askama.toml` names this escaper for all templates.

use std::borrow::Cow;
use std::fmt::{Result, Write};

use askama::filters::{Escaper, Html};

use crate::text_table::printable;

/// Escapes text for HTML, between tags and in attributes. Control characters become visible.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PrintableHtml;

impl Escaper for PrintableHtml {
    fn write_escaped_str<W: Write>(&self, page: W, text: &str) -> Result {
        let text = if text.contains(char::is_control) {
            Cow::Owned(printable(text))
        } else {
            Cow::Borrowed(text)
        };
        Html.write_escaped_str(page, &text)
    }
}
