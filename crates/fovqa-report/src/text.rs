//! Text for a terminal: lines and tables, in full or for a narrow terminal.

use std::fmt;

use textwrap::core::display_width;
use textwrap::{Options, WordSeparator, WordSplitter};

use crate::text_table::TextTable;

/// Lines and tables. As a text ([`Display`](fmt::Display)) it does not depend on any terminal.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Text(Vec<Block>);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Block {
    Lines(String),
    Table(TextTable),
}

impl Text {
    /// Whether there is no text.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds text, which may have several lines.
    pub fn push_str(&mut self, text: &str) {
        match self.0.last_mut() {
            _ if text.is_empty() => {}
            Some(Block::Lines(lines)) => lines.push_str(text),
            _ => self.0.push(Block::Lines(text.to_owned())),
        }
    }

    /// Adds a table, and the end of its last line.
    pub fn push_table(&mut self, table: TextTable) {
        self.0.push(Block::Table(table));
        self.push_str("\n");
    }

    /// Adds another text.
    pub fn push(&mut self, other: Self) {
        for block in other.0 {
            match block {
                Block::Lines(lines) => self.push_str(&lines),
                table @ Block::Table(_) => self.0.push(table),
            }
        }
    }

    /// The text for a terminal of this many columns. Long lines are wrapped between words, and wide
    /// tables are divided. A single word can still be longer.
    pub fn within(&self, columns: usize) -> String {
        let blocks = self.0.iter().map(|block| match block {
            Block::Lines(lines) => lines.clone(),
            Block::Table(table) => table.within(columns),
        });
        wrapped(&blocks.collect::<String>(), columns)
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|block| match block {
            Block::Lines(lines) => f.write_str(lines),
            Block::Table(table) => f.write_str(&table.full()),
        })
    }
}

impl fmt::Write for Text {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.push_str(text);
        Ok(())
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        let mut own = Self::default();
        own.push_str(&text);
        own
    }
}

/// Wraps lines that are longer than a number of columns, between words. The other lines, and the
/// indentation of all lines, stay. The rest of a wrapped line is indented further.
pub fn wrapped(text: &str, columns: usize) -> String {
    let mut all = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let (line, end) = line.strip_suffix('\n').map_or((line, ""), |line| (line, "\n"));
        if display_width(line) <= columns {
            all.push_str(line);
        } else {
            let words = line.trim_start();
            let indent = &line[..line.len() - words.len()];
            all.push_str(&filled(words, columns, [indent, &format!("{indent}  ")]));
        }
        all.push_str(end);
    }
    all
}

/// Wraps a line between words. It begins with `head`, and the rest of a wrapped line is below what
/// follows the head.
pub fn wrapped_line(line: &str, columns: usize, head: &str) -> String {
    filled(line, columns, [head, &" ".repeat(display_width(head))])
}

/// Wraps a line between words, with the beginnings of its first line and of the others. A word that is
/// longer than a line stays whole, so that it can be copied.
fn filled(line: &str, columns: usize, [first, rest]: [&str; 2]) -> String {
    // In few columns, an indentation leaves no room for words.
    let rest = if display_width(rest) * 2 > columns { "  " } else { rest };
    let options = Options::new(columns)
        .initial_indent(first)
        .subsequent_indent(rest)
        .break_words(false)
        .word_separator(WordSeparator::AsciiSpace)
        .word_splitter(WordSplitter::NoHyphenation);
    textwrap::fill(line, options)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text() -> Text {
        let mut text = Text::default();
        text.push_str("gt.png against rmfr.png\n\n");
        let mut table = TextTable::new(["", "mean", "min", "max"]);
        table.add_row(["PSNR dB", "31.070", "29.112", "35.991"]);
        text.push_table(table);
        text.push_str("3 of 7 frames are identical; means are over the others\n");
        text
    }

    #[test]
    fn without_a_terminal_nothing_is_wrapped() {
        let full = "gt.png against rmfr.png\n\n\
                    \x20          mean     min     max\n\
                    PSNR dB  31.070  29.112  35.991\n\
                    3 of 7 frames are identical; means are over the others\n";
        assert_eq!(text().to_string(), full);
        assert_eq!(text().within(54), full);
    }

    #[test]
    fn a_narrow_terminal_shows_whole_words_and_all_columns() {
        let narrow = text().within(24);
        assert_eq!(
            narrow,
            "gt.png against rmfr.png\n\n\
             \x20          mean     min\n\
             PSNR dB  31.070  29.112\n\n\
             \x20           max\n\
             PSNR dB  35.991\n\
             3 of 7 frames are\n  identical; means are\n  over the others\n"
        );
    }

    #[test]
    fn a_word_stays_whole_and_an_indentation_hangs() {
        let path = "reports/a-rather-long-name/summary.json";
        let text = wrapped(&format!("    see {path} for it, --fov-vertical\n"), 16);
        assert_eq!(text, format!("    see\n      {path}\n      for it,\n      --fov-vertical\n"));
        assert_eq!(wrapped_line("a b", 2, "note: "), "note: a\n  b");
    }
}
