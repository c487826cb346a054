//! Floats: the parts of a table below each other, and as many floats as the pages need.

use std::fmt::Write;

use super::cells::{Printer, broken};
use super::number::BEST;
use super::parts::{Part, RULE, Slice, height, pages, parts, runs};
use super::width::{INCH, LINE, lines, width};
use super::{Cell, Sheet};

/// Maximum height of a float in points: the text of a page of the standard classes.
const HIGHEST: f64 = 540.0;
/// Width in points of a column of a page with two. A wider table spans both.
const NARROW: f64 = 3.3 * INCH;
/// Words of captions and titles that are wider than this may be broken, in points.
const WIDEST_WORD: f64 = 100.0;

/// The LaTeX text of floats.
pub(super) struct Floats {
    pub(super) text: String,
    /// The width of the widest part in points.
    pub(super) width: f64,
    /// Whether the floats span both columns of a page with two.
    pub(super) is_wide: bool,
}

pub(super) fn floats(sheet: &Sheet) -> Floats {
    let printers: Vec<Printer> =
        (0..sheet.columns.len()).map(|index| Printer::of(sheet, index)).collect();
    let parts = parts(sheet, &printers);
    let width = parts.iter().map(|part| part.width).fold(0.0, f64::max);
    let is_wide = width > NARROW;
    let narrowest = parts.iter().map(|part| part.width).fold(width, f64::min);
    let column = if is_wide { width } else { NARROW };
    let caption = LINE * (1 + lines(&sheet.caption, 0.9 * column)) as f64 + 20.0;
    let heads = parts.iter().map(|part| head_height(sheet, part));
    let highest = heads.fold(0.0, f64::max);
    let most = HIGHEST - caption;
    let pages = pages(sheet, narrowest, (most - highest).max(10.0 * LINE));
    // All parts of some rows stand in one float if there is space.
    let mut bodies: Vec<(String, f64)> = Vec::new();
    for page in &pages {
        let rows: f64 = page.iter().map(|slice| height(slice, narrowest)).sum();
        for part in &parts {
            let high = head_height(sheet, part) + rows;
            let text = Tabular { sheet, printers: &printers, part }.text(page);
            match bodies.last_mut() {
                Some((body, used)) if *used + LINE + high < most => {
                    body.push_str("\n\\medskip\n");
                    body.push_str(&text);
                    *used += LINE + high;
                }
                _ => bodies.push((text, high)),
            }
        }
    }
    let mut text = String::new();
    if has_best(sheet) {
        text.push_str(BEST);
    }
    let float = if is_wide { "table*" } else { "table" };
    for (index, (body, _)) in bodies.iter().enumerate() {
        let caption = broken(&sheet.caption, WIDEST_WORD);
        let _ = writeln!(text, "\\begin{{{float}}}\n\\centering");
        if index == 0 {
            let label = if sheet.label.is_empty() {
                String::new()
            } else {
                format!("\\label{{{}}}", sheet.label)
            };
            let _ = writeln!(text, "\\caption{{{caption}}}{label}");
        } else {
            // Each float of one table has the same number.
            let _ = writeln!(text, "\\addtocounter{{table}}{{-1}}");
            let _ = writeln!(text, "\\caption{{{caption} (continued)}}");
        }
        let _ = writeln!(text, "\\smallskip\n{body}\\end{{{float}}}");
    }
    Floats { text, width, is_wide }
}

/// The height in points of the headings of a part and of the rules around it.
fn head_height(sheet: &Sheet, part: &Part) -> f64 {
    let names = part.columns.iter().map(|index| sheet.columns[*index].head.name_lines());
    let names = names.max().unwrap_or(1);
    let groups = if sheet.groups.is_empty() { 0.0 } else { LINE + RULE };
    groups + LINE * (names + 1) as f64 + 2.0 * RULE
}

fn has_best(sheet: &Sheet) -> bool {
    let cells = sheet.sections.iter().flat_map(|section| section.rows.iter().flatten());
    let mut numbers = cells.filter_map(|cell| match cell {
        Cell::Number(number) => Some(number),
        Cell::Text(_) => None,
    });
    numbers.any(|number| number.is_best)
}

/// Writes one part of a table.
struct Tabular<'a> {
    sheet: &'a Sheet,
    printers: &'a [Printer],
    part: &'a Part,
}

impl Tabular<'_> {
    fn text(&self, page: &[Slice<'_>]) -> String {
        let columns = self.runs().into_iter().map(|run| {
            let of = |index: &usize| if self.sheet.columns[*index].is_text { 'l' } else { 'r' };
            run.iter().map(of).collect::<String>()
        });
        let columns = columns.collect::<Vec<_>>().join(" ");
        let mut text = format!("\\begin{{tabular}}{{{columns}}}\n\\toprule\n");
        self.head(&mut text);
        for Slice { section, rows } in page {
            text.push_str("\\midrule\n");
            if !section.title.is_empty() {
                let begun = rows.start > 0;
                self.title(&section.title, begun, &mut text);
            }
            for row in &section.rows[rows.clone()] {
                let cells = self.part.columns.iter().map(|index| {
                    let cell = row.get(*index);
                    cell.map(|cell| self.printers[*index].text(cell)).unwrap_or_default()
                });
                text.push_str(&cells.collect::<Vec<_>>().join(" & "));
                text.push_str(" \\\\\n");
            }
        }
        text.push_str("\\bottomrule\n\\end{tabular}\n");
        text
    }

    /// The columns, those of one group together.
    fn runs(&self) -> Vec<&[usize]> {
        let columns = &self.part.columns;
        runs(self.sheet, columns).into_iter().map(|(_, range)| &columns[range]).collect()
    }

    /// Headings of groups, names, and units.
    fn head(&self, text: &mut String) {
        let sheet = self.sheet;
        let columns = &self.part.columns;
        let runs = runs(sheet, columns);
        let grouped = || runs.iter().filter_map(|(group, range)| Some(((*group)?, range)));
        if grouped().next().is_some() {
            let cells = runs.iter().map(|(group, range)| match group {
                None => String::new(),
                Some(group) => format!(
                    "\\multicolumn{{{}}}{{c}}{{{}}}",
                    range.len(),
                    sheet.groups[*group].head.line()
                ),
            });
            text.push_str(cells.collect::<Vec<_>>().join(" & ").trim_start());
            text.push_str(" \\\\\n");
            for (_, range) in grouped() {
                let _ = write!(text, "\\cmidrule(lr){{{}-{}}}", range.start + 1, range.end);
            }
            text.push('\n');
        }
        let heads = || columns.iter().map(|index| &sheet.columns[*index]);
        let units: Vec<String> = heads().map(|column| column.head.unit_text()).collect();
        let has_units = units.iter().any(|unit| !unit.is_empty());
        // Names of text columns stand in the lower line.
        let names = heads().map(|column| {
            let is_below = column.is_text && has_units;
            if is_below { String::new() } else { column.head.name_text() }
        });
        text.push_str(&names.collect::<Vec<_>>().join(" & "));
        text.push_str(" \\\\\n");
        if has_units {
            let lower = heads().zip(&units).map(|(column, unit)| {
                if column.is_text { column.head.name_text() } else { unit.clone() }
            });
            text.push_str(&lower.collect::<Vec<_>>().join(" & "));
            text.push_str(" \\\\\n");
        }
    }

    /// The line above the rows of a section.
    fn title(&self, title: &str, is_continued: bool, text: &mut String) {
        let columns = self.part.columns.len();
        let continued = if is_continued { " (continued)" } else { "" };
        let title = format!("{title}{continued}");
        let wide = self.part.width - 12.0;
        let plain = broken(&title, WIDEST_WORD.min(wide));
        let title = if width(&title) > 0.9 * wide {
            format!("\\parbox[t]{{{wide:.0}pt}}{{\\raggedright\\strut \\emph{{{plain}}}\\strut}}")
        } else {
            format!("\\emph{{{plain}}}")
        };
        let _ = writeln!(text, "\\multicolumn{{{columns}}}{{l}}{{{title}}} \\\\");
    }
}
