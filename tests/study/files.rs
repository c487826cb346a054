//! Study files: what they write, their mistakes, and the examples of the repository.

use std::fs;

use serde_json::Value;

use crate::fovqa::{Folder, Run, command, root};

const VOTES: &str = "participant,scene,method_a,method_b,answer\n\
    P1,hall,A,B,a\nP1,hall,A,C,a\nP1,hall,B,C,b\nP2,hall,A,B,a\nP2,hall,A,C,b\nP2,hall,B,C,a\n\
    P3,hall,A,B,b\nP3,hall,A,C,a\nP3,hall,B,C,a\nP1,road,A,B,b\nP2,road,A,B,b\nP3,road,A,B,a\n";

const STUDY: &str = "name = \"mine\"\nabout = \"<b>Votes</b> & more\"\n\
    [[analysis]]\nkind = \"pairs\"\ntitle = \"Votes\"\nfile = \"votes.csv\"\nby = [\"scene\"]\n\
    bootstrap = 100\n";

fn with(study: &str) -> Folder {
    let folder = Folder::new();
    folder.write("in/votes.csv", VOTES);
    folder.write("in/study.toml", study);
    folder
}

fn read(folder: &Folder, name: &str) -> String {
    fs::read_to_string(folder.path(name)).unwrap()
}

fn json_of(folder: &Folder, name: &str) -> Value {
    serde_json::from_str(&read(folder, name)).unwrap()
}

#[test]
fn a_study_file_gives_what_its_analyses_give_by_options() {
    let folder = with(STUDY);
    let run = folder.run(&["study", "in/study.toml"]).ok();
    assert!(run.stdout.starts_with("Votes\n=====\n\n# scene = hall\n"), "{}", run.stdout);
    let found = json_of(&folder, "reports/mine/study.json");
    assert_eq!((&found["schema"], &found["name"]), (&"fovqa.studies/1".into(), &"mine".into()));
    let by_options = folder.run(&[
        "study",
        "pairs",
        "in/votes.csv",
        "--by",
        "scene",
        "--bootstrap",
        "100",
        "--format",
        "json",
    ]);
    assert_eq!(found["analyses"][0]["result"], by_options.ok().json());
    // The groups are in one table, with full precision in CSV.
    let table = read(&folder, "reports/mine/table-pairs-shares.csv");
    let mut rows = table.lines();
    assert!(rows.next().unwrap().starts_with("scene,pair,wins,losses,ties,share,"), "{table}");
    assert!(rows.next().unwrap().starts_with("hall,A – B,2,1,0,0.6666666666666666,"), "{table}");
    assert_eq!(rows.last().unwrap().split(',').next(), Some("road"));
    let page = read(&folder, "reports/mine/index.html");
    for part in [
        "&#60;b&#62;Votes&#60;/b&#62; &#38; more",
        "table-pairs-shares.tex",
        "plots/pairs-shares.svg",
    ] {
        assert!(page.contains(part), "{part}");
    }
    for file in ["pairs-shares.svg", "pairs-shares.pdf", "pairs-shares.csv", "pairs-scores.svg"] {
        assert!(folder.path(&format!("reports/mine/plots/{file}")).is_file(), "{file}");
    }
    // Again, with other threads: the same bytes.
    let bytes = |name: &str| fs::read(folder.path(&format!("reports/mine/{name}"))).unwrap();
    let files = ["study.json", "index.html", "plots/pairs-shares.pdf", "table-pairs-shares.tex"];
    let before = files.map(bytes);
    folder.run(&["study", "in/study.toml", "--threads", "1"]).ok();
    assert!(before == files.map(bytes));
    let printed = folder.run(&["study", "in/study.toml", "--format", "json"]).ok();
    assert_eq!(printed.stdout, read(&folder, "reports/mine/study.json"));
}

#[test]
fn lists_and_assignments_are_written_in_several_ways() {
    let by = |options: &str| {
        let text = format!(
            "name = \"m\"\n[[analysis]]\nkind = \"pairs\"\nfile = \"votes.csv\"\nbootstrap = 0\n{options}\n"
        );
        let folder = with(&text);
        folder.run(&["study", "in/study.toml", "--output", "out"]).ok();
        json_of(&folder, "out/study.json")["analyses"][0]["result"].clone()
    };
    let order = by("order = [\"C\", \"A\", \"B\"]\nwhere = { scene = \"hall\" }");
    assert_eq!(order["groups"][0]["pairs"][0]["method"], "C");
    assert_eq!(order, by("order = \"C,A,B\"\nwhere = [\"scene=hall\"]"));
    assert_eq!(by("column = { scene = \"scene\" }"), by(""));
}

#[test]
fn mistakes_are_pointed_at() {
    let wrong = |study: &str, words: &[&str]| {
        let folder = with(study);
        folder.run(&["study", "in/study.toml"]).fails(2, words);
        folder.run(&["check", "in/study.toml"]).fails(2, words);
        assert!(!folder.path("reports").join("mine").exists());
    };
    let analysis = |options: &str| format!("name = \"mine\"\n[[analysis]]\n{options}\n");
    let folder = with("name = \"mine\"\n");
    folder.run(&["study", "in/study.toml"]).fails(2, &["the study has no analysis"]);
    let folder = with("name = \"mine\"\n[[scene]]\nname = \"s\"\nreference = \"a.png\"\n");
    folder.run(&["study", "in/study.toml"]).fails(2, &["this is an experiment", "`fovqa run`"]);
    let folder = with(STUDY);
    folder.run(&["curves", "in/study.toml"]).fails(2, &["this is a study file", "`fovqa study`"]);
    folder
        .run(&["study", "pairs", "in/study.toml"])
        .fails(2, &["is no CSV table", "`fovqa study in/study.toml`"]);
    wrong(&analysis("kind = \"pair\""), &["kind cannot be \"pair\"", "did you mean \"pairs\"?"]);
    wrong(&analysis("kind = \"pairs\""), &["the analysis has no file", "answers.csv"]);
    let pairs = "kind = \"pairs\"\nfile = \"votes.csv\"\n";
    wrong(&analysis(&format!("{pairs}within = \"method\"")), &["within has no effect on pairs"]);
    wrong(&analysis(&format!("{pairs}refrence = \"A\"")), &["did you mean reference?"]);
    wrong(&analysis(&format!("{pairs}confidence = 95")), &["confidence cannot be 95"]);
    wrong(
        &analysis(&format!("{pairs}where = {{ scene = 5 }}")),
        &["where.scene cannot be a whole number"],
    );
    wrong(&analysis(&format!("{pairs}where = [\"scene\"]")), &["\"scene\" assigns nothing"]);
    wrong(
        &analysis(&format!("{pairs}[[analysis]]\n{pairs}")),
        &["two analyses named \"pairs\"", "add name"],
    );
    let printed = |at: &str| {
        format!("{pairs}[[analysis.printed]]\nquantity = \"p\"\nvalue = \".5\"\nat = \"{at}\"")
    };
    wrong(&analysis(&printed("groups")), &["at does not begin with /"]);
    wrong(
        &analysis(&printed("/groups/0/nothing")),
        &["\"p\"", "where there is nothing", "study.json"],
    );
    wrong(
        &analysis("kind = \"anova\"\nfile = \"votes.csv\""),
        &["anova lacks within", "add within = …", "one or two factors"],
    );
    wrong(&analysis("kind = \"metrics\"\nfile = \"votes.csv\""), &["metrics lacks scores"]);
    let ratings = "kind = \"ratings\"\nfile = \"votes.csv\"\n";
    wrong(&analysis(&format!("{ratings}smooth = \"binomial\"")), &["no effect without grid"]);
    wrong(&analysis(&format!("{ratings}grid = [\"x\"]")), &["two different columns"]);
    wrong(&analysis(&format!("{ratings}max_errors = 2")), &["needs validation_expected"]);
    wrong(&analysis("kind = \"plan\""), &["lacks plan"]);
    wrong(&analysis(&format!("{pairs}by = [\"scene\", \"scene\"]")), &["by names \"scene\" twice"]);
    let psychometric = "kind = \"psychometric\"\nfile = \"votes.csv\"\nlapse = 0.5\n";
    wrong(&analysis(&format!("{psychometric}lapse_max = 0.1")), &["no effect with lapse"]);
    wrong(
        &analysis(&format!("{psychometric}guess = 0.6")),
        &["guess 0.6 and lapse 0.5", "1 or more"],
    );
    wrong("name = \"mine\"\nanalysis = []\n", &["the study has no analysis", "[[analysis]]"]);
    wrong(&analysis("kind = \"plan\"\nplan = \"pairs\""), &["the plan has no share", "results"]);
    wrong(
        &analysis("kind = \"plan\"\nplan = \"staircase\"\nstart = 4"),
        &["lacks participants, trials"],
    );
    wrong(
        &analysis("kind = \"plan\"\nplan = \"pairs\"\nshare = 0.7\nfile = \"votes.csv\""),
        &["file has no effect on a plan of pairs"],
    );
}

#[test]
fn tables_that_do_not_fit_name_the_analysis_and_keys() {
    let folder = with(&STUDY.replace("votes.csv", "none.csv"));
    folder.run(&["study", "in/study.toml"]).fails(3, &["none.csv cannot be read"]);
    let folder = with(&STUDY.replace("by =", "order = [\"A\", \"X\"]\nby ="));
    let said = folder.run(&["study", "in/study.toml"]);
    let said = said.fails(3, &["study.toml: analysis \"pairs\"", "order names", "\"X\""]);
    assert!(!said.stderr.contains("--order"), "{}", said.stderr);
}

#[test]
fn results_of_others_stay() {
    let folder = with(STUDY);
    folder.write("out/study.json", "{ \"mine\": true }");
    folder.run(&["study", "in/study.toml", "--output", "out"]).fails(3, &["study.json"]);
    assert_eq!(read(&folder, "out/study.json"), "{ \"mine\": true }");
    folder.run(&["study", "in/study.toml"]).ok();
    let before = read(&folder, "reports/mine/study.json");
    // A later mistake leaves the results as they are.
    folder.write("in/votes.csv", VOTES.replace("A,B,a", "A,B,left"));
    folder.run(&["study", "in/study.toml"]).fails(3, &["line 2, column \"answer\""]);
    assert_eq!(read(&folder, "reports/mine/study.json"), before);
    folder.run(&["report", "reports/mine"]).fails(3, &["a study", "`fovqa study`"]);
    // The page about all folders shows it.
    folder.run(&["report", "reports"]).ok();
    assert!(read(&folder, "reports/index.html").contains("mine/index.html"));
    // Tables of an analysis that is no longer there are taken away.
    folder.write("in/votes.csv", VOTES);
    folder.write("in/study.toml", STUDY.replace("title", "name = \"votes\"\ntitle"));
    folder.run(&["study", "in/study.toml"]).ok();
    assert!(!folder.path("reports/mine/table-pairs-shares.csv").exists());
    assert!(folder.path("reports/mine/table-votes-shares.csv").exists());
}

#[test]
fn several_files_have_folders_of_their_own() {
    let folder = with(STUDY);
    folder.run(&["study", "in/study.toml", "in/study.toml"]).fails(2, &["the same name, \"mine\""]);
    folder.write("in/other.toml", STUDY.replace("mine", "other"));
    folder.run(&["study", "in/study.toml", "in/other.toml", "--output", "out"]).ok();
    assert!(folder.path("out/mine/study.json").is_file());
    assert!(folder.path("out/other/study.json").is_file());
    folder.run(&["run", "in/study.toml"]).fails(2, &["this is a study file", "`fovqa study`"]);
    let checked = folder.run(&["check", "in/study.toml"]).ok();
    assert!(checked.stdout.contains("pairs: pairs of in/votes.csv"), "{}", checked.stdout);
}

/// The examples are carried out, and their printed numbers have the verdicts of
/// docs/published-numbers.md.
#[test]
fn the_examples_are_carried_out() {
    let folder = Folder::new();
    let mut kinds: Vec<String> = Vec::new();
    let mut verdicts = Vec::new();
    for entry in fs::read_dir(root().join("configs/studies")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap().to_lowercase();
        let says = ["simulated", "published", "constructed", "no data"];
        assert!(says.iter().any(|word| text.contains(word)), "{}", path.display());
        let name = path.file_stem().unwrap().to_str().unwrap();
        folder.run(&["study", path.to_str().unwrap(), "--output", name]).ok();
        let found = json_of(&folder, &format!("{name}/study.json"));
        for analysis in found["analyses"].as_array().unwrap() {
            kinds.push(analysis["result"]["analysis"].as_str().unwrap().to_owned());
            for printed in analysis["printed"].as_array().into_iter().flatten() {
                let text = |key: &str| printed[key].as_str().unwrap().to_owned();
                verdicts.push((text("quantity"), text("printed"), text("verdict")));
            }
        }
        let plots = fs::read_dir(folder.path(&format!("{name}/plots"))).unwrap().count();
        assert!(plots > 3, "{name}: {plots}");
    }
    kinds.sort();
    kinds.dedup();
    let all =
        ["anova", "metrics", "pairs", "plan", "psychometric", "ranks", "ratings", "staircase"];
    assert_eq!(kinds, all);
    let verdict = |quantity: &str, printed: &str| {
        let found: Vec<&str> = verdicts
            .iter()
            .filter(|(of, value, _)| of == quantity && value == printed)
            .map(|(.., verdict)| verdict.as_str())
            .collect();
        assert_eq!(found.len(), 1, "{quantity}, {printed}: {verdicts:?}");
        found[0].to_owned()
    };
    for (quantity, printed, expected) in [
        ("p, RMFR against Hyperbolic, two-sided", "< .01", "reproduced"),
        ("p, RMFR against Linear, two-sided", "< .01", "not reproduced"),
        ("p, RMFR against Linear, one-sided", "< .01", "reproduced"),
        ("p, RMFR against Log-polar, two-sided", "< .001", "not reproduced"),
        ("p, RMFR against Log-polar, one-sided", "< .001", "reproduced"),
        ("p of F(1, 12) = 0.229", ".637", "not reproduced"),
        ("p of F(1, 12) = 0.21", ".651", "not reproduced"),
        ("p of F(2, 30) = 6.548", ".003", "not reproduced"),
        ("p of F(2, 30) = 3.817", ".023", "not reproduced"),
        ("F of F(1, 12) = 0.229", "0.229", "not independent"),
    ] {
        assert_eq!(verdict(quantity, printed), expected, "{quantity}");
    }
}

#[test]
fn the_committed_schema_is_the_one_printed_and_its_keys_are_documented() {
    let printed = Run::from(command(&["schema", "study"]).output().unwrap()).ok().stdout;
    let committed = fs::read_to_string(root().join("docs/study.schema.json")).unwrap();
    assert_eq!(committed, printed, "run: fovqa schema study > docs/study.schema.json");
    let schema: Value = serde_json::from_str(&printed).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let valid = |text: &str| validator.is_valid(&toml::from_str::<Value>(text).unwrap());
    assert!(valid(STUDY));
    assert!(!valid(&STUDY.replace("pairs", "pair")));
    assert!(!valid(&STUDY.replace("bootstrap", "bootstraps")));
    for entry in fs::read_dir(root().join("configs/studies")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            assert!(valid(&fs::read_to_string(&path).unwrap()), "{}", path.display());
        }
    }
    let docs = fs::read_to_string(root().join("docs/studies.md")).unwrap();
    let words: Vec<&str> = docs.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    let analysis = &schema["properties"]["analysis"]["items"]["properties"];
    let printed = &analysis["printed"]["items"]["properties"];
    let mut seen = 0;
    for keys in [&schema["properties"], analysis, printed] {
        for key in keys.as_object().unwrap().keys() {
            assert!(words.contains(&key.as_str()), "{key}");
            seen += 1;
        }
    }
    assert!(seen > 55, "{seen}");
}

#[test]
fn files_of_the_user_are_not_replaced() {
    let folder = with(STUDY);
    for file in ["table-pairs-shares.csv", "plots/pairs-scores.svg", "table-pairs-fit.tex"] {
        let output = file.replace(['/', '.'], "-");
        let mine = format!("{output}/{file}");
        folder.write(&mine, "mine");
        let run = folder.run(&["study", "in/study.toml", "--output", &output]);
        run.fails(3, &[file, "fovqa did not write this file"]);
        assert_eq!(read(&folder, &mine), "mine");
        assert!(!folder.path(&output).join("study.json").exists());
    }
    // Neither is the table of answers, nor what belongs to a page.
    folder.write("here/table-pairs-shares.csv", VOTES);
    folder.write("here/s.toml", STUDY.replace("votes.csv", "table-pairs-shares.csv"));
    folder.run(&["study", "here/s.toml", "--output", "here"]).fails(3, &["table-pairs-shares.csv"]);
    folder.run(&["study", "in/study.toml", "--output", "out"]).ok();
    let before = read(&folder, "out/study.json");
    let single = ["study", "pairs", "in/votes.csv", "--output"];
    folder.run(&[&single[..], &["out"]].concat()).fails(3, &["study.json", "--output"]);
    assert_eq!(read(&folder, "out/study.json"), before);
    folder.write("own/study.json", "{\"my\": 1}");
    folder.run(&[&single[..], &["own"]].concat()).fails(3, &["study.json"]);
    for _ in 0..2 {
        folder.run(&[&single[..], &["single"]].concat()).ok();
    }
}
