//! Unusual tables: one participant, equal values, huge numbers, names that look like formulas.

use serde_json::Value;

use crate::fovqa::Folder;

fn json(csv: &str, arguments: &[&str]) -> Value {
    let folder = Folder::new();
    folder.write("t.csv", csv);
    let all = [&["study", arguments[0], "t.csv"], &arguments[1..], &["--format", "json"]].concat();
    folder.run(&all).ok().json()
}

#[test]
fn byte_order_marks_line_ends_and_formulas_are_plain_text() {
    let csv =
        "\u{feff}participant,method,value\r\n=cmd(),+A,1\r\n=cmd(),-B,2\r\nP2,+A,2\r\nP2,-B,4\r\n";
    let anova = json(csv, &["anova", "--within", "method"]);
    assert_eq!(anova["groups"][0]["cells"][0]["method"], "+A");
    assert_eq!(anova["groups"][0]["participants"], 2);
}

#[test]
fn huge_equal_and_single_values_have_reasons() {
    let huge = "participant,method,value\nP,A,1e50\nP,B,-1e50\nQ,A,1e49\nQ,B,3\nR,A,0\nR,B,1e50\n";
    let equal = "participant,method,value\nP,A,3\nP,B,3\nQ,A,3\nQ,B,3\n";
    let single = "participant,method,value\nP,A,3\n";
    for csv in [huge, equal, single] {
        for arguments in [&["anova", "--within", "method"][..], &["ranks"]] {
            assert_null_values_have_reasons(&json(csv, arguments), "");
        }
        for test in ["kruskal", "dunn", "signed-rank"] {
            assert_null_values_have_reasons(&json(csv, &["ranks", "--pairwise", test]), "");
        }
    }
    let votes =
        "participant,method_a,method_b,answer,n\nP,A,B,a,1000000000\nP,B,C,tie,3\nP,A,C,b,0\n";
    for ties in ["drop", "half"] {
        let pairs = json(votes, &["pairs", "--ties", ties]);
        assert_null_values_have_reasons(&pairs, "");
    }
}

/// An object with an undefined value says why.
pub(super) fn assert_null_values_have_reasons(value: &Value, place: &str) {
    match value {
        Value::Object(object) => {
            let has_null = object.values().any(Value::is_null);
            assert!(!has_null || object.contains_key("reason"), "{place}: {value}");
            for (key, value) in object {
                assert_null_values_have_reasons(value, &format!("{place}/{key}"));
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                assert_null_values_have_reasons(value, &format!("{place}/{index}"));
            }
        }
        _ => {}
    }
}

#[test]
fn a_group_is_the_same_as_its_rows_alone() {
    let csv =
        "participant,scene,method,value\nP,s,B,1\nP,t,A,2\nP,t,B,1\nQ,s,A,3\nQ,t,A,5\nQ,t,B,4\n";
    let by = json(csv, &["ranks", "--by", "scene"]);
    let alone = json(csv, &["ranks", "--where", "scene=t"]);
    assert_eq!(by["groups"][1]["by"]["scene"], "t");
    assert_eq!(by["groups"][1]["methods"], alone["groups"][0]["methods"]);
    assert_eq!(by["groups"][1]["pairwise"], alone["groups"][0]["pairwise"]);
}
