//! The tables and remarks of an analysis, in the order in which they are read.

use fovqa_study::json::{By, Group};

use crate::plain_table::{Cell, Column, PlainTable};

/// Names of a reason beyond these are only counted.
const MOST_NAMES: usize = 3;

/// A table or a remark.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Part {
    /// A table. Tables of all groups with the same name belong together.
    Table {
        /// The end of the name of its files.
        name: &'static str,
        /// What is special about this group, such as its number of participants; may be empty.
        detail: String,
        table: PlainTable,
    },
    /// A sentence.
    Remark(String),
}

/// Builds the parts of a group.
#[derive(Debug, Default)]
pub(super) struct Parts(pub(super) Vec<Part>);

impl Parts {
    /// Adds a sentence.
    pub(super) fn remark(&mut self, text: impl Into<String>) {
        self.0.push(Part::Remark(text.into()));
    }

    /// Adds a table, with the heading and the name in CSV of each column. A table without rows is left
    /// out.
    pub(super) fn table(
        &mut self,
        (name, caption): (&'static str, &str),
        columns: &[(&str, &str)],
        rows: Vec<Vec<Cell>>,
    ) {
        if rows.is_empty() {
            return;
        }
        let mut columns: Vec<Column> =
            columns.iter().map(|(head, key)| Column::new(*head, *key)).collect();
        // It says what a row is about.
        if let Some(first) = columns.first_mut() {
            first.is_repeated = true;
        }
        let table = PlainTable { caption: caption.to_owned(), columns, rows, notes: Vec::new() };
        self.0.push(Part::Table { name, detail: String::new(), table });
    }

    /// What is special about the last table in this group.
    pub(super) fn detail(&mut self, text: impl Into<String>) {
        if let Some(Part::Table { detail, .. }) = self.0.last_mut() {
            *detail = text.into();
        }
    }

    /// Says why values of the last table are undefined: each reason once, with what it is about. Without
    /// a table, reasons are remarks.
    pub(super) fn reasons(&mut self, reasons: impl IntoIterator<Item = (String, Option<String>)>) {
        let mut by_reason: Vec<(String, Vec<String>)> = Vec::new();
        for (about, reason) in reasons {
            let Some(reason) = reason else { continue };
            match by_reason.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, names)) => names.push(about),
                None => by_reason.push((reason, vec![about])),
            }
        }
        for (reason, names) in by_reason {
            let shown = names.iter().take(MOST_NAMES).cloned().collect::<Vec<_>>().join(", ");
            let more = match names.len().saturating_sub(MOST_NAMES) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let text = format!("{shown}{more}: {reason}");
            match self.0.last_mut() {
                Some(Part::Table { table, .. }) => table.notes.push(text),
                _ => self.remark(text),
            }
        }
    }
}

/// What the rows of a group have in common, in words; empty for a group of all rows.
pub(super) fn in_words(by: &By) -> String {
    let by: Vec<String> =
        by.0.iter().map(|(column, value)| format!("{column} = {value}")).collect();
    by.join(", ")
}

/// The tables and remarks of an analysis with those of all groups in one. The columns that divide the
/// groups come first in each table, and groups are named in each remark.
pub(super) fn joined<T>(groups: &[Group<T>], parts: impl Fn(&T, &mut Parts)) -> Vec<Part> {
    let mut joined: Vec<(Part, Vec<String>)> = Vec::new();
    for group in groups {
        let of = in_words(&group.by);
        let mut own = Parts::default();
        parts(&group.result, &mut own);
        for part in own.0 {
            add(&mut joined, part, &group.by, &of);
        }
    }
    let part = |(part, mut details): (Part, Vec<String>)| match part {
        Part::Table { name, mut table, .. } => {
            details.dedup();
            match details.as_slice() {
                [one] if !one.is_empty() => table.caption = format!("{}; {one}", table.caption),
                _ => {}
            }
            Part::Table { name, detail: String::new(), table }
        }
        remark @ Part::Remark(_) => remark,
    };
    joined.into_iter().map(part).collect()
}

/// Adds a part of a group to the table that it continues, or at the end.
fn add(joined: &mut Vec<(Part, Vec<String>)>, part: Part, by: &By, of: &str) {
    let named = |text: String| if of.is_empty() { text } else { format!("{of}: {text}") };
    let (name, detail, mut table) = match part {
        Part::Remark(text) => return joined.push((Part::Remark(named(text)), Vec::new())),
        Part::Table { name, detail, table } => (name, detail, table),
    };
    table.notes = std::mem::take(&mut table.notes).into_iter().map(named).collect();
    for row in &mut table.rows {
        row.splice(0..0, by.0.iter().map(|(_, value)| Cell::text(value)));
    }
    let columns = by.0.iter().map(|(column, _)| Column::new(column, column).repeated());
    table.columns.splice(0..0, columns);
    let continued = joined.iter_mut().find_map(|(known, details)| match known {
        Part::Table { name: of, table: known, .. }
            if *of == name && known.columns == table.columns =>
        {
            Some((known, details))
        }
        _ => None,
    });
    if let Some((known, details)) = continued {
        known.rows.append(&mut table.rows);
        known.notes.append(&mut table.notes);
        details.push(detail);
    } else {
        joined.push((Part::Table { name, detail: String::new(), table }, vec![detail]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(scene: &str, value: f64) -> Group<[f64; 3]> {
        Group { by: By(vec![("scene".to_owned(), scene.to_owned())]), result: [value; 3] }
    }

    fn parts(values: &[f64; 3], parts: &mut Parts) {
        let value = values[0];
        let row = vec![Cell::text("A"), Cell::number(value.to_string(), value)];
        parts.table(("scores", "Scores"), &[("method", "method"), ("mean", "mean")], vec![row]);
        parts.detail(format!("{value} participants"));
        parts.reasons((0..5).map(|n| (format!("M{n}"), Some("no votes".to_owned()))));
        parts.remark("done");
    }

    #[test]
    fn tables_of_groups_are_joined() {
        let joined = joined(&[group("hall", 2.0), group("road", 3.0)], parts);
        let [Part::Table { name, table, .. }, Part::Remark(first), Part::Remark(second)] =
            joined.as_slice()
        else {
            panic!("{joined:?}");
        };
        assert_eq!((*name, table.caption.as_str()), ("scores", "Scores"));
        assert_eq!(table.csv(), "scene,method,mean\nhall,A,2.0\nroad,A,3.0\n");
        assert_eq!(table.notes[1], "scene = road: M0, M1, M2 and 2 more: no votes");
        assert_eq!((first.as_str(), second.as_str()), ("scene = hall: done", "scene = road: done"));
    }

    #[test]
    fn what_all_groups_share_is_in_the_caption() {
        let joined = joined(&[group("hall", 2.0), group("road", 2.0)], parts);
        let Some(Part::Table { table, .. }) = joined.first() else { panic!("{joined:?}") };
        assert_eq!(table.caption, "Scores; 2 participants");
        let mut empty = Parts::default();
        empty.table(("none", "None"), &[("x", "x")], Vec::new());
        empty.reasons([("fit".to_owned(), Some("one level".to_owned())), ("x".to_owned(), None)]);
        assert_eq!(empty.0, [Part::Remark("fit: one level".to_owned())]);
    }
}
