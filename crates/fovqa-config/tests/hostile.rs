//! Files that ask for more than there is: refused at once, and without the memory they ask for.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;
use std::time::{Duration, Instant};

use fovqa_config::{ExperimentError, Fault, parse_curves, parse_experiment};

/// The mistakes of a text, found in a time that a person waits.
#[track_caller]
fn refused<T: std::fmt::Debug>(
    parse: fn(&Path, String) -> Result<T, ExperimentError>,
    text: &str,
    words: &str,
) -> Vec<Fault> {
    let from = Instant::now();
    let ExperimentError::Faults { faults, .. } =
        parse(Path::new("e.toml"), text.to_owned()).unwrap_err()
    else {
        panic!("a text is no unreadable file");
    };
    assert!(from.elapsed() < Duration::from_secs(10), "{:?}", from.elapsed());
    assert!(faults.iter().any(|fault| fault.message.contains(words)), "{:?}", faults[0]);
    assert!(faults.len() <= 10_000, "{}", faults.len());
    faults
}

fn list(count: usize, item: impl Fn(usize) -> String) -> String {
    (0..count).map(item).collect::<Vec<_>>().join(", ")
}

#[test]
fn every_resolution_with_every_gaze_and_direction() {
    let text = |count| {
        let sizes = list(count, |i| format!("\"{}x100\"", 100 + i));
        let gazes = list(count, |i| format!("[{i}, 0]"));
        let directions = list(count, |i| i.to_string());
        format!(
            "name = \"x\"\n[view]\nfov_vertical_deg = 90\nresolutions = [{sizes}]\ngazes = [{gazes}]\n\
             directions_deg = [{directions}]\n[[curve]]\nname = \"k\"\nmethod = {{ model = \"kfr\" }}\n\
             [[plot]]\nkind = \"rates\"\npanels = \"one\"\n"
        )
    };
    parse_curves(Path::new("e.toml"), text(5)).unwrap();
    refused(parse_curves, &text(100), "these are 1000000 curves, but at most 200 are allowed");
    // What is written twice is one curve; too many are too many of all tables together as well.
    let twice = text(5).replace("[0, 0], ", &"[0, 0], ".repeat(90));
    parse_curves(Path::new("e.toml"), twice).unwrap();
    let more = "[[curve]]\nname = \"r\"\nmethod = { model = \"rmfr\" }\n";
    refused(parse_curves, &(text(5) + more), "the file has more than 200 curves");
}

#[test]
fn every_method_in_every_scene() {
    let text = |scenes, methods| {
        let scenes = list(scenes, |i| format!("{{ name = \"s{i}\", reference = \"r\" }}"));
        let methods = list(methods, |i| format!("{{ name = \"m{i}\", test = \"t\" }}"));
        format!("name = \"x\"\nscene = [{scenes}]\nmethod = [{methods}]\n")
    };
    parse_experiment(Path::new("e.toml"), text(100, 100)).unwrap();
    refused(parse_experiment, &text(1000, 1000), "1000 methods in 1000 scenes");
    refused(parse_experiment, &text(10_001, 1), "scene cannot be an array of 10001");
}

#[test]
fn long_texts_and_paths_that_grow() {
    let text = |folder: usize, placeholders: usize| {
        let (folder, test) = ("f".repeat(folder), "{folder}".repeat(placeholders));
        format!(
            "name = \"x\"\nscene = [{{ name = \"s\", reference = \"r\", folder = \"{folder}\" }}]\n\
             method = [{{ name = \"m\", test = \"{test}\" }}]\n"
        )
    };
    parse_experiment(Path::new("e.toml"), text(10, 10)).unwrap();
    refused(parse_experiment, &text(4097, 1), "longer than 4096 characters");
    refused(parse_experiment, &text(4096, 512), "the path becomes longer than");
}

#[test]
fn mistakes_without_end() {
    let named = list(10_000, |i| format!("{{ name = \"s{i}\", reference = \"r\" }}"));
    let wrong = list(10_000, |i| format!("\"no{i}\""));
    let methods = list(10, |i| format!("{{ name = \"m{i}\", test = \"t\", scenes = [{wrong}] }}"));
    let text = format!("name = \"x\"\nscene = [{named}]\nmethod = [{methods}]\n");
    refused(parse_experiment, &text, "there is no scene \"no0\"");
    let scenes = list(9000, |_| "{ a = 1, b = 1, c = 1, d = 1 }".to_owned());
    let text =
        format!("name = \"x\"\nscene = [{scenes}]\n[[method]]\nname = \"m\"\ntest = \"t\"\n");
    refused(parse_experiment, &text, "has no key `a`");
    // A name as long as the file, with a thousand mistakes in its table.
    let (name, keys) = ("n".repeat(1 << 21), list(2000, |i| format!("k{i} = 1")));
    let text = format!("name = \"x\"\nscene = [{{ name = \"{name}\", {keys} }}]\n");
    let faults = refused(parse_experiment, &text, "scene has no key `k0`");
    assert!(faults.iter().all(|fault| fault.message.len() < 1000));
}
