//! The frame number in a file name: the run of digits that changes over the names of a folder.
//!
//! A single name does not show what changes, so its last run of digits counts. A minus sign in
//! front of the digits belongs to the number if a separator, or nothing, stands before it
//! (`f.-0002`), and otherwise if the same names occur without it (`f-0002` beside `f0000`). In
//! `f-0001`, `f-0002` alone it is a separator.

use std::collections::{BTreeMap, BTreeSet};

use fovqa_frame::source::{Doubt, Numbering};

/// A run of digits in a name.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Run<'a> {
    /// The byte position in the name where the number starts, including a minus sign that belongs
    /// to it.
    start: usize,
    end: usize,
    minus: Minus,
    /// The digits without leading zeros; empty for 0.
    digits: &'a str,
}

/// The meaning of a minus sign in front of digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Minus {
    /// There is no minus sign, or it is in front of a 0.
    Absent,
    Sign,
    /// It is a separator, unless the same names without it show that it is a sign.
    Separator,
}

impl Run<'_> {
    fn key(&self) -> (bool, &str) {
        (self.minus == Minus::Sign, self.digits)
    }

    fn value(&self) -> Option<i64> {
        let sign = if self.minus == Minus::Sign { "-" } else { "" };
        let digits = if self.digits.is_empty() { "0" } else { self.digits };
        format!("{sign}{digits}").parse().ok()
    }
}

/// A name and its runs of digits.
struct Name<'a> {
    text: &'a str,
    runs: Vec<Run<'a>>,
}

impl<'a> Name<'a> {
    fn new(text: &'a str) -> Self {
        let bytes = text.as_bytes();
        let mut runs = Vec::new();
        let mut at = 0;
        while at < bytes.len() {
            if !bytes[at].is_ascii_digit() {
                at += 1;
                continue;
            }
            let length = bytes[at..].iter().take_while(|b| b.is_ascii_digit()).count();
            let (start, end) = (at, at + length);
            let digits = text[start..end].trim_start_matches('0');
            let minus = match text[..start].strip_suffix('-') {
                Some(before) if !digits.is_empty() => match before.chars().next_back() {
                    Some(c) if c.is_alphanumeric() || c == '-' => Minus::Separator,
                    _ => Minus::Sign,
                },
                _ => Minus::Absent,
            };
            let start = if minus == Minus::Sign { start - 1 } else { start };
            runs.push(Run { start, end, minus, digits });
            at = end;
        }
        Self { text, runs }
    }

    /// The text between the numbers, with a mark for each number.
    fn wording(&self) -> String {
        let mut wording = String::new();
        let mut at = 0;
        for run in &self.runs {
            wording.push_str(&self.text[at..run.start]);
            wording.push('\0');
            at = run.end;
        }
        wording + &self.text[at..]
    }

    /// Makes the minus sign in front of a run part of its number.
    fn negate(&mut self, run: usize) {
        self.runs[run].minus = Minus::Sign;
        self.runs[run].start -= 1;
    }

    /// Takes a minus sign as part of the number if the same name without it is among `wordings`.
    fn signed(mut self, wordings: &BTreeSet<String>) -> Self {
        for run in 0..self.runs.len() {
            if self.runs[run].minus == Minus::Separator {
                self.negate(run);
                if !wordings.contains(&self.wording()) {
                    self.runs[run].minus = Minus::Separator;
                    self.runs[run].start += 1;
                }
            }
        }
        self
    }

    /// A pattern in which one run is the frame's number, and the runs `any` are wildcards.
    fn pattern(&self, number: usize, any: &[usize]) -> String {
        let mut pattern = String::new();
        let mut at = 0;
        for (index, run) in self.runs.iter().enumerate() {
            pattern.push_str(&self.text[at..run.start]);
            let width = run.end - run.start;
            match index {
                _ if index == number => pattern.push_str(&field(self.text, run, width)),
                _ if any.contains(&index) => pattern.push('*'),
                _ => pattern.push_str(&self.text[run.start..run.end]),
            }
            at = run.end;
        }
        pattern + &self.text[at..]
    }
}

/// `%04d` for a number that is padded with zeros, `%d` for another one.
fn field(text: &str, run: &Run<'_>, width: usize) -> String {
    if text[run.start..run.end].starts_with('0') && width > 1 {
        format!("%0{width}d")
    } else {
        "%d".to_owned()
    }
}

/// The frame numbers of files with these names (without extensions), and how they were found. All
/// numbers are `None` if the names do not identify the frames by number.
pub(crate) fn frame_numbers(names: &[&str]) -> (Vec<Option<i64>>, Numbering) {
    let none = |numbering| (vec![None; names.len()], numbering);
    let first: Vec<Name<'_>> = names.iter().map(|name| Name::new(name)).collect();
    let wordings: BTreeSet<String> = first.iter().map(Name::wording).collect();
    let taken: Vec<Name<'_>> = first.into_iter().map(|name| name.signed(&wordings)).collect();
    if taken.iter().all(|name| name.runs.is_empty()) {
        return none(Numbering::ByPosition);
    }
    if let [name] = taken.as_slice() {
        let number = name.runs.last().and_then(Run::value);
        let keys: BTreeSet<_> = name.runs.iter().map(Run::key).collect();
        let numbering = match number {
            None => Numbering::Doubtful(Doubt::TooLarge(name.text.to_owned())),
            Some(_) if keys.len() > 1 => Numbering::LastOfSeveral(name.text.to_owned()),
            Some(_) => Numbering::ByName,
        };
        return (vec![number], numbering);
    }
    if let Some(name) = taken.iter().find(|name| name.runs.is_empty()) {
        return none(Numbering::Doubtful(Doubt::Without(name.text.to_owned())));
    }
    match changing(&taken).map(|chosen| numbered(&taken, &chosen)) {
        Ok(Ok(numbers)) => (numbers.into_iter().map(Some).collect(), Numbering::ByName),
        Ok(Err(doubt)) | Err(doubt) => none(Numbering::Doubtful(doubt)),
    }
}

/// The run of each name that is the frame's number.
fn changing<'a>(names: &'a [Name<'_>]) -> Result<Vec<&'a Run<'a>>, Doubt> {
    let wording = names[0].wording();
    let other = names.iter().find(|name| name.wording() != wording);
    let fewest = names.iter().map(|name| name.runs.len()).min().unwrap_or(0);
    let from_start = |k: usize| names.iter().map(|n| &n.runs[k]).collect::<Vec<_>>();
    let from_end = |k: usize| names.iter().map(|n| &n.runs[n.runs.len() - 1 - k]).collect();
    let mut columns: Vec<Vec<&Run<'_>>> = (0..fewest).map(from_start).collect();
    if other.is_some() {
        columns.extend((0..fewest).map(from_end));
    }
    let keys = |column: &[&'a Run<'_>]| column.iter().map(|run| run.key()).collect::<Vec<_>>();
    let changes = |column: &[&Run<'_>]| column.iter().any(|run| run.key() != column[0].key());
    let mut places: Vec<usize> = Vec::new();
    for place in (0..columns.len()).filter(|place| changes(&columns[*place])) {
        if !places.iter().any(|known| keys(&columns[*known]) == keys(&columns[place])) {
            places.push(place);
        }
    }
    match (places.as_slice(), other) {
        // All names have the same numbers, so any run will do; the last is used.
        ([], _) => Ok(from_end(0)),
        ([place], _) => Ok(columns.swap_remove(*place)),
        (_, Some(other)) => Err(Doubt::Wording(names[0].text.to_owned(), other.text.to_owned())),
        ([one, another, ..], None) => {
            let differs = |name: &&Name<'_>| {
                [*one, *another].iter().all(|k| name.runs[*k].key() != names[0].runs[*k].key())
            };
            let second = names.iter().find(differs).unwrap_or(&names[names.len() - 1]);
            let all: Vec<usize> =
                (0..columns.len()).filter(|place| changes(&columns[*place])).collect();
            let patterns = places.iter().map(|place| names[0].pattern(*place, &all)).collect();
            let names = [names[0].text.to_owned(), second.text.to_owned()];
            Err(Doubt::Several { names, patterns })
        }
    }
}

/// The values of runs, if each value occurs once.
fn numbered(names: &[Name<'_>], runs: &[&Run<'_>]) -> Result<Vec<i64>, Doubt> {
    let mut seen: BTreeMap<i64, &str> = BTreeMap::new();
    let mut numbers = Vec::with_capacity(runs.len());
    for (name, run) in names.iter().zip(runs) {
        let number = run.value().ok_or_else(|| Doubt::TooLarge(name.text.to_owned()))?;
        if let Some(other) = seen.insert(number, name.text) {
            return Err(Doubt::Twice(number, other.to_owned(), name.text.to_owned()));
        }
        numbers.push(number);
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(names: &[&str]) -> Vec<i64> {
        let (numbers, numbering) = frame_numbers(names);
        assert!(!matches!(numbering, Numbering::Doubtful(_)), "{numbering:?}");
        numbers.into_iter().map(Option::unwrap).collect()
    }

    fn doubt(names: &[&str]) -> Doubt {
        match frame_numbers(names) {
            (numbers, Numbering::Doubtful(doubt)) => {
                assert!(numbers.iter().all(Option::is_none), "{numbers:?}");
                doubt
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_run_that_changes_is_the_number() {
        assert_eq!(numbers(&["gt_0001_1080p", "gt_0002_1080p"]), [1, 2]);
        assert_eq!(numbers(&["shot12_0001_v3", "shot12_0002_v3", "shot12_0010_v3"]), [1, 2, 10]);
        assert_eq!(numbers(&["4k_0001", "4k_0002"]), [1, 2]);
        assert_eq!(numbers(&["f9", "f10", "f11"]), [9, 10, 11]);
        assert_eq!(numbers(&["2024-05-01_120000_0001", "2024-05-01_120000_0002"]), [1, 2]);
        assert_eq!(numbers(&["render_1920x1080_7_of_8", "render_1920x1080_8_of_8"]), [7, 8]);
        // A number that occurs twice in each name counts as one number.
        assert_eq!(numbers(&["f0001_t0001", "f0002_t0002"]), [1, 2]);
        assert_eq!(numbers(&["f1_t0001", "f2_t0002"]), [1, 2]);
        // Names with different wording have the same numbers, counted from either end.
        assert_eq!(numbers(&["blue2", "red1"]), [2, 1]);
        assert_eq!(numbers(&["f1_final", "f2_final2"]), [1, 2]);
        assert_eq!(numbers(&["1699999999990", "1699999999991"])[1], 1_699_999_999_991);
    }

    #[test]
    fn one_name_alone_has_its_last_number() {
        assert_eq!(numbers(&["shot2_gt.0017"]), [17]);
        assert_eq!(numbers(&["12é7x"]), [7]);
        assert_eq!(frame_numbers(&["f.0017"]).1, Numbering::ByName);
        assert_eq!(frame_numbers(&["a1_1"]).1, Numbering::ByName);
        let several = Numbering::LastOfSeveral("gt_0001_1080p".into());
        assert_eq!(frame_numbers(&["gt_0001_1080p"]), (vec![Some(1080)], several));
        assert_eq!(frame_numbers(&["gt"]), (vec![None], Numbering::ByPosition));
    }

    #[test]
    fn a_minus_sign_belongs_to_the_number_behind_a_separator() {
        assert_eq!(numbers(&["f.-0002", "f.-0001", "f.0000", "f.0001"]), [-2, -1, 0, 1]);
        assert_eq!(numbers(&["-1", "0", "1"]), [-1, 0, 1]);
        assert_eq!(numbers(&["f_-12_1080p", "f_5_1080p"]), [-12, 5]);
        assert_eq!(numbers(&["f.-0002"]), [-2]);
    }

    #[test]
    fn a_minus_sign_behind_a_letter_is_one_where_names_are_without_it() {
        assert_eq!(numbers(&["f-0001", "f-0002"]), [1, 2]);
        assert_eq!(numbers(&["f-0002", "f-0001", "f0000", "f0001"]), [-2, -1, 0, 1]);
        assert_eq!(numbers(&["f--1", "f-0", "f-1"]), [-1, 0, 1]);
        assert_eq!(numbers(&["f--1", "f--2"]), [1, 2]);
        assert_eq!(numbers(&["2024-05-01", "2024-05-02"]), [1, 2]);
        assert_eq!(numbers(&["f-0000", "f-0001"]), [0, 1]);
    }

    #[test]
    fn uncertain_numbers_are_doubtful() {
        let Doubt::Several { names, patterns } =
            doubt(&["f0001_t0017_4k", "f0001_t0033_4k", "f0002_t0050_4k"])
        else {
            panic!("two numbers change")
        };
        assert_eq!(names, ["f0001_t0017_4k", "f0002_t0050_4k"]);
        assert_eq!(patterns, ["f%04d_t*_4k", "f*_t%04d_4k"]);
        assert_eq!(doubt(&["cover", "f1"]), Doubt::Without("cover".into()));
        let twice = |n, a: &str, b: &str| Doubt::Twice(n, a.into(), b.into());
        assert_eq!(doubt(&["left_1", "right_1"]), twice(1, "left_1", "right_1"));
        assert_eq!(doubt(&["f1", "f01"]), twice(1, "f1", "f01"));
        assert_eq!(doubt(&["f.-0", "f.0"]), twice(0, "f.-0", "f.0"));
        let wording = Doubt::Wording("bath2_v1".into(), "lab12_v2".into());
        assert_eq!(doubt(&["bath2_v1", "lab12_v2"]), wording);
        let large = "f99999999999999999999999";
        assert_eq!(doubt(&["f1", large]), Doubt::TooLarge(large.into()));
        assert_eq!(frame_numbers(&["blue", "red"]).1, Numbering::ByPosition);
        assert_eq!(frame_numbers(&[]), (vec![], Numbering::ByPosition));
    }
}
