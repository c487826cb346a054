//! Reference files and test files to pairs.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::argument::{FrameFile, Listing};

/// A reference file and the test file that shows the same frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FramePair {
    /// The frame's number: that of the reference's name, or its position among the references,
    /// from 0, where their names have none that tells them apart.
    pub number: u64,
    /// Its position among the references, from 0: frames follow each other where these do, whatever
    /// their numbers.
    pub position: usize,
    /// Reference file.
    pub reference: PathBuf,
    /// Test file.
    pub test: PathBuf,
}

/// The pairs of a sequence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pairs {
    /// The pairs, in natural order of the references.
    pub pairs: Vec<FramePair>,
    /// Number of the sequence's first frame, whether or not it has a partner.
    pub first: u64,
    /// Files without a partner.
    pub alone: Alone,
}

/// Files without a partner, with their frame number where they have one.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Alone {
    /// References without a test.
    pub reference: Vec<(Option<u64>, PathBuf)>,
    /// Tests without a reference.
    pub test: Vec<(Option<u64>, PathBuf)>,
}

impl Alone {
    /// Only the frames that are wanted; what has no number is.
    pub fn retain(&mut self, wanted: impl Fn(u64) -> bool) {
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
        let all = |files: Vec<(Option<u64>, PathBuf)>| {
            files.into_iter().map(|(number, path)| (number, shown(&path))).collect()
        };
        match self {
            Self::Unpaired(Alone { reference, test }) => {
                Self::Unpaired(Alone { reference: all(reference), test: all(test) })
            }
            Self::Nothing { reference, test } => {
                Self::Nothing { reference: shown(&reference), test: shown(&test) }
            }
        }
    }

    /// How to mend it.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Unpaired(_) => {
                "render the missing frames, or score the others with {allow_missing}"
            }
            Self::Nothing { .. } => {
                "frames pair by the name without its ending, then by the last number in it"
            }
        }
    }
}

fn unpaired(alone: &Alone) -> String {
    const SHOWN: usize = 5;
    let side = |files: &[(Option<u64>, PathBuf)], of: &str, without: &str| {
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
/// When nothing pairs.
pub fn pair(reference: &Listing, test: &Listing) -> Result<Pairs, PairingError> {
    if reference.is_file && test.is_file {
        let (reference, test) = (&reference.files[0], &test.files[0]);
        // A number both names carry is the frame's.
        let number = reference.number.filter(|n| test.number == Some(*n)).unwrap_or(0);
        let (reference, test) = (reference.path.clone(), test.path.clone());
        let pairs = vec![FramePair { number, position: 0, reference, test }];
        return Ok(Pairs { pairs, first: number, alone: Alone::default() });
    }
    let mut partner: Vec<Option<usize>> = vec![None; reference.files.len()];
    let mut taken = vec![false; test.files.len()];
    match_by(&reference.files, &test.files, &mut partner, &mut taken, |f| Some(f.stem.clone()));
    match_by(&reference.files, &test.files, &mut partner, &mut taken, |f| f.number);
    if partner.iter().all(Option::is_none) {
        let (reference, test) = (reference.argument.clone(), test.argument.clone());
        return Err(PairingError::Nothing { reference, test });
    }

    let numbers: BTreeSet<u64> = reference.files.iter().filter_map(|f| f.number).collect();
    let numbered = numbers.len() == reference.files.len();
    let first = numbers.first().copied().filter(|_| numbered).unwrap_or(0);
    let untaken = test.files.iter().zip(&taken).filter(|(_, taken)| !**taken);
    let untaken = untaken.map(|(f, _)| (f.number.filter(|_| numbered), f.path.clone()));
    let mut alone = Alone { reference: Vec::new(), test: untaken.collect() };
    let mut pairs = Vec::new();
    for (position, (file, partner)) in reference.files.iter().zip(partner).enumerate() {
        let number = file.number.filter(|_| numbered).unwrap_or(position as u64);
        let reference = file.path.clone();
        match partner {
            Some(index) => {
                let test = test.files[index].path.clone();
                pairs.push(FramePair { number, position, reference, test });
            }
            None => alone.reference.push((Some(number), reference)),
        }
    }
    Ok(Pairs { pairs, first, alone })
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
    use super::super::natural_order::last_number;
    use super::*;

    fn listing(names: &[&str]) -> Listing {
        let files = names.iter().map(|name| {
            let stem = name.split_once('/').map_or(*name, |(_, name)| name);
            let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem).to_owned();
            let number = last_number(&stem);
            FrameFile { path: PathBuf::from(name), stem, number }
        });
        Listing { argument: PathBuf::from("dir"), is_file: false, files: files.collect() }
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
        assert_eq!(pairs.iter().map(|p| p.position).collect::<Vec<_>>(), [0, 1]);
    }

    #[test]
    fn lists_what_is_alone() {
        let (reference, test) =
            (listing(&["1.png", "2.png", "4.png"]), listing(&["2.png", "3.png"]));
        let Pairs { pairs, alone, .. } = pair(&reference, &test).unwrap();
        assert_eq!((pairs.len(), pairs[0].position), (1, 1), "the second of the references");
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
}
