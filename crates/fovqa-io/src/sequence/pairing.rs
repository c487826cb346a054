//! Pairs the frames of a test with those of the reference.

use std::collections::{BTreeMap, BTreeSet};

use fovqa_frame::source::{Doubt, Entry, Frames, Length, Listing, Numbering};
use thiserror::Error;

use super::spacing::Spacing;

/// A frame of the reference and the corresponding frame of a test, by their indices in the two
/// sources.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FramePair {
    /// The frame's number: the number in the reference's name or, if the names do not identify the
    /// frames by number, the index of the reference, from 0.
    pub number: i64,
    /// Index of the frame in the reference.
    pub reference: usize,
    /// Index of the frame in the test.
    pub test: usize,
}

/// The pairs of a sequence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pairs {
    /// The pairs, in the order of the references.
    pub pairs: Vec<FramePair>,
    /// How the frames are numbered.
    pub numbering: Numbering,
    /// Frames without a partner.
    pub alone: Unpaired,
}

/// Frames without a partner: their numbers, if they have any, and their names as in messages.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Unpaired {
    /// Frames of the reference that have no test.
    pub reference: Vec<(Option<i64>, String)>,
    /// Frames of the test that have no reference.
    pub test: Vec<(Option<i64>, String)>,
}

impl Unpaired {
    /// Keeps only the frames that are wanted. Frames without a number are kept.
    pub fn retain(&mut self, wanted: impl Fn(i64) -> bool) {
        for side in [&mut self.reference, &mut self.test] {
            side.retain(|(number, _)| number.is_none_or(&wanted));
        }
    }

    /// The number of frames without a partner.
    pub fn count(&self) -> usize {
        self.reference.len() + self.test.len()
    }
}

/// Frames that cannot be paired.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PairingError {
    /// Some frames have no partner.
    #[error("{}", unpaired(.0))]
    Unpaired(Unpaired),
    /// Several numbers change in the names.
    #[error("{argument}: {}; more than one could be the frame number", .doubt.in_words())]
    Ambiguous {
        /// The folder or glob.
        argument: String,
        /// The reason, with the names.
        doubt: Doubt,
    },
    /// No frame has a partner.
    #[error("no file of {reference} has a partner in {test}")]
    NoPairs {
        /// The reference argument.
        reference: String,
        /// The test argument.
        test: String,
    },
    /// The length of both sources is unknown.
    #[error(
        "the lengths of {reference} and {test} are both unknown, but one of them must be known"
    )]
    UnknownLengths {
        /// The reference argument.
        reference: String,
        /// The test argument.
        test: String,
    },
}

impl PairingError {
    /// How to correct the error.
    pub fn help(&self) -> String {
        match self {
            Self::Unpaired(_) => {
                "render the missing frames, or score the others with {allow_missing}".to_owned()
            }
            Self::NoPairs { .. } => {
                "frames are paired by the name without its ending, then by the number that changes from \
                 name to name; a pattern such as 'renders/f_%04d.png' selects this number"
                    .to_owned()
            }
            Self::UnknownLengths { .. } => "give a file for one of them".to_owned(),
            Self::Ambiguous { doubt: Doubt::Several { patterns, .. }, .. } => {
                let patterns: Vec<String> =
                    patterns.iter().map(|pattern| format!("'{pattern}.*'")).collect();
                let patterns = patterns.join(" or ");
                format!("give a pattern that selects the number instead of the folder, such as {patterns}")
            }
            Self::Ambiguous { .. } => "give a pattern with the number, such as %04d".to_owned(),
        }
    }
}

fn unpaired(alone: &Unpaired) -> String {
    const SHOWN: usize = 5;
    let side = |files: &[(Option<i64>, String)], of: &str, without: &str| {
        let names: Vec<&str> = files.iter().take(SHOWN).map(|(_, name)| name.as_str()).collect();
        let more = files.len().saturating_sub(SHOWN);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        format!("{of} without a {without}: {}{more}", joined_names(&names))
    };
    let mut parts = Vec::new();
    if !alone.reference.is_empty() {
        parts.push(side(&alone.reference, "reference", "test frame"));
    }
    if !alone.test.is_empty() {
        parts.push(side(&alone.test, "test", "reference frame"));
    }
    parts.join("; ")
}

/// Names separated by commas. Text that all names share in front of the frame number is written
/// once.
fn joined_names(names: &[&str]) -> String {
    let parts: Option<Vec<(&str, &str)>> =
        names.iter().map(|name| name.rsplit_once(", frame ")).collect();
    match parts.as_deref() {
        Some([(source, first), rest @ ..])
            if !rest.is_empty() && rest.iter().all(|(other, _)| other == source) =>
        {
            let rest = rest.iter().map(|(_, frame)| *frame);
            let frames: Vec<&str> = [*first].into_iter().chain(rest).collect();
            format!("{source}, frames {}", frames.join(", "))
        }
        _ => names.join(", "),
    }
}

/// Pairs the frames of two sources. Two single frames are paired as they are, others by stem and
/// then by number. A source without names, such as a video, has only positions. Its first frame is
/// paired with the first frame of the other source.
///
/// # Errors
/// When nothing can be paired, or several numbers in the names could be those of the frames.
pub fn pair(reference: &Listing, test: &Listing) -> Result<Pairs, PairingError> {
    let nothing = || {
        let (reference, test) = (reference.argument.clone(), test.argument.clone());
        PairingError::NoPairs { reference, test }
    };
    match (&reference.frames, &test.frames) {
        (Frames::Counted(length), Frames::Counted(other)) => {
            let paired_count = match (*length, *other) {
                (Length::Open, Length::Open) => {
                    let (reference, test) = (reference.argument.clone(), test.argument.clone());
                    return Err(PairingError::UnknownLengths { reference, test });
                }
                (Length::Open, length) | (length, Length::Open) => known(length),
                (length, other) => known(length).min(known(other)),
            };
            let pair = |at: usize| FramePair { number: at as i64, reference: at, test: at };
            // After a damaged frame there may have been any number of further frames.
            let alone = |of: &Listing, length: Length, other: Length| {
                let count =
                    if let Length::Damaged(_) = other { paired_count } else { known(length) };
                (paired_count..count).map(|at| (Some(at as i64), of.label(at))).collect()
            };
            let alone = Unpaired {
                reference: alone(reference, *length, *other),
                test: alone(test, *other, *length),
            };
            let numbering = Numbering::ByPosition;
            let pairs: Vec<_> = (0..paired_count).map(pair).collect();
            if pairs.is_empty() { Err(nothing()) } else { Ok(Pairs { pairs, numbering, alone }) }
        }
        (Frames::Named(names), Frames::Counted(length)) => {
            let counted = Counted { named: reference, names, length: *length, other: test };
            let (pairs, [named, other]) = counted.pairs(|number, named, other| FramePair {
                number,
                reference: named,
                test: other,
            })?;
            let alone = Unpaired { reference: named, test: other };
            if pairs.is_empty() {
                return Err(nothing());
            }
            Ok(Pairs { pairs, numbering: reference.numbering.clone(), alone })
        }
        (Frames::Counted(length), Frames::Named(names)) => {
            let counted = Counted { named: test, names, length: *length, other: reference };
            let (pairs, [named, other]) = counted.pairs(|number, named, other| FramePair {
                number,
                reference: other,
                test: named,
            })?;
            let alone = Unpaired { reference: other, test: named };
            if pairs.is_empty() {
                return Err(nothing());
            }
            Ok(Pairs { pairs, numbering: test.numbering.clone(), alone })
        }
        (Frames::Named(names), Frames::Named(tests)) => by_names(reference, names, test, tests),
    }
}

/// A source whose frames have names, and one whose frames have none.
struct Counted<'a> {
    named: &'a Listing,
    names: &'a [Entry],
    /// The length of the source without names.
    length: Length,
    other: &'a Listing,
}

/// The number of frames that are known before any of them is read.
fn known(length: Length) -> usize {
    match length {
        Length::Whole(frames) | Length::Damaged(frames) => frames,
        Length::Open => 0,
    }
}

/// Frames without a partner.
type UnpairedNames = Vec<(Option<i64>, String)>;

impl Counted<'_> {
    /// The pairs, and the frames without a partner: those of the source with names first. If a
    /// number is missing among the names, the frame at its position in the other source has no
    /// partner.
    fn pairs(
        &self,
        pair: impl Fn(i64, usize, usize) -> FramePair,
    ) -> Result<(Vec<FramePair>, [UnpairedNames; 2]), PairingError> {
        unambiguous(self.named)?;
        let number = |at: usize| self.names[at].number.unwrap_or(at as i64);
        let numbers: BTreeSet<i64> = (0..self.names.len()).map(number).collect();
        let spacing = Spacing::of(&numbers);
        let positions: Vec<usize> =
            (0..self.names.len()).map(|at| spacing.place(number(at))).collect();
        // A stream has all frames that the names ask for, and after a damaged frame there may have
        // been any number.
        let is_there =
            |at: &usize| self.length == Length::Open || positions[*at] < known(self.length);
        let (with, without): (Vec<usize>, Vec<usize>) = (0..self.names.len()).partition(is_there);
        let is_missed = |_: &&usize| !matches!(self.length, Length::Damaged(_));
        let without = without.iter().filter(is_missed);
        let taken: BTreeSet<usize> = with.iter().map(|at| positions[*at]).collect();
        let others = (0..known(self.length)).filter(|at| !taken.contains(at));
        let alone = [
            without.map(|at| (Some(number(*at)), self.named.label(*at))).collect(),
            others.map(|at| (spacing.number(at), self.other.label(at))).collect(),
        ];
        Ok((with.iter().map(|at| pair(number(*at), *at, positions[*at])).collect(), alone))
    }
}

/// Pairs by stem and then by number.
fn by_names(
    reference: &Listing,
    references: &[Entry],
    test: &Listing,
    tests: &[Entry],
) -> Result<Pairs, PairingError> {
    if let ([one], [other]) = (references, tests)
        && reference.is_single
        && test.is_single
    {
        // If both names have the same number, it is the frame's number.
        let number = one.number.filter(|n| other.number == Some(*n));
        let numbering =
            if number.is_some() { reference.numbering.clone() } else { Numbering::ByPosition };
        let pairs = vec![FramePair { number: number.unwrap_or(0), reference: 0, test: 0 }];
        return Ok(Pairs { pairs, numbering, alone: Unpaired::default() });
    }
    unambiguous(reference)?;
    let mut partner: Vec<Option<usize>> = vec![None; references.len()];
    let mut taken = vec![false; tests.len()];
    match_by(references, tests, &mut partner, &mut taken, |f| Some(f.stem.clone()));
    match_by(references, tests, &mut partner, &mut taken, |f| f.number);
    if partner.iter().any(Option::is_none) || taken.contains(&false) {
        unambiguous(test)?;
    }
    if partner.iter().all(Option::is_none) {
        let (reference, test) = (reference.argument.clone(), test.argument.clone());
        return Err(PairingError::NoPairs { reference, test });
    }

    let numbered = references.iter().all(|entry| entry.number.is_some());
    let untaken = tests.iter().zip(&taken).filter(|(_, taken)| !**taken);
    let untaken = untaken.map(|(f, _)| (f.number.filter(|_| numbered), f.name.to_string()));
    let mut alone = Unpaired { reference: Vec::new(), test: untaken.collect() };
    let mut pairs = Vec::new();
    let mut numbering = reference.numbering.clone();
    for (position, (entry, partner)) in references.iter().zip(partner).enumerate() {
        let number = entry.number.unwrap_or(position as i64);
        match partner {
            Some(index) => {
                // A single file does not show which of its numbers changes, but many tests do.
                let number = match (&numbering, tests[index].number) {
                    (Numbering::LastOfSeveral(_), Some(of_test))
                        if test.numbering == Numbering::ByName =>
                    {
                        numbering = Numbering::ByName;
                        of_test
                    }
                    _ => number,
                };
                pairs.push(FramePair { number, reference: position, test: index });
            }
            None => alone.reference.push((Some(number), entry.name.to_string())),
        }
    }
    Ok(Pairs { pairs, numbering, alone })
}

/// Refuses names in which several numbers could be that of the frame.
fn unambiguous(listing: &Listing) -> Result<(), PairingError> {
    match &listing.numbering {
        Numbering::Doubtful(doubt @ Doubt::Several { .. }) => {
            let (argument, doubt) = (listing.argument.clone(), doubt.clone());
            Err(PairingError::Ambiguous { argument, doubt })
        }
        _ => Ok(()),
    }
}

/// Pairs frames that have no partner yet and whose key is unique on both sides.
fn match_by<K: Ord>(
    reference: &[Entry],
    test: &[Entry],
    partner: &mut [Option<usize>],
    taken: &mut [bool],
    key: impl Fn(&Entry) -> Option<K>,
) {
    let unpaired_by_key = |files: &[Entry], is_alone: &dyn Fn(usize) -> bool| {
        let mut by_key: BTreeMap<K, Vec<usize>> = BTreeMap::new();
        for (index, file) in files.iter().enumerate().filter(|(i, _)| is_alone(*i)) {
            if let Some(key) = key(file) {
                by_key.entry(key).or_default().push(index);
            }
        }
        by_key
    };
    let references = unpaired_by_key(reference, &|i| partner[i].is_none());
    let tests = unpaired_by_key(test, &|i| !taken[i]);
    for (key, indices) in references {
        if let ([r], Some([t])) = (indices.as_slice(), tests.get(&key).map(Vec::as_slice)) {
            partner[*r] = Some(*t);
            taken[*t] = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::sequence::FileListing;
    use std::path::{Path, PathBuf};

    fn listing(names: &[&str]) -> Listing {
        let paths = names.iter().map(PathBuf::from).collect();
        FileListing::of_names(Path::new("dir"), paths).unwrap().listing(Path::new(""))
    }

    /// The names of a pair.
    fn names<'a>(pair: &FramePair, reference: &'a Listing, test: &'a Listing) -> [&'a str; 2] {
        [reference.name(pair.reference), test.name(pair.test)]
    }

    #[test]
    fn by_stem_then_by_number() {
        let paired = |reference: &[&str], test: &[&str], nth: usize| {
            let (reference, test) = (listing(reference), listing(test));
            let pair = pair(&reference, &test).unwrap().pairs[nth].clone();
            (pair.number, names(&pair, &reference, &test).map(str::to_owned))
        };
        let pair = paired(&["a/0000.exr", "a/0001.exr"], &["b/0000.png", "b/0001.png"], 1);
        assert_eq!(pair, (1, ["a/0001.exr", "b/0001.png"].map(str::to_owned)));
        let pair = paired(&["gt.0007.exr", "gt.0008.exr"], &["rmfr_8.png", "rmfr_7.png"], 0);
        assert_eq!(pair, (7, ["gt.0007.exr", "rmfr_7.png"].map(str::to_owned)));
        let references = ["gt_0001_1080p.exr", "gt_0002_1080p.exr"];
        let pair = paired(&references, &["rmfr_0002.png", "rmfr_0001.png"], 1);
        assert_eq!(pair, (2, ["gt_0002_1080p.exr", "rmfr_0002.png"].map(str::to_owned)));
    }

    /// A video is paired with files whose numbers begin with 1 and lack the third.
    #[test]
    fn frames_without_names_count_from_the_first() {
        let files = listing(&["f1.png", "f2.png", "f4.png"]);
        let of = |length| Listing::counted("v.y4m".to_owned(), length);
        let (video, damaged) = (|n| of(Length::Whole(n)), |n| of(Length::Damaged(n)));
        let stream = of(Length::Open);
        let whole = pair(&files, &video(4)).unwrap();
        let places: Vec<_> = whole.pairs.iter().map(|p| (p.number, p.reference, p.test)).collect();
        assert_eq!(places, [(1, 0, 0), (2, 1, 1), (4, 2, 3)]);
        assert_eq!(whole.alone.test, [(Some(3), "v.y4m, frame 2".to_owned())]);
        let long = pair(&files, &video(5)).unwrap().alone.test;
        assert_eq!(long.last(), Some(&(Some(5), "v.y4m, frame 4".to_owned())));
        let short = pair(&video(2), &files).unwrap();
        let places: Vec<_> = short.pairs.iter().map(|p| (p.number, p.reference, p.test)).collect();
        assert_eq!(places, [(1, 0, 0), (2, 1, 1)]);
        assert_eq!(short.alone.test, [(Some(4), "f4.png".to_owned())]);
        let counts = |reference: &Listing, test: &Listing| {
            let Pairs { pairs, alone, .. } = pair(reference, test).unwrap();
            (pairs.len(), alone.reference.len(), alone.test.len())
        };
        assert_eq!(counts(&files, &stream), (3, 0, 0));
        assert_eq!(counts(&files, &damaged(2)), (2, 0, 0));
        assert_eq!(counts(&files, &damaged(6)), (3, 0, 3));
        assert_eq!(counts(&video(2), &video(3)), (2, 0, 1));
        assert_eq!(counts(&stream, &video(3)), (3, 0, 0));
        assert_eq!(counts(&damaged(2), &video(3)), (2, 0, 0));
        assert_eq!(counts(&damaged(4), &video(3)), (3, 1, 0));
        assert_eq!(counts(&damaged(4), &damaged(5)), (4, 0, 0));
        assert_eq!(counts(&damaged(4), &stream), (4, 0, 0));
        let both = pair(&stream, &stream).unwrap_err();
        assert!(matches!(both, PairingError::UnknownLengths { .. }));
        let long = pair(&video(2), &video(9)).unwrap().alone;
        let said = PairingError::Unpaired(long).to_string();
        assert_eq!(said, "test without a reference frame: v.y4m, frames 2, 3, 4, 5, 6 and 2 more");
        assert!(pair(&video(0), &files).is_err());
    }

    #[test]
    fn lists_what_is_alone() {
        let (reference, test) =
            (listing(&["1.png", "2.png", "4.png"]), listing(&["2.png", "3.png"]));
        let Pairs { pairs, alone, .. } = pair(&reference, &test).unwrap();
        assert_eq!((pairs.len(), pairs[0].number), (1, 2));
        let file = |number, name: &str| (Some(number), name.to_owned());
        assert_eq!(alone.reference, [file(1, "1.png"), file(4, "4.png")]);
        assert_eq!(alone.test, [file(3, "3.png")]);
        assert!(matches!(
            pair(&listing(&["a.png"]), &listing(&["b.png"])),
            Err(PairingError::NoPairs { .. })
        ));
    }

    #[test]
    fn names_without_numbers_count_by_position() {
        let names = listing(&["blue.png", "red.png"]);
        let numbers = |test| {
            let pairs = pair(&names, &test).unwrap().pairs;
            pairs.iter().map(|p| p.number).collect::<Vec<_>>()
        };
        assert_eq!(numbers(names.clone()), [0, 1]);
        assert_eq!(numbers(listing(&["red.png"])), [1], "the same whichever method is scored");
    }

    #[test]
    fn several_numbers_that_change_ask_for_a_pattern() {
        let twice = ["f0001_t0017.png", "f0002_t0033.png"];
        let error = pair(&listing(&twice), &listing(&twice)).unwrap_err();
        assert!(error.to_string().contains("f0001_t0017 and f0002_t0033"), "{error}");
        assert!(error.help().contains("'f%04d_t*.*' or 'f*_t%04d.*'"), "{}", error.help());
        // Stems show which test belongs to which reference; numbers do not.
        let once = listing(&["f0001_t0017.png", "f0001_t0018.png"]);
        assert!(pair(&once, &listing(&twice)).is_err());
        let mut reference = once.clone();
        let Frames::Named(entries) = &mut reference.frames else { unreachable!() };
        (entries[0].stem, entries[1].stem) = ("f0001_t0017".into(), "f0002_t0033".into());
        assert_eq!(pair(&reference, &listing(&twice)).unwrap().pairs.len(), 2);
    }

    #[test]
    fn one_file_of_many_has_the_number_it_has_among_them() {
        let one = FileListing::of_file(Path::new("gt_0002_1080p.png")).listing(Path::new(""));
        let tests = listing(&["gt_0001_1080p.png", "gt_0002_1080p.png"]);
        assert_eq!(pair(&one, &tests).unwrap().pairs[0].number, 2);
        let doubtful = pair(&one, &one).unwrap();
        assert!(matches!(doubtful.numbering, Numbering::LastOfSeveral(_)));
        assert_eq!(doubtful.pairs[0].number, 1080);
    }
}
