//! Reference files and test files to pairs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::frame_number::{Doubt, Numbering};
use super::listing::{FrameFile, Listing};

/// A reference file and the test file that shows the same frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FramePair {
    /// The frame's number: that of the reference's name, or its position among the references,
    /// from 0, where their names have none that tells them apart.
    pub number: i64,
    /// Reference file.
    pub reference: PathBuf,
    /// Test file.
    pub test: PathBuf,
}

/// The pairs of a sequence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pairs {
    /// The pairs, in the order of the references.
    pub pairs: Vec<FramePair>,
    /// How the frames are numbered.
    pub numbering: Numbering,
    /// Files without a partner.
    pub alone: Alone,
}

/// Files without a partner, with their frame number where they have one.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Alone {
    /// References without a test.
    pub reference: Vec<(Option<i64>, PathBuf)>,
    /// Tests without a reference.
    pub test: Vec<(Option<i64>, PathBuf)>,
}

impl Alone {
    /// Only the frames that are wanted; what has no number is.
    pub fn retain(&mut self, wanted: impl Fn(i64) -> bool) {
        for side in [&mut self.reference, &mut self.test] {
            side.retain(|(number, _)| number.is_none_or(&wanted));
        }
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.reference.len() + self.test.len()
    }
}

/// Files that do not pair.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PairingError {
    /// Files without a partner.
    #[error("{}", unpaired(.0))]
    Unpaired(Alone),
    /// Names in which several numbers change.
    #[error("{}: {}; either could be the number of the frame", argument.display(), .doubt.in_words())]
    Ambiguous {
        /// The folder or glob.
        argument: PathBuf,
        /// Which names.
        doubt: Doubt,
    },
    /// Not a single pair.
    #[error("no file of {} has a partner in {}", .reference.display(), .test.display())]
    Nothing {
        /// The reference argument.
        reference: PathBuf,
        /// The test argument.
        test: PathBuf,
    },
}

impl PairingError {
    /// The same of other paths: as results show them.
    #[must_use]
    pub fn with_paths(self, shown: &dyn Fn(&Path) -> PathBuf) -> Self {
        let all = |files: Vec<(Option<i64>, PathBuf)>| {
            files.into_iter().map(|(number, path)| (number, shown(&path))).collect()
        };
        match self {
            Self::Unpaired(Alone { reference, test }) => {
                Self::Unpaired(Alone { reference: all(reference), test: all(test) })
            }
            Self::Nothing { reference, test } => {
                Self::Nothing { reference: shown(&reference), test: shown(&test) }
            }
            Self::Ambiguous { argument, doubt } => {
                Self::Ambiguous { argument: shown(&argument), doubt }
            }
        }
    }

    /// How to mend it.
    pub fn help(&self) -> String {
        match self {
            Self::Unpaired(_) => {
                "render the missing frames, or score the others with {allow_missing}".to_owned()
            }
            Self::Nothing { .. } => {
                "frames pair by the name without its ending, then by the number that changes from \
                 name to name; a pattern such as 'renders/f_%04d.png' says which that is"
                    .to_owned()
            }
            Self::Ambiguous { doubt: Doubt::Several { patterns, .. }, .. } => {
                let patterns: Vec<String> =
                    patterns.iter().map(|pattern| format!("'{pattern}.*'")).collect();
                let patterns = patterns.join(" or ");
                format!("say which with a pattern instead of the folder, such as {patterns}")
            }
            Self::Ambiguous { .. } => "give a pattern with the number, such as %04d".to_owned(),
        }
    }
}

fn unpaired(alone: &Alone) -> String {
    const SHOWN: usize = 5;
    let side = |files: &[(Option<i64>, PathBuf)], of: &str, without: &str| {
        let names = files.iter().take(SHOWN).map(|(_, path)| path.display().to_string());
        let names: Vec<_> = names.collect();
        let more = files.len().saturating_sub(SHOWN);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        format!("{of} without a {without}: {}{more}", names.join(", "))
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

/// Pairs files: two single files as they are, others by stem and then by number.
///
/// # Errors
/// When nothing pairs, or several numbers in the names could be those of the frames.
pub fn pair(reference: &Listing, test: &Listing) -> Result<Pairs, PairingError> {
    if reference.is_file && test.is_file {
        let numbering = reference.numbering.clone();
        let (reference, test) = (&reference.files[0], &test.files[0]);
        // A number both names carry is the frame's.
        let number = reference.number.filter(|n| test.number == Some(*n));
        let numbering = if number.is_some() { numbering } else { Numbering::ByPosition };
        let (reference, test) = (reference.path.clone(), test.path.clone());
        let pairs = vec![FramePair { number: number.unwrap_or(0), reference, test }];
        return Ok(Pairs { pairs, numbering, alone: Alone::default() });
    }
    unambiguous(reference)?;
    let mut partner: Vec<Option<usize>> = vec![None; reference.files.len()];
    let mut taken = vec![false; test.files.len()];
    match_by(&reference.files, &test.files, &mut partner, &mut taken, |f| Some(f.stem.clone()));
    match_by(&reference.files, &test.files, &mut partner, &mut taken, |f| f.number);
    if partner.iter().any(Option::is_none) || taken.contains(&false) {
        unambiguous(test)?;
    }
    if partner.iter().all(Option::is_none) {
        let (reference, test) = (reference.argument.clone(), test.argument.clone());
        return Err(PairingError::Nothing { reference, test });
    }

    let numbered = reference.files.iter().all(|file| file.number.is_some());
    let untaken = test.files.iter().zip(&taken).filter(|(_, taken)| !**taken);
    let untaken = untaken.map(|(f, _)| (f.number.filter(|_| numbered), f.path.clone()));
    let mut alone = Alone { reference: Vec::new(), test: untaken.collect() };
    let mut pairs = Vec::new();
    let mut numbering = reference.numbering.clone();
    for (position, (file, partner)) in reference.files.iter().zip(partner).enumerate() {
        let number = file.number.unwrap_or(position as i64);
        let reference_file = file.path.clone();
        match partner {
            Some(index) => {
                let other = &test.files[index];
                // A file by itself does not tell which of its numbers changes; many tests do.
                let number = match (&numbering, other.number) {
                    (Numbering::LastOfSeveral(_), Some(of_test))
                        if test.numbering == Numbering::ByName =>
                    {
                        numbering = Numbering::ByName;
                        of_test
                    }
                    _ => number,
                };
                let (reference, test) = (reference_file, other.path.clone());
                pairs.push(FramePair { number, reference, test });
            }
            None => alone.reference.push((Some(number), reference_file)),
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

/// Pairs what is still alone and whose key is the only one of its side.
fn match_by<K: Ord>(
    reference: &[FrameFile],
    test: &[FrameFile],
    partner: &mut [Option<usize>],
    taken: &mut [bool],
    key: impl Fn(&FrameFile) -> Option<K>,
) {
    let alone = |files: &[FrameFile], is_alone: &dyn Fn(usize) -> bool| {
        let mut by_key: BTreeMap<K, Vec<usize>> = BTreeMap::new();
        for (index, file) in files.iter().enumerate().filter(|(i, _)| is_alone(*i)) {
            if let Some(key) = key(file) {
                by_key.entry(key).or_default().push(index);
            }
        }
        by_key
    };
    let references = alone(reference, &|i| partner[i].is_none());
    let tests = alone(test, &|i| !taken[i]);
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

    fn listing(names: &[&str]) -> Listing {
        Listing::of_names(Path::new("dir"), names.iter().map(PathBuf::from).collect()).unwrap()
    }

    #[test]
    fn by_stem_then_by_number() {
        let pairs =
            pair(&listing(&["a/0000.exr", "a/0001.exr"]), &listing(&["b/0000.png", "b/0001.png"]));
        assert_eq!(pairs.unwrap().pairs[1].test, PathBuf::from("b/0001.png"));
        let pairs = pair(
            &listing(&["gt.0007.exr", "gt.0008.exr"]),
            &listing(&["rmfr_8.png", "rmfr_7.png"]),
        )
        .unwrap()
        .pairs;
        assert_eq!((pairs[0].number, pairs[0].test.clone()), (7, PathBuf::from("rmfr_7.png")));
        let pairs = pair(
            &listing(&["gt_0001_1080p.exr", "gt_0002_1080p.exr"]),
            &listing(&["rmfr_0002.png", "rmfr_0001.png"]),
        );
        let pairs = pairs.unwrap().pairs;
        assert_eq!((pairs[1].number, pairs[1].test.clone()), (2, PathBuf::from("rmfr_0002.png")));
    }

    #[test]
    fn lists_what_is_alone() {
        let (reference, test) =
            (listing(&["1.png", "2.png", "4.png"]), listing(&["2.png", "3.png"]));
        let Pairs { pairs, alone, .. } = pair(&reference, &test).unwrap();
        assert_eq!((pairs.len(), pairs[0].number), (1, 2));
        let file = |number, name: &str| (Some(number), PathBuf::from(name));
        assert_eq!(alone.reference, [file(1, "1.png"), file(4, "4.png")]);
        assert_eq!(alone.test, [file(3, "3.png")]);
        assert!(matches!(
            pair(&listing(&["a.png"]), &listing(&["b.png"])),
            Err(PairingError::Nothing { .. })
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
        // Stems tell which test belongs to which reference; numbers do not.
        let once = listing(&["f0001_t0017.png", "f0001_t0018.png"]);
        assert!(pair(&once, &listing(&twice)).is_err());
        let mut reference = once.clone();
        (reference.files[0].stem, reference.files[1].stem) =
            ("f0001_t0017".into(), "f0002_t0033".into());
        assert_eq!(pair(&reference, &listing(&twice)).unwrap().pairs.len(), 2);
    }

    #[test]
    fn one_file_of_many_has_the_number_it_has_among_them() {
        let one = Listing::of_file(Path::new("gt_0002_1080p.png"));
        let tests = listing(&["gt_0001_1080p.png", "gt_0002_1080p.png"]);
        assert_eq!(pair(&one, &tests).unwrap().pairs[0].number, 2);
        let doubtful = pair(&one, &one).unwrap();
        assert!(matches!(doubtful.numbering, Numbering::LastOfSeveral(_)));
        assert_eq!(doubtful.pairs[0].number, 1080);
    }
}
