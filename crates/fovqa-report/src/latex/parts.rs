//! Divides the columns and the rows of a table into parts that fit on a page.

use std::ops::Range;

use super::cells::Printer;
use super::width::{LINE, lines};
use super::{Section, Sheet};

/// Maximum number of columns of a part, besides those that every part repeats.
pub(super) const MOST_COLUMNS: usize = 10;
/// Maximum width of a part in points: 7 inches, the text of a page with two columns.
const WIDEST: f64 = 505.0;
/// The space between two columns in points (twice `\tabcolsep`).
pub(super) const GAP: f64 = 12.0;

/// Some columns of a table, by their indices.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Part {
    pub(super) columns: Vec<usize>,
    /// The width in points.
    pub(super) width: f64,
}

/// The columns of each part. Columns of one group stay together if a part can hold them.
pub(super) fn parts(sheet: &Sheet, printers: &[Printer]) -> Vec<Part> {
    let columns = 0..sheet.columns.len();
    let (repeated, others): (Vec<usize>, Vec<usize>) =
        columns.partition(|index| sheet.columns[*index].is_repeated);
    let of = |columns: &[usize]| columns.iter().map(|index| printers[*index].width + GAP).sum();
    let beside: f64 = of(&repeated);
    let fits = |columns: &[usize]| {
        columns.len() <= MOST_COLUMNS && beside + span_width(sheet, printers, columns) <= WIDEST
    };
    let mut atoms: Vec<Vec<usize>> = Vec::new();
    for index in others {
        let group = group_of(sheet, index);
        match atoms.last_mut() {
            Some(last) if group.is_some() && group == group_of(sheet, last[0]) => last.push(index),
            _ => atoms.push(vec![index]),
        }
    }
    let atoms: Vec<Vec<usize>> = atoms
        .into_iter()
        .flat_map(|atom| if fits(&atom) { vec![atom] } else { alone(&atom) })
        .collect();
    let divided = |most: usize| {
        let mut parts: Vec<Vec<usize>> = Vec::new();
        for atom in &atoms {
            let joined = parts.last().map(|last| [last.as_slice(), atom].concat());
            match joined.filter(|joined| joined.len() <= most && fits(joined)) {
                Some(joined) => *parts.last_mut().unwrap_or(&mut Vec::new()) = joined,
                None => parts.push(atom.clone()),
            }
        }
        parts
    };
    // As few parts as possible, and none much wider than the others.
    let fewest = divided(MOST_COLUMNS).len();
    let even = (1..=MOST_COLUMNS).map(divided).find(|parts| parts.len() == fewest);
    let parts = even.unwrap_or_default().into_iter().map(|columns| Part {
        width: beside + span_width(sheet, printers, &columns),
        columns: [repeated.as_slice(), &columns].concat(),
    });
    let parts: Vec<Part> = parts.collect();
    if parts.is_empty() { vec![Part { columns: repeated, width: beside }] } else { parts }
}

fn alone(columns: &[usize]) -> Vec<Vec<usize>> {
    columns.iter().map(|index| vec![*index]).collect()
}

/// The index of the group that a column belongs to.
pub(super) fn group_of(sheet: &Sheet, column: usize) -> Option<usize> {
    sheet.groups.iter().position(|group| (group.first..=group.last).contains(&column))
}

/// Neighbouring columns of one group, as ranges of positions in `columns`.
pub(super) fn runs(sheet: &Sheet, columns: &[usize]) -> Vec<(Option<usize>, Range<usize>)> {
    let mut runs: Vec<(Option<usize>, Range<usize>)> = Vec::new();
    for (at, column) in columns.iter().enumerate() {
        let group = group_of(sheet, *column);
        match runs.last_mut() {
            Some((last, range)) if group.is_some() && *last == group => range.end = at + 1,
            _ => runs.push((group, at..at + 1)),
        }
    }
    runs
}

/// The width of columns with the headings above them.
fn span_width(sheet: &Sheet, printers: &[Printer], columns: &[usize]) -> f64 {
    let run = |(group, range): (Option<usize>, Range<usize>)| {
        let inner: f64 = columns[range].iter().map(|index| printers[*index].width + GAP).sum();
        let head = group.map_or(0.0, |group| sheet.groups[group].head.line_width() + GAP);
        inner.max(head)
    };
    runs(sheet, columns).into_iter().map(run).sum()
}

/// Some rows of a section.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Slice<'a> {
    pub(super) section: &'a Section,
    pub(super) rows: Range<usize>,
}

/// The space of a rule in points.
pub(super) const RULE: f64 = 6.5;

/// The height in points of rows of a section, with the rule and the title above them, in a part of
/// this width.
pub(super) fn height(Slice { section, rows }: &Slice<'_>, width: f64) -> f64 {
    let of_row = |row: &Vec<_>| row.iter().map(Printer::lines).max().unwrap_or(1);
    let title = if section.title.is_empty() { 0 } else { lines(&section.title, 0.9 * width) };
    let rows: usize = section.rows[rows.clone()].iter().map(of_row).sum();
    RULE + LINE * (title + rows) as f64
}

/// Divides the rows into pages of at most this height in points. A section stays together if a page
/// can hold it.
pub(super) fn pages(sheet: &Sheet, width: f64, most: f64) -> Vec<Vec<Slice<'_>>> {
    let height = |slice: &Slice<'_>| height(slice, width);
    let mut pages: Vec<Vec<Slice<'_>>> = vec![Vec::new()];
    let mut used = 0.0;
    for section in &sheet.sections {
        let whole = Slice { section, rows: 0..section.rows.len() };
        let height_of_whole = height(&whole);
        if used > 0.0 && used + height_of_whole > most {
            pages.push(Vec::new());
            used = 0.0;
        }
        if height_of_whole <= most {
            used += height_of_whole;
            pages.last_mut().into_iter().for_each(|page| page.push(whole.clone()));
            continue;
        }
        let mut from = 0;
        for at in 0..section.rows.len() {
            if at > from && height(&Slice { section, rows: from..at + 1 }) > most {
                let page = vec![Slice { section, rows: from..at }];
                pages.last_mut().into_iter().for_each(|last| last.extend(page.clone()));
                pages.push(Vec::new());
                from = at;
            }
        }
        let rest = Slice { section, rows: from..section.rows.len() };
        used = height(&rest);
        pages.last_mut().into_iter().for_each(|page| page.push(rest.clone()));
    }
    pages
}
