//! Names of frames: their numbers, their order, their pairs, and patterns made of them.
//!
//! An input is a list of names, a line each; an empty line parts references from tests.

#![no_main]

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use fovqa_frame::source::{Listing, Numbering};
use fovqa_fuzz::abort_on_escaping_panics;
use fovqa_io::sequence::{FileListing, FramePattern, FrameRange, Pairs, Spacing, pair};
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: abort_on_escaping_panics(), |bytes: &[u8]| {
    let lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
    let parting = lines.iter().position(|line| line.is_empty()).unwrap_or(lines.len());
    let (references, tests) = lines.split_at(parting);
    let names: Vec<String> =
        lines.iter().map(|line| String::from_utf8_lossy(line).into_owned()).collect();
    for name in &names {
        ranges(name);
        patterns(name, &names);
    }
    let Some(reference) = listing(references) else { return };
    let Some(test) = listing(tests) else { return };
    spacing(&reference);
    let [reference, test] = [reference, test].map(|files| files.listing(Path::new("")));
    let pairs = pair(&reference, &test).inspect(|pairs| whole(&reference, &test, pairs));
    let turned = pair(&test, &reference).inspect(|pairs| whole(&test, &reference, pairs));
    if let (Ok(pairs), Ok(turned)) = (pairs, turned) {
        let there: BTreeSet<_> = pairs.pairs.iter().map(|p| (p.reference, p.test)).collect();
        let back: BTreeSet<_> = turned.pairs.iter().map(|p| (p.test, p.reference)).collect();
        assert_eq!(there, back, "pairs are the same from either side");
    }
});

/// The listing of names, if no two of them are one; their order is by number.
fn listing(lines: &[&[u8]]) -> Option<FileListing> {
    let path = |line: &&[u8]| {
        let name = [line, &b".png"[..]].concat();
        (!line.is_empty() && !line.contains(&b'/')).then(|| PathBuf::from(OsStr::from_bytes(&name)))
    };
    let paths: Vec<PathBuf> = lines.iter().filter_map(path).collect();
    let listing = FileListing::of_names(Path::new("folder"), paths.clone()).ok()?;
    let given: BTreeSet<&PathBuf> = paths.iter().collect();
    let listed: BTreeSet<&PathBuf> = listing.files.iter().map(|file| &file.path).collect();
    assert_eq!(given, listed, "no file is lost");
    assert_eq!(listing.files.len(), paths.len(), "each file is there once");
    let numbers: Vec<i64> = listing.files.iter().filter_map(|file| file.number).collect();
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "{numbers:?} rise");
    let numbered = matches!(listing.numbering, Numbering::ByName | Numbering::LastOfSeveral(_));
    assert_eq!(numbers.len(), if numbered { paths.len() } else { 0 }, "all or none");
    Some(listing)
}

/// Each file is in one pair, or alone, and frames come in the order of their numbers.
fn whole(reference: &Listing, test: &Listing, pairs: &Pairs) {
    let side = |listing: &Listing, paired: Vec<usize>, alone: &[(Option<i64>, String)]| {
        let paired = paired.into_iter().map(|at| listing.name(at));
        let all: Vec<&str> = paired.chain(alone.iter().map(|(_, name)| name.as_str())).collect();
        assert_eq!(all.len(), listing.entries().len());
        assert_eq!(all.into_iter().collect::<BTreeSet<_>>().len(), listing.entries().len());
    };
    let (left, right) = pairs.pairs.iter().map(|p| (p.reference, p.test)).unzip();
    side(reference, left, &pairs.alone.reference);
    side(test, right, &pairs.alone.test);
    assert!(pairs.pairs.windows(2).all(|pair| pair[0].number < pair[1].number));
}

/// A name with one of its numbers left open is a pattern that finds that number in it.
fn patterns(name: &str, names: &[String]) {
    if let Some(Ok(pattern)) = FramePattern::parse(name) {
        for name in names {
            let _ = pattern.number(name);
        }
    }
    if name.contains(['%', '#', '@', '$', '*', '?']) {
        return;
    }
    let is_digit = |index: usize| name.as_bytes().get(index).is_some_and(u8::is_ascii_digit);
    let starts = (0..name.len()).filter(|at| is_digit(*at) && (*at == 0 || !is_digit(at - 1)));
    for start in starts {
        let width = (start..).take_while(|index| is_digit(*index)).count();
        let end = start + width;
        let Ok(number) = name[start..end].parse::<i64>() else { continue };
        // A field has at most as many digits as 64 bits.
        if width > 19 {
            continue;
        }
        for field in [format!("%0{width}d"), "#".repeat(width), format!("$F{width}")] {
            let pattern = format!("{}{field}{}", &name[..start], &name[end..]);
            let pattern = FramePattern::parse(&pattern).expect("a field").expect("one field");
            assert_eq!(pattern.number(name), Some(number), "{name:?} {pattern:?}");
            if name[..start].ends_with('-') && number > 0 {
                let pattern = format!("{}{field}{}", &name[..start - 1], &name[end..]);
                let pattern = FramePattern::parse(&pattern).expect("a field").expect("one field");
                let found = pattern.number(name);
                assert!(found.is_none_or(|found| found == -number), "{name:?} {pattern:?}");
            }
        }
    }
}

/// A selection of frames is what it says when it is written down.
fn ranges(text: &str) {
    let Ok(range) = text.parse::<FrameRange>() else { return };
    assert_eq!(range.to_string().parse(), Ok(range));
    for number in [i64::MIN, -1, 0, 1, i64::MAX] {
        let _ = range.contains(number);
    }
}

/// Frames follow each other as their numbers do, and what is missing is none of them.
fn spacing(listing: &FileListing) {
    let numbers: BTreeSet<i64> = listing.files.iter().filter_map(|file| file.number).collect();
    let spacing = Spacing::of(&numbers);
    let places: Vec<usize> = numbers.iter().map(|number| spacing.place(*number)).collect();
    assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{places:?} rise");
    let missing = spacing.missing(|number| {
        assert!(!numbers.contains(&number));
        true
    });
    let steps = places.last().copied().unwrap_or(0) as u64;
    // One step fewer than numbers; the numbers of 64 bits are more than can be counted in them.
    let holes = steps.saturating_sub((numbers.len() as u64).saturating_sub(1));
    assert_eq!(missing.count(), if numbers.is_empty() { 0 } else { holes });
    assert_eq!(missing.is_empty(), missing.count() == 0);
    let _ = missing.to_string();
}
