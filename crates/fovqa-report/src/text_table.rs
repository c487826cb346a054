//! Tables of plain text: names are aligned to the left, numbers to the right.

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

/// An empty table without lines.
pub(crate) fn plain_table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header.to_vec());
    table
}

/// The lines of a table. Names are aligned to the left and numbers to the right, without trailing
/// spaces.
pub(crate) fn aligned(mut table: Table) -> String {
    for (index, column) in table.column_iter_mut().enumerate() {
        let side = if index == 0 { CellAlignment::Left } else { CellAlignment::Right };
        column.set_cell_alignment(side);
        column.set_padding(if index == 0 { (0, 1) } else { (1, 1) });
    }
    table.lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>().join("\n")
}

/// Text without characters that control a terminal or start a new line: invisible characters are
/// written as escapes.
pub(crate) fn printable(text: &str) -> String {
    let shown = |c: char| {
        if c.is_control() { c.escape_default().collect() } else { c.to_string() }
    };
    text.chars().map(shown).collect()
}
