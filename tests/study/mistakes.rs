//! Mistakes in tables and options of studies: what the message says.

use crate::fovqa::Folder;

const VOTES: &str = "participant,scene,method_a,method_b,answer\nP1,s,A,B,a\nP2,s,A,B,b\n";

fn with(csv: &str) -> Folder {
    let folder = Folder::new();
    folder.write("t.csv", csv);
    folder
}

#[test]
fn a_message_names_file_column_line_and_remedy() {
    let wrong = |csv: &str, arguments: &[&str], words: &[&str]| {
        let analysis = [&["study"], arguments].concat();
        with(csv).run(&analysis).fails(3, words);
    };
    let pairs = ["pairs", "t.csv"];
    wrong(
        "participant,answer\nP,a\n",
        &pairs,
        &["t.csv, line 1", "\"method_a\"", "--column method_a=NAME"],
    );
    let word = VOTES.replace("B,b", "B,left");
    wrong(
        &word,
        &pairs,
        &["t.csv, line 3, column \"answer\": \"left\"", "a, b, A, B or tie", "help:"],
    );
    let tie = VOTES.replace("B,b", "B,tie");
    wrong(&tie, &pairs, &["line 3", "--ties drop or --ties half"]);
    wrong(VOTES, &["pairs", "t.csv", "--where", "scene=x"], &["no rows with scene = x", "--where"]);
    wrong(VOTES, &["pairs", "t.csv", "--by", "room"], &["\"room\""]);
    wrong(VOTES, &["pairs", "t.csv", "--order", "A,C"], &["--order", "\"C\"", "A, B"]);
    wrong(VOTES, &["pairs", "t.csv", "--reference", "C"], &["--reference", "\"C\""]);
    wrong("", &pairs, &["no header line"]);
    wrong("a,b\n1\n", &pairs, &["line 2", "1 cells", "2"]);
    wrong(
        "participant,method,value\nP,A,x\n",
        &["ranks", "t.csv"],
        &["line 2, column \"value\": \"x\""],
    );
    let anova = ["anova", "t.csv", "--within", "method"];
    wrong("participant,method,value\nP,A,\n", &anova, &["no rows", "not empty"]);
    wrong("participant,method,value\nP,,1\n", &anova, &["line 2, column \"method\""]);
    with("participant,mean,value\nP,A,1\n")
        .run(&["study", "anova", "t.csv", "--within", "mean"])
        .fails(2, &["--column condition=mean"]);
    with("participant,mean,value\nP,A,1\n")
        .run(&["study", "anova", "t.csv", "--within", "participant"])
        .fails(2, &["participant, which is no factor"]);
    let levels = "level,correct\n1,1\n2,0\n";
    with(levels)
        .run(&["study", "psychometric", "t.csv", "--guess", "0.6", "--lapse", "0.5"])
        .fails(2, &["add up to 1 or more"]);
    let careless = "participant,level,value,validation\nP,1,2,0\nP,1,3,1\n";
    wrong(
        careless,
        &["ratings", "t.csv", "--validation-expected", "1", "--max-errors", "1"],
        &["every participant is left out", "--max-errors"],
    );
    Folder::new().run(&["study", "pairs", "none.csv"]).fails(3, &["none.csv", "help:"]);
    let validation = "participant,level,value,validation\nP,1,2,0\nP,1,3,yes\n";
    wrong(validation, &["ratings", "t.csv"], &["line 3, column \"validation\": \"yes\"", "0 or 1"]);
}

#[test]
fn unknown_options_end_with_code_2() {
    let folder = with(VOTES);
    for arguments in [
        &["study", "nonsense", "t.csv"][..],
        &["study", "pairs", "t.csv", "--nonsense"],
        &["study", "pairs", "t.csv", "--confidence", "1"],
        &["study", "pairs", "t.csv", "--where", "scene"],
        &["study", "pairs", "t.csv", "--ties", "maybe"],
        &["study", "anova", "t.csv"],
    ] {
        folder.run(arguments).fails(2, &["error:"]);
    }
}

#[test]
fn results_are_text_or_json_and_a_file() {
    let folder = with(VOTES);
    let text = folder.run(&["study", "pairs", "t.csv", "--output", "out"]).ok().stdout;
    assert!(text.contains("A – B") && text.contains("Bradley-Terry"), "{text}");
    let json = folder.run(&["study", "pairs", "t.csv", "--format", "json"]).ok().stdout;
    assert_eq!(std::fs::read_to_string(folder.path("out/study.json")).unwrap().trim(), json.trim());
    folder.write("file", "");
    folder.run(&["study", "pairs", "t.csv", "--output", "file/out"]).fails(3, &["--output"]);
}

#[test]
fn each_analysis_has_an_example_and_short_lines() {
    let folder = Folder::new();
    for analysis in
        ["pairs", "ranks", "anova", "psychometric", "staircase", "ratings", "metrics", "plan"]
    {
        let help = folder.run(&["study", analysis, "--help"]).ok().stdout;
        assert!(help.contains(&format!("  fovqa study {analysis}")), "{help}");
        assert!(help.lines().all(|line| line.chars().count() <= 100), "{help}");
    }
}
