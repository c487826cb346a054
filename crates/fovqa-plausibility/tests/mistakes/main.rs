//! Mistakes made on purpose are noticed, and correct pairs are not suspected.
//!
//! `cargo test --release -p fovqa-plausibility --test mistakes -- --nocapture` prints how many of each
//! kind are noticed; with `FOVQA_PICTURES=FILE`, of the pairs in a list too. A line of it is:
//! reference, test, exposure in stops, and gaze `x,y`.

#![allow(clippy::print_stdout, reason = "the table is what the measurement is made for")]

mod cases;
mod picture;

use std::collections::BTreeMap;
use std::path::Path;

use cases::{Innocent, Made, Mistake};
use fovqa_frame::{SignalParams, SignalTables, Transfer};
use fovqa_params::Words;
use fovqa_plausibility::{Check, Looked, look};
use fovqa_testkit::synthetic::rgb8;
use picture::{Pair, Picture, read};

/// Real foveated renders: reference, test, exposure in stops, gaze.
const RENDERS: [(&str, &str, f64, [f64; 2]); 10] = [
    ("living-room/gt.png", "living-room/rmfr.png", 0.0, [360.0, 400.0]),
    ("living-room/gt.png", "living-room/kfr.png", 0.0, [360.0, 400.0]),
    ("living-room/gt.png", "living-room/hyper3.png", 0.0, [360.0, 400.0]),
    ("living-room/gt.png", "living-room/vafr.png", 0.0, [360.0, 400.0]),
    ("stereo/left_gt.exr", "stereo/left_rmfr.exr", 0.0, [202.1, 200.0]),
    ("stereo/right_gt.exr", "stereo/right_rmfr.exr", 0.0, [197.9, 200.0]),
    ("classroom/gt/0000.exr", "classroom/rmfr_noaa/0000.png", CLASSROOM, [160.0, 180.0]),
    ("classroom/gt/0002.exr", "classroom/rmfr_noaa/0002.png", CLASSROOM, [160.0, 180.0]),
    ("classroom/gt/0000.exr", "classroom/rmfr_taa/0000.png", CLASSROOM, [160.0, 180.0]),
    ("classroom/gt/0005.exr", "classroom/rmfr_taa/0005.png", CLASSROOM, [160.0, 180.0]),
];

/// The exposure of the scene's pictures in stops.
const CLASSROOM: f64 = 0.659_76;

fn pairs() -> Vec<Pair> {
    let small = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/small");
    let of = |(r, t, exposure, gaze): (String, String, f64, [f64; 2])| {
        let [reference, test] = [&r, &t].map(|file| read(&small.join(file), exposure));
        Pair { name: t, reference, test, gaze }
    };
    let mut pairs: Vec<(String, String, f64, [f64; 2])> =
        RENDERS.iter().map(|(r, t, e, g)| ((*r).to_owned(), (*t).to_owned(), *e, *g)).collect();
    if let Some(list) = std::env::var_os("FOVQA_PICTURES") {
        for line in std::fs::read_to_string(list).expect("a list of pairs").lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let [reference, test, exposure, gaze] = words[..] else { panic!("{line}") };
            let number = |text: &str| text.parse::<f64>().expect(line);
            let (x, y) = gaze.split_once(',').expect(line);
            let pair = (reference.to_owned(), test.to_owned());
            pairs.push((pair.0, pair.1, number(exposure), [number(x), number(y)]));
        }
    }
    pairs.into_iter().map(of).collect()
}

/// How many of the cases were noticed as what they are.
#[derive(Default, Clone, Copy)]
struct Count {
    cases: u32,
    noticed: u32,
    /// Noticed as something else.
    otherwise: u32,
}

#[test]
fn mistakes_are_noticed_and_correct_pairs_are_not_suspected() {
    let pairs = pairs();
    let mut alarms = Vec::new();
    let mut innocent = 0;
    let mut counts: BTreeMap<(Mistake, Innocent), Count> = BTreeMap::new();
    for (nth, pair) in pairs.iter().enumerate() {
        // Another scene: the next pair of the same size, or else a cut of another one.
        let other = &pairs[(nth + 4) % pairs.len()].reference;
        for way in Innocent::ALL {
            let correct = way.apply(pair, nth as u64);
            innocent += 1;
            for suspicion in correct.look() {
                alarms.push(format!("{} {way:?}: {}", pair.name, suspicion.message));
            }
            for mistake in Mistake::ALL {
                for Made { pair, check } in mistake.made(&correct, other) {
                    let found = pair.look();
                    let count = counts.entry((mistake, way)).or_default();
                    count.cases += 1;
                    if found.iter().any(|suspicion| check.contains(&suspicion.check)) {
                        count.noticed += 1;
                    }
                    if !found.is_empty()
                        && found.iter().all(|suspicion| !check.contains(&suspicion.check))
                    {
                        count.otherwise += 1;
                    }
                }
            }
        }
    }
    println!("{} correct pairs, {} suspected", innocent, alarms.len());
    for alarm in &alarms {
        println!("  {alarm}");
    }
    print_table(&counts);
    assert!(alarms.is_empty(), "{alarms:#?}");
    for mistake in Mistake::ALL {
        let all = counts.iter().filter(|((of, _), _)| *of == mistake);
        let (cases, noticed) = all.fold((0, 0), |(n, k), (_, c)| (n + c.cases, k + c.noticed));
        assert!(
            f64::from(noticed) >= mistake.least() * f64::from(cases),
            "{mistake:?}: {noticed} of {cases} noticed"
        );
    }
}

fn print_table(counts: &BTreeMap<(Mistake, Innocent), Count>) {
    print!("{:<12}", "");
    for way in Innocent::ALL {
        print!("{:>18}", format!("{way:?}"));
    }
    println!();
    for mistake in Mistake::ALL {
        print!("{:<12}", format!("{mistake:?}"));
        for way in Innocent::ALL {
            let count = counts.get(&(mistake, way)).copied().unwrap_or_default();
            let otherwise = if count.otherwise > 0 {
                format!(" (+{})", count.otherwise)
            } else {
                String::new()
            };
            print!("{:>18}", format!("{}/{}{otherwise}", count.noticed, count.cases));
        }
        println!();
    }
}

#[test]
fn every_check_has_a_case() {
    let tried: Vec<Check> =
        Mistake::ALL.iter().flat_map(|mistake| mistake.checks()).copied().collect();
    for check in Check::all() {
        // Files are compared by their kind, not by their pixels.
        assert!(tried.contains(&check) || check == Check::Format, "{}", check.word());
    }
}

/// The messages about the foveated reference of a pair, after a change of the test and of the gaze.
fn said(change: impl Fn(&Picture) -> Picture, gaze: [f64; 2]) -> Vec<String> {
    let pair = pairs().swap_remove(0);
    let mut pair = Innocent::Foveated.apply(&pair, 0);
    pair.test = change(&pair.test);
    pair.gaze = gaze;
    pair.look().into_iter().map(|suspicion| suspicion.message).collect()
}

#[test]
fn messages_have_the_right_direction_amount_and_place() {
    const GAZE: [f64; 2] = [360.0, 400.0];
    let shifted = said(|test| test.shifted([2, -3]), GAZE);
    let wanted =
        "the test is shifted by 2 pixels to the right and 3 pixels up against the reference";
    assert_eq!(shifted, [wanted]);
    let flipped = said(|test| test.flipped(false, true), GAZE);
    assert!(flipped[0].starts_with("the test is upside down"), "{flipped:?}");
    let darker = said(|test| test.map(|v| v * 0.5_f32.powf(1.0 / 2.2)), GAZE);
    let words: Vec<&str> = darker[0].split(' ').collect();
    assert_eq!(words[4..6], ["stops", "darker"], "{darker:?}");
    let stops: f64 = words[3].parse().expect("a number of stops");
    assert!((stops - 1.0).abs() < 0.15, "{darker:?}");
    let gaze = said(Picture::clone, [600.0, 120.0]);
    let place = gaze[0].split(['(', ')']).nth(1).expect("a place");
    let (x, y) = place.split_once(", ").expect("two numbers");
    let [x, y] = [x, y].map(|text| text.parse::<f64>().expect("a number"));
    assert!((x - GAZE[0]).hypot(y - GAZE[1]) < 80.0, "{gaze:?}");
}

#[test]
fn a_border_that_is_nearly_everything_is_no_fault() {
    let bright = |x: usize, y: usize| {
        if x < 24 && y < 24 && !x.is_multiple_of(6) { (x * 7 + y * 5) as u8 } else { 0 }
    };
    let places = (0..240 * 240).map(|at| bright(at % 240, at / 240));
    let codes: Vec<u8> = places.flat_map(|v| [v; 3]).collect();
    let frame = rgb8(240, 240, codes);
    for transfer in [None, Some(Transfer::Pq), Some(Transfer::Gamma22), Some(Transfer::Linear)] {
        let tables = SignalTables::new(SignalParams { transfer, ..SignalParams::default() });
        let (reference, test, tables) = (&frame, &frame, &tables);
        let pair = Looked { reference, test, tables, counts: None, gaze_px: Some([1.0, 1.0]) };
        assert_eq!(look(&pair), []);
    }
}
