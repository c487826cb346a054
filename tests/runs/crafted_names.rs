//! A folder of results that somebody has made by hand, with names that steer terminals, begin lines and are
//! commands: `tests/cases/crafted-folder`.

use std::fs;
use std::path::Path;

use crate::fovqa::{Folder, root};
use crate::runs::experiment_folder::{json, two_scenes};

fn crafted() -> Folder {
    let folder = Folder::new();
    for entry in fs::read_dir(root().join("tests/cases/crafted-folder")).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.path("r/x").with_file_name(entry.file_name())).unwrap();
    }
    folder
}

/// The name of the scene: a newline, a command of terminals, a command of LaTeX.
const NAME: &str = "a\n\u{1b}[2J\\input{/etc/passwd}";

#[track_caller]
fn harmless(what: &str, text: &str) {
    let steers = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    assert!(!text.contains(steers), "{what}: {text:?}");
    let mut lines = text.lines();
    assert!(!lines.any(|line| line.trim_start().starts_with("\\input")), "{what}: {text}");
}

/// Text files that a drawing has left.
fn texts(folder: &Path, of: &mut dyn FnMut(&Path, &str)) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            texts(&path, of);
        } else if path
            .extension()
            .is_some_and(|ending| ["tex", "md", "html", "svg"].iter().any(|e| ending == *e))
        {
            of(&path, &fs::read_to_string(&path).unwrap());
        }
    }
}

#[test]
fn reports_show_names_and_do_not_obey_them() {
    let folder = crafted();
    let run = folder.run(&["report", "r"]).ok();
    harmless("stdout", &run.stdout);
    harmless("stderr", &run.stderr);
    let mut files = 0;
    texts(&folder.path("r"), &mut |path, text| {
        harmless(&path.display().to_string(), text);
        files += 1;
    });
    assert!(files > 8, "{files}");
    // CSV holds names as they are, in quotes.
    let table = fs::read_to_string(folder.path("r/table.csv")).unwrap();
    assert!(table.contains(&format!("\"{NAME}\"")), "{table}");
}

#[test]
fn verdicts_show_names_and_do_not_obey_them() {
    let folder = crafted();
    let gate = ["gate", "r", "--baseline", "r/baseline.json"];
    for more in [
        &["--annotations", "github"][..],
        &["--annotations", "gitlab"],
        &["--format", "json"],
        &["--markdown", "m.md", "--junit", "j.xml"],
    ] {
        let run = folder.run(&[&gate[..], more].concat());
        assert_eq!(run.code, 1, "{}", run.stderr);
        harmless("stdout", &run.stdout);
        harmless("stderr", &run.stderr);
        if more.contains(&"github") {
            let commands = run.stdout.lines().filter(|line| line.trim_start().starts_with("::"));
            assert!(commands.clone().count() > 0);
            assert!(commands.into_iter().all(|line| line.starts_with("::error file=e.toml,line=")));
        }
    }
    for file in ["m.md", "j.xml"] {
        harmless(file, &fs::read_to_string(folder.path(file)).unwrap());
    }
}

#[test]
fn names_of_experiments_are_no_commands() {
    let folder = Folder::with_pair();
    let text = |scene: &str, method: &str, rule: &str| {
        format!(
            "name = \"e\"\n[[scene]]\nname = \"{scene}\"\nreference = \"a.png\"\n[[method]]\nname = \"{method}\"\n\
             test = \"b.png\"\n[metrics]\nmse = {{}}\n[[gate]]\nname = \"{rule}\"\nmetric = \"mse\"\nat_most = 1\n"
        )
    };
    folder.write("e.toml", text("s::s", "m", "r"));
    folder.run(&["check", "e.toml"]).ok();
    for names in [["::s", "m", "r"], ["s", "::error::m", "r"], ["s", "m", "::r"]] {
        let [scene, method, rule] = names;
        folder.write("e.toml", text(scene, method, rule));
        folder.run(&["check", "e.toml"]).fails(2, &["cannot begin with ::, which is a command"]);
    }
}

/// The page links to the tables that run.json records.
#[test]
fn names_of_recorded_files_do_not_reach_the_page() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let mut record = json(&folder, "out/run.json");
    record["files"]["results.\"><script>alert(1)</script>"] = "0".into();
    folder.write("out/run.json", record.to_string());
    folder.run(&["report", "out"]).ok();
    let page = fs::read_to_string(folder.path("out/report.html")).unwrap();
    assert!(page.contains("href=\"results.csv\"") && !page.contains("<script>alert"), "{page}");
}
