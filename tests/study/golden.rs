//! The golden values of studies, with the tolerance of each.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::fovqa::{Run, command, root, shared};

/// Cases whose results do not depend on the number of threads, but on the seed.
const RANDOM: [&str; 3] = ["pairs-vafr", "plan-staircase", "metrics"];

fn run(folder: &Path, arguments: &[&str]) -> Run {
    command(arguments).current_dir(folder).output().unwrap().into()
}

/// The value at a path: keys, indices, and objects that name the one entry of a list.
fn dig<'v>(mut value: &'v Value, path: &[Value]) -> Option<&'v Value> {
    for step in path {
        value = match step {
            Value::String(key) => value.as_object()?.get(key)?,
            Value::Number(index) => {
                value.as_array()?.get(usize::try_from(index.as_u64()?).ok()?)?
            }
            Value::Object(wanted) => {
                let is_it = |entry: &&Value| {
                    wanted.iter().all(|(key, wanted)| {
                        let mut found = Some(*entry);
                        // Only the first dot divides a key, because values may contain dots.
                        for part in key.splitn(2, '.') {
                            found = found.and_then(|found| found.get(part));
                        }
                        found.is_some_and(|found| is_same(found, wanted))
                    })
                };
                let found: Vec<&Value> = value.as_array()?.iter().filter(is_it).collect();
                <[&Value; 1]>::try_from(found).ok()?[0]
            }
            _ => return None,
        };
    }
    Some(value)
}

fn is_same(a: &Value, b: &Value) -> bool {
    match (a.as_f64(), b.as_f64()) {
        (Some(a), Some(b)) => (a - b).abs() <= 0.0,
        _ => a == b,
    }
}

/// What is wrong with a value, if anything.
fn fault(found: Option<&Value>, expected: &Value) -> Option<String> {
    let wanted = &expected["value"];
    let Some(found) = found else { return Some("missing".to_owned()) };
    let is_right = match wanted {
        Value::String(text) if text == "?text" => {
            found.as_str().is_some_and(|text| !text.trim().is_empty())
        }
        Value::Number(number) => {
            let (number, part) = (number.as_f64().unwrap(), |key: &str| expected[key].as_f64());
            let most = part("abs").unwrap_or(0.0) + part("rel").unwrap_or(0.0) * number.abs();
            found.as_f64().is_some_and(|found| (found - number).abs() <= most)
        }
        _ => found == wanted,
    };
    (!is_right).then(|| format!("{found} for {wanted}"))
}

/// The faults of one case.
fn faults(folder: &Path, case: &Value) -> Vec<String> {
    let id = case["id"].as_str().unwrap();
    let arguments: Vec<&str> =
        case["args"].as_array().unwrap().iter().map(|word| word.as_str().unwrap()).collect();
    let run = run(folder, &[&arguments[..], &["--format", "json"]].concat());
    let code = i32::try_from(case["exit"].as_i64().unwrap()).unwrap();
    if run.code != code {
        return vec![format!("{id}: exit {} for {code}: {}", run.code, run.stderr)];
    }
    if code != 0 {
        run.fails(code, &["error:"]);
        return Vec::new();
    }
    let json = run.json();
    let mut faults = Vec::new();
    if json["schema"] != "fovqa.study/1" {
        faults.push(format!("{id}: schema {}", json["schema"]));
    }
    for expected in case["expect"].as_array().unwrap() {
        let path = expected["path"].as_array().unwrap();
        if let Some(fault) = fault(dig(&json, path), expected) {
            faults.push(format!("{id}: {}: {fault}", expected["path"]));
        }
    }
    faults
}

/// Compares all cases of a folder; returns their number.
fn check(folder: &Path) -> usize {
    let text = fs::read_to_string(folder.join("golden.json")).unwrap();
    let golden: Value = serde_json::from_str(&text).unwrap();
    let cases = golden["cases"].as_array().unwrap();
    let faults: Vec<String> = cases.iter().flat_map(|case| faults(folder, case)).collect();
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults[..faults.len().min(25)].join("\n")
    );
    for case in cases.iter().filter(|case| RANDOM.iter().any(|id| case["id"] == *id)) {
        check_threads(folder, case);
    }
    cases.len()
}

/// One thread and two give the same bytes; another seed gives other values.
fn check_threads(folder: &Path, case: &Value) {
    let arguments: Vec<&str> =
        case["args"].as_array().unwrap().iter().map(|word| word.as_str().unwrap()).collect();
    let with = |more: &[&str]| run(folder, &[&arguments[..], more].concat()).ok().stdout;
    let [one, two] = ["1", "2"].map(|n| with(&["--format", "json", "--threads", n]));
    assert!(one == two, "{}: one thread and two give different bytes", case["id"]);
    let mut other = arguments.clone();
    let seed = other.iter().position(|word| *word == "--seed").unwrap() + 1;
    other[seed] = "987654321";
    let other = run(folder, &[&other[..], &["--format", "json"]].concat()).ok().stdout;
    assert!(one != other, "{}: another seed gives the same result", case["id"]);
}

#[test]
fn small_studies_have_their_golden_values() {
    assert!(check(&root().join("tests/golden/study")) > 20);
}

#[test]
fn studies_have_their_golden_values() {
    if let Some(folder) = shared("golden/study") {
        check(&folder);
    }
}

#[test]
fn a_wrong_value_is_a_fault() {
    let expected = serde_json::json!({"value": 2.0, "abs": 0.1});
    let fault = |found: Value| fault(Some(&found), &expected);
    assert_eq!(fault(serde_json::json!(2.05)), None);
    assert!(fault(serde_json::json!(2.2)).is_some() && fault(Value::Null).is_some());
    let list = serde_json::json!([{"by": {"set": "F(1,12)=0.2"}, "p": 1}]);
    let path = |name: &str| [serde_json::json!({"by.set": name}), serde_json::json!("p")];
    assert_eq!(dig(&list, &path("F(1,12)=0.2")), Some(&serde_json::json!(1)));
    assert_eq!(dig(&list, &path("F(1,12)=0.3")), None);
}
