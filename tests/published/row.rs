//! One line of the page: what a paper prints at a place, and what is computed.

use fovqa_report::{Printed, PrintedVerdict as Verdict};

/// A paper whose numbers are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Paper {
    /// Zhang, Gai, Li: visual acuity consistent foveated rendering.
    Vafr,
    /// Ye et al. 2022: rectangular mapping-based foveated rendering.
    Rmfr,
    /// Wang, Gu, Lu 2024: dominant-eye-aware foveated rendering.
    Deamp,
    /// Patney et al. 2016: perceptually-based foveated rendering.
    Patney,
}

impl Paper {
    /// All of them, in the order of the page.
    pub(super) const ALL: [Self; 4] = [Self::Vafr, Self::Rmfr, Self::Deamp, Self::Patney];

    /// Its short name.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Vafr => "VaFR",
            Self::Rmfr => "RMFR",
            Self::Deamp => "DEAMP",
            Self::Patney => "Patney et al.",
        }
    }

    /// Authors and subject.
    pub(super) fn reference(self) -> &'static str {
        match self {
            Self::Vafr => "Zhang, Gai, Li: visual acuity consistent foveated rendering",
            Self::Rmfr => "Ye et al. 2022: rectangular mapping-based foveated rendering",
            Self::Deamp => "Wang, Gu, Lu 2024: dominant-eye-aware foveated rendering",
            Self::Patney => "Patney et al. 2016: towards foveated rendering for gaze-tracked VR",
        }
    }
}

/// A printed number and the computed one, in the same unit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cell {
    /// Which one, where there are several.
    pub name: String,
    /// As it is printed.
    pub printed: Printed,
    /// As it is computed.
    pub computed: f64,
    /// Decimals in which the computed one is shown.
    pub decimals: usize,
}

impl Cell {
    /// A printed number beside a computed one.
    pub(super) fn new(
        name: impl Into<String>,
        printed: Printed,
        computed: f64,
        decimals: usize,
    ) -> Self {
        Self { name: name.into(), printed, computed, decimals }
    }

    /// What is to be said of it.
    pub(super) fn verdict(&self) -> Verdict {
        self.printed.verdict(self.computed)
    }

    /// The computed number, with the printed one's unit.
    pub(super) fn computed_text(&self) -> String {
        format!("{}{}", grouped(self.computed, self.decimals), self.printed.unit())
    }
}

/// Digits in groups of three, from 10,000 on.
fn grouped(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if value.abs() < 10_000.0 || !value.is_finite() {
        return text;
    }
    let whole = text.find('.').unwrap_or(text.len());
    let mut out = String::new();
    for (i, c) in text.char_indices() {
        if i > 0 && i < whole && (whole - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

#[derive(Debug, Clone, PartialEq)]
enum Shown {
    /// Each number, with this between them.
    Joined(&'static str),
    /// How many of them come out, and what they are.
    Counted(&'static str),
}

/// One line of the page. Computed values, errors and verdicts follow from its cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PageRow {
    /// The paper.
    pub paper: Paper,
    /// Where it is printed.
    pub place: &'static str,
    /// What the number is.
    pub quantity: String,
    /// In a few words, what to make of it.
    pub why: String,
    /// In whole sentences, where a few words do not do.
    pub more: Option<String>,
    shown: Shown,
    /// `None`: the table was not given.
    cells: Option<Vec<Cell>>,
    read_off: bool,
}

impl PageRow {
    /// A single number.
    pub(super) fn one(
        paper: Paper,
        place: &'static str,
        quantity: impl Into<String>,
        cell: Cell,
    ) -> Self {
        Self::joined(paper, place, quantity, "", vec![cell])
    }

    /// A few numbers, shown with something between them.
    pub(super) fn joined(
        paper: Paper,
        place: &'static str,
        quantity: impl Into<String>,
        between: &'static str,
        cells: Vec<Cell>,
    ) -> Self {
        Self {
            paper,
            place,
            quantity: quantity.into(),
            why: String::new(),
            more: None,
            shown: Shown::Joined(between),
            cells: Some(cells),
            read_off: false,
        }
    }

    /// Many numbers, of which only those that do not come out are shown. `None` where the table
    /// they are computed from was not given.
    pub(super) fn counted(
        paper: Paper,
        place: &'static str,
        quantity: impl Into<String>,
        what: &'static str,
        cells: Option<Vec<Cell>>,
    ) -> Self {
        let row = Self::joined(paper, place, quantity, "", Vec::new());
        Self { shown: Shown::Counted(what), cells, ..row }
    }

    pub(super) fn because(self, why: impl Into<String>) -> Self {
        Self { why: why.into(), ..self }
    }

    pub(super) fn more(self, more: impl Into<String>) -> Self {
        Self { more: Some(more.into()), ..self }
    }

    /// Something that went into the computed numbers was read off the printed ones.
    pub(super) fn read_off(self) -> Self {
        Self { read_off: true, ..self }
    }

    /// Its numbers; none when they are not checked.
    pub(super) fn cells(&self) -> &[Cell] {
        self.cells.as_deref().unwrap_or_default()
    }

    /// What is printed.
    pub(super) fn printed(&self) -> String {
        match (&self.cells, &self.shown) {
            (None, Shown::Counted(what)) => (*what).to_owned(),
            (_, Shown::Counted(what)) => format!("{} {what}", self.cells().len()),
            (_, Shown::Joined(between)) => {
                let mut texts: Vec<&str> = self.cells().iter().map(|c| c.printed.text()).collect();
                // "equal" is said once.
                texts.dedup();
                texts.join(between)
            }
        }
    }

    /// What is computed.
    pub(super) fn computed(&self) -> String {
        match (&self.cells, &self.shown) {
            (None, _) => "–".to_owned(),
            (Some(cells), Shown::Counted(_)) => {
                let held = cells.iter().filter(|c| c.verdict() == Verdict::Reproduced).count();
                format!("{held} of {}", cells.len())
            }
            (Some(cells), Shown::Joined(between)) => {
                let texts: Vec<String> = cells.iter().map(Cell::computed_text).collect();
                texts.join(between)
            }
        }
    }

    /// How far the computed number is above the printed one, relative to it; of several the largest.
    /// Bounds have none.
    pub(super) fn relative_error(&self) -> Option<f64> {
        let errors = self.cells().iter().filter_map(|c| c.printed.relative_error(c.computed));
        errors.max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// What is to be said of it: of several numbers the worst.
    pub(super) fn verdict(&self) -> Verdict {
        let Some(cells) = &self.cells else { return Verdict::NotChecked };
        match cells.iter().map(Cell::verdict).max() {
            // A row without numbers shows nothing.
            None => Verdict::NotReproduced,
            Some(Verdict::Reproduced) if self.read_off => Verdict::NotIndependent,
            Some(verdict) => verdict,
        }
    }

    /// Of many numbers that are only counted, those that do not come out.
    pub(super) fn exceptions(&self) -> Vec<&Cell> {
        let counted = matches!(self.shown, Shown::Counted(_));
        let missing = |cell: &&Cell| counted && cell.verdict() != Verdict::Reproduced;
        self.cells().iter().filter(missing).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(computed: &[f64]) -> Vec<Cell> {
        let cell = |c: &f64| Cell::new(format!("of {c}"), Printed::new("20 %"), *c, 1);
        computed.iter().map(cell).collect()
    }

    fn counted(cells: Option<Vec<Cell>>) -> PageRow {
        PageRow::counted(Paper::Rmfr, "Table 1", "numbers", "cells", cells)
    }

    #[test]
    fn several_numbers_are_as_good_as_the_worst() {
        let row = counted(Some(cells(&[20.4, 19.6, 17.0, 22.0])));
        assert_eq!(row.verdict(), Verdict::NotReproduced);
        assert_eq!((row.printed().as_str(), row.computed().as_str()), ("4 cells", "2 of 4"));
        assert!((row.relative_error().unwrap() + 0.15).abs() < 1e-12);
        let names: Vec<&str> = row.exceptions().iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["of 17", "of 22"]);
        assert_eq!(counted(Some(cells(&[20.4, 19.6]))).verdict(), Verdict::Reproduced);
        assert_eq!(counted(Some(Vec::new())).verdict(), Verdict::NotReproduced);
        assert_eq!(counted(None).verdict(), Verdict::NotChecked);
        assert_eq!(counted(None).computed(), "–");
    }

    #[test]
    fn what_was_read_off_is_not_independent_and_may_still_fail() {
        let read_off = |computed| counted(Some(cells(computed))).read_off().verdict();
        assert_eq!(read_off(&[20.0]), Verdict::NotIndependent);
        assert_eq!(read_off(&[20.0, 30.0]), Verdict::NotReproduced);
    }

    #[test]
    fn numbers_are_shown_like_the_printed_ones() {
        let row = PageRow::joined(Paper::Vafr, "", "", " / ", cells(&[17.51, 4.06]));
        assert_eq!((row.printed().as_str(), row.computed().as_str()), ("20 %", "17.5 % / 4.1 %"));
        for (value, decimals, text) in [
            (1_061_733.72, 1, "1,061,733.7"),
            (74_649_600.0, 0, "74,649,600"),
            (1637.9, 1, "1637.9"),
            (-12_345.0, 0, "-12,345"),
            (123_456.0, 0, "123,456"),
        ] {
            assert_eq!(grouped(value, decimals), text);
        }
    }
}
