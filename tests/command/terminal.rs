//! What a terminal shows: whole words at 50 columns, and what is going on after the last frame.

use crate::command::pseudo_terminal::{of, shown};
use crate::fovqa::{Folder, command};
use crate::runs::experiment_folder::{experiment, two_scenes};

fn words(text: &str) -> Vec<&str> {
    text.split_whitespace().collect()
}

/// Whether no line is longer than this, apart from a single word.
#[track_caller]
fn assert_within(columns: usize, text: &str) {
    for line in text.lines() {
        let is_word = line.split_whitespace().count() == 1;
        assert!(line.chars().count() <= columns || is_word, "{line:?} in\n{text}");
    }
}

#[test]
fn help_keeps_its_words_whole() {
    let folder = Folder::new();
    for arguments in [
        &["--help"][..],
        &["score", "-h"],
        &["score", "--help"],
        &["run", "--help"],
        &["gate", "-h"],
        &["study", "pairs", "--help"],
    ] {
        let narrow = shown(&folder.path(""), 50, arguments);
        let text = narrow.text();
        assert_eq!(narrow.code, 0, "{text}");
        assert_within(50, &text);
        let wide = folder.run(arguments).ok().stdout;
        assert_eq!(words(&text), words(&wide), "{arguments:?}");
    }
}

#[test]
fn messages_keep_their_words_whole() {
    let folder = Folder::with_pair();
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_degrees = 100\n[[scene]]\nname = \"a\"\n",
    );
    for arguments in [
        &["score", "a.png", "no-such-file.png"][..],
        &["score", "a.png", "b.png", "--metrics", "pnsr"],
        &["score", "a.png", "b.png", "--fov-vertical", "60", "--bands", "10,20,90,100"],
        &["score", "a.png", "b.png", "--gaze", "3,4"],
    ] {
        let narrow = shown(&folder.path(""), 50, arguments).text();
        assert_within(50, &narrow);
        let piped = folder.run(arguments);
        let stderr = words(&piped.stderr);
        let found = words(&narrow).windows(stderr.len()).any(|part| part == stderr);
        assert!(found, "{:?} is not in\n{narrow}", piped.stderr);
    }
    // The rest of a message is below its beginning.
    let narrow = shown(&folder.path(""), 50, &["score", "a.png", "b.png", "--gaze", "3,4"]).text();
    let lines: Vec<&str> = narrow.lines().collect();
    assert!(lines[0].starts_with("error: ") && narrow.contains("\n  help: "), "{narrow}");
    let after = lines.iter().position(|line| line.starts_with("  help: ")).unwrap() + 1;
    assert!(lines[after].starts_with("        ") && lines.len() > after, "{narrow}");
    let narrow = shown(&folder.path(""), 50, &["check", "e.toml"]).text();
    assert!(narrow.contains("fov_vertical_deg"), "{narrow}");
    assert_within(50, &narrow);
}

#[test]
fn a_table_that_is_too_wide_shows_all_its_cells() {
    let folder = Folder::with_pair();
    let arguments = ["score", "a.png", "b.png", "--fov-vertical", "60"];
    let piped = folder.run(&arguments).ok().stdout;
    assert!(piped.lines().any(|line| line.chars().count() > 50), "{piped}");
    let narrow = shown(&folder.path(""), 50, &arguments).text();
    assert_within(50, &narrow);
    for cell in words(&piped) {
        assert!(words(&narrow).contains(&cell), "{cell} is not in\n{narrow}");
    }
    let lists = shown(&folder.path(""), 50, &["list", "displays"]).text();
    assert!(lists.contains("vive-pro-eye\n  pixels: 1440x1600\n"), "{lists}");
    assert_within(50, &lists);
}

#[test]
fn a_wide_terminal_and_a_pipe_show_the_same() {
    let folder = Folder::with_pair();
    let arguments = ["score", "a.png", "b.png", "--fov-vertical", "60"];
    let piped = folder.run(&arguments);
    let wide = shown(&folder.path(""), 120, &arguments).text();
    assert!(wide.ends_with(&piped.stdout), "{wide}");
    // A variable that a shell has set does not change files.
    let mut set = command(&arguments);
    set.env("COLUMNS", "40").current_dir(folder.path(""));
    assert_eq!(String::from_utf8(set.output().unwrap().stdout).unwrap(), piped.stdout);
    // On a terminal, it counts.
    let mut set = command(&arguments);
    set.env("COLUMNS", "40").current_dir(folder.path(""));
    assert_within(40, &of(set, 120).text());
}

/// The place where the bar first counts figures that are done. Figures are drawn on several threads,
/// so that the first two may be counted at once.
fn first_counted(raw: &str) -> Option<usize> {
    let step = "drawing figures ";
    raw.match_indices(step).map(|(at, _)| at).find(|at| {
        let count = raw[at + step.len()..].split_once('/').map(|(count, _)| count);
        count.and_then(|count| count.parse::<usize>().ok()).is_some_and(|count| count > 0)
    })
}

#[test]
fn the_bar_goes_on_while_figures_are_drawn() {
    let folder = two_scenes();
    folder.write(
        "e.toml",
        experiment("[metrics]\npsnr = {}\n[[gate]]\nmetric = \"psnr\"\nat_least = 1\n"),
    );
    let run = shown(&folder.path(""), 80, &["run", "e.toml"]);
    assert_eq!(run.code, 0, "{}", run.raw);
    // What takes less time than the bar waits between two drawings may not be seen.
    let stages = [
        " frames, ",
        "writing the results",
        "reading the results",
        "writing tables",
        "drawing figures ",
        "writing the page",
    ];
    let seen: Vec<(&str, usize)> =
        stages.into_iter().filter_map(|stage| Some((stage, run.raw.find(stage)?))).collect();
    assert!(seen.is_sorted_by_key(|(_, at)| *at), "{seen:?} in {}", run.raw);
    let is_seen = |stage: &str| seen.iter().any(|(seen, _)| *seen == stage);
    assert!(is_seen(" frames, ") && is_seen("drawing figures "), "{}", run.raw);
    assert!(first_counted(&run.raw).is_some(), "{}", run.raw);
    // Nothing of it stays: the last of it is erased before the results.
    let last = stages.iter().filter_map(|stage| run.raw.rfind(stage)).max().unwrap();
    let rest = run.raw[last..].find("\u{1b}[2K").unwrap();
    assert!(run.raw[last + rest..].contains("PSNR (dB)"), "{}", run.raw);
    for arguments in [&["report", "reports/e"][..], &["gate", "reports/e"]] {
        let again = shown(&folder.path(""), 80, arguments).raw;
        assert!(first_counted(&again).is_some(), "{arguments:?}: {again}");
    }
    let piped = folder.run(&["run", "e.toml"]).ok();
    assert!(
        !piped.stderr.contains("drawing") && !piped.stderr.contains("writing"),
        "{}",
        piped.stderr
    );
}
