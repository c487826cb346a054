//! What a gate tells CI systems: JUnit XML, Markdown, annotations, JSON; with names that are hostile.

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;

use crate::fovqa::Folder;
use crate::gate::experiments::{NOISE, write_frames};

const HOSTILE: &str =
    "a'b\\\"c <i>&amp; |x| *y* _z_ 100%, ::error:: \u{1f600} \u{202e}desrever\u{202c} ]]>";
/// The same, as it is.
const NAME: &str =
    "a'b\"c <i>&amp; |x| *y* _z_ 100%, ::error:: \u{1f600} \u{202e}desrever\u{202c} ]]>";

/// A scene and a method of a hostile name; one rule holds, one fails, and with `missing` one method of
/// another scene cannot be scored.
fn folder(missing: bool) -> Folder {
    let folder = Folder::new();
    write_frames(&folder, ["gt", "test"], 1, &NOISE);
    let more = if missing { "[[method]]\nname = \"gone\"\ntest = \"gone\"\n" } else { "" };
    folder.write(
        "e.toml",
        format!(
            "name = \"e {HOSTILE}\"\n[[scene]]\nname = \"s {HOSTILE}\"\nreference = \"gt\"\n\
             [[method]]\nname = \"m {HOSTILE}\"\ntest = \"test\"\n{more}[metrics]\npsnr = {{}}\nmse = {{}}\n\
             [[gate]]\nmetric = \"psnr\"\nmethod = \"m {HOSTILE}\"\nat_least = 1\n\
             [[gate]]\nname = \"n {HOSTILE}\"\nmetric = \"psnr\"\naggregate = \"min\"\nat_least = 90\n\
             [[gate]]\nname = \"twice\"\nmetric = \"mse\"\nat_most = 0.0\n\
             [[gate]]\nname = \"twice\"\nmetric = \"mse\"\nat_most = 0.0\n"
        ),
    );
    folder
}

/// An element of XML: its name, its attributes, its text, and what is within.
#[derive(Debug, Default)]
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    text: String,
    children: Vec<Element>,
}

impl Element {
    #[track_caller]
    fn attribute(&self, name: &str) -> &str {
        let found = self.attributes.iter().find(|(key, _)| key == name);
        &found.unwrap_or_else(|| panic!("{name} in {self:?}")).1
    }

    fn all(&self, name: &str) -> Vec<&Element> {
        let mut found: Vec<&Element> = self.children.iter().filter(|c| c.name == name).collect();
        found.extend(self.children.iter().flat_map(|child| child.all(name)));
        found
    }
}

/// What XML escapes, as it is; refuses what XML refuses.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('&') {
        let (before, after) = rest.split_at(at);
        plain.push_str(before);
        let (entity, after) = after[1..].split_once(';').unwrap();
        plain.push(match entity {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            "apos" => '\'',
            number => {
                let digits = number.strip_prefix('#').unwrap();
                let code = digits.strip_prefix('x').map_or_else(
                    || digits.parse().unwrap(),
                    |hex| u32::from_str_radix(hex, 16).unwrap(),
                );
                char::from_u32(code).unwrap()
            }
        });
        rest = after;
    }
    plain.push_str(rest);
    let allowed = |c: char| {
        matches!(c, '\t' | '\n' | '\r') || (c >= ' ' && !matches!(c, '\u{fffe}' | '\u{ffff}'))
    };
    assert!(plain.chars().all(allowed), "{}", plain.escape_debug());
    plain
}

/// Reads XML of elements, attributes and text: as much of it as JUnit has.
#[track_caller]
fn parse(xml: &str) -> Element {
    let mut stack = vec![Element::default()];
    let mut rest = xml.split_once("?>").map_or(xml, |(_, rest)| rest);
    while let Some(at) = rest.find('<') {
        let (text, tag) = rest.split_at(at);
        assert!(!text.contains("]]>"));
        stack.last_mut().unwrap().text.push_str(&plain(text));
        let mut end = 1;
        let mut quote = None;
        for (index, c) in tag.char_indices().skip(1) {
            match (quote, c) {
                (None, '"' | '\'') => quote = Some(c),
                (Some(open), c) if open == c => quote = None,
                (_, '<') => panic!("< within a tag: {tag}"),
                (None, '>') => {
                    end = index;
                    break;
                }
                _ => {}
            }
        }
        let inside = &tag[1..end];
        rest = &tag[end + 1..];
        if let Some(name) = inside.strip_prefix('/') {
            let element = stack.pop().unwrap();
            assert_eq!(element.name, name.trim());
            stack.last_mut().unwrap().children.push(element);
            continue;
        }
        let closed = inside.ends_with('/');
        let inside = inside.trim_end_matches('/').trim();
        let (name, mut attributes) = inside.split_once(char::is_whitespace).unwrap_or((inside, ""));
        let mut element = Element { name: name.to_owned(), ..Element::default() };
        while let Some((key, value)) = attributes.split_once("=\"") {
            let (value, after) = value.split_once('"').unwrap();
            element.attributes.push((key.trim().to_owned(), plain(value)));
            attributes = after;
        }
        if closed {
            stack.last_mut().unwrap().children.push(element);
        } else {
            stack.push(element);
        }
    }
    assert_eq!((stack.len(), rest.trim()), (1, ""), "{xml}");
    stack.pop().unwrap()
}

#[test]
fn junit_has_a_test_case_a_check() {
    let folder = folder(false);
    let run = folder.run(&["gate", "e.toml", "--junit", "gate.xml"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    let xml = fs::read_to_string(folder.path("gate.xml")).unwrap();
    let root = parse(&xml);
    let suite = root.all("testsuite")[0];
    assert_eq!(suite.attribute("name"), format!("e {NAME}"));
    let counts = ["tests", "failures", "errors"].map(|count| suite.attribute(count).to_owned());
    assert_eq!(counts, ["4", "3", "0"]);
    let cases = suite.all("testcase");
    let place = format!("s {NAME}, m {NAME}");
    assert_eq!(cases[0].attribute("name"), format!("psnr mean of m {NAME}: {place}"));
    assert_eq!(cases[1].attribute("name"), format!("n {NAME}: {place}"));
    assert_eq!(cases.len(), 4);
    assert!(cases[0].all("failure").is_empty() && cases[0].all("error").is_empty());
    let message = cases[1].all("failure")[0].attribute("message");
    for words in [&format!("s {NAME}, m {NAME}: psnr min is "), ", below 90", "; frame 1: psnr "] {
        assert!(message.contains(words), "{words}: {message}");
    }
}

#[test]
fn what_was_not_scored_is_an_error_in_junit() {
    let folder = folder(true);
    let run = folder.run(&["gate", "e.toml", "--junit", "gate.xml", "--markdown", "gate.md"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let root = parse(&fs::read_to_string(folder.path("gate.xml")).unwrap());
    let suite = root.all("testsuite")[0];
    // The checks of the method that is gone, and the line for the whole.
    let errors = suite.all("error");
    assert_eq!((errors.len(), suite.attribute("errors")), (4, "4"));
    assert_eq!((suite.all("failure").len(), suite.attribute("failures")), (3, "3"));
    assert_eq!(suite.attribute("tests"), "8");
    assert!(errors.iter().any(|error| error.attribute("message").contains("gone")));
    assert!(suite.all("testcase")[0].all("error").is_empty(), "a rule that holds");
    let text = fs::read_to_string(folder.path("gate.md")).unwrap();
    assert!(text.contains("no verdict: not everything could be scored"), "{text}");
    assert!(text.contains("- not scored: "), "{text}");
}

/// Markdown as it is shown.
fn unescaped(text: &str) -> String {
    let mut plain = String::new();
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match chars.peek() {
            Some(next) if c == '\\' && next.is_ascii_punctuation() => {}
            _ => plain.push(c),
        }
    }
    plain
}

#[test]
fn markdown_keeps_its_table() {
    let folder = folder(false);
    folder.run(&["gate", "e.toml", "--markdown", "gate.md"]);
    let text = fs::read_to_string(folder.path("gate.md")).unwrap();
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with('|')).collect();
    assert_eq!(rows.len(), 2 + 4, "{text}");
    for row in &rows {
        let bars = row.replace("\\\\", "").replace("\\|", "").matches('|').count();
        assert_eq!(bars, 8, "{row}");
    }
    assert!(rows[2].starts_with("| ✅ | psnr mean of m "), "{}", rows[2]);
    assert!(
        unescaped(rows[3]).contains(&format!("| n {NAME} | s {NAME}, m {NAME} |")),
        "{}",
        rows[3]
    );
    // No HTML, no entity, no emphasis comes of a name. Where a link leads is no text.
    let mut parts = text.split("](");
    let first = parts.next().unwrap().to_owned();
    let behind = parts.map(|part| part.split_once(')').unwrap().1);
    let text = behind.fold(first, |text, part| text + part);
    for raw in ["<i", "&amp", "*y", "_z"] {
        let raw_at = text.match_indices(raw).all(|(at, _)| text[..at].ends_with('\\'));
        assert!(raw_at, "{raw}: {text}");
    }
    assert!(text.starts_with("### ❌ "), "{text}");
    assert!(unescaped(&text).contains("the gate fails: 3 of 4 rules"), "{text}");
}

#[test]
fn annotations_of_github_stay_on_their_line() {
    let folder = folder(false);
    let run = folder.run(&["gate", "e.toml", "--annotations", "github"]);
    assert_eq!(run.code, 1);
    let lines: Vec<&str> = run.stdout.lines().filter(|line| line.starts_with("::error ")).collect();
    assert_eq!(lines.len(), 3, "{}", run.stdout);
    let (properties, message) = lines[0]["::error ".len()..].split_once("::").unwrap();
    let properties: Vec<(&str, &str)> =
        properties.split(',').map(|property| property.split_once('=').unwrap()).collect();
    let keys: Vec<&str> = properties.iter().map(|(key, _)| *key).collect();
    assert_eq!(keys, ["file", "line", "title"]);
    assert_eq!((properties[0].1, properties[1].1), ("e.toml", "15"));
    let plain = |text: &str| {
        text.replace("%3A", ":").replace("%2C", ",").replace("%0A", "\n").replace("%25", "%")
    };
    assert_eq!(plain(properties[2].1), format!("fovqa gate: n {NAME}"));
    assert!(plain(message).starts_with(&format!("s {NAME}, m {NAME}: psnr min is ")), "{message}");
    assert!(!message.contains("100%,") && message.contains("100%25,"), "{message}");
}

#[test]
fn annotations_of_gitlab_are_a_code_quality_report() {
    for missing in [false, true] {
        let folder = folder(missing);
        let run = folder.run(&["gate", "e.toml", "--annotations", "gitlab"]);
        assert_eq!(run.code, if missing { 3 } else { 1 }, "{}", run.stderr);
        assert!(run.stderr.contains("psnr min is "), "the verdict is on stderr: {}", run.stderr);
        let issues = run.json();
        let issues = issues.as_array().unwrap();
        assert!(issues.len() >= 3, "{issues:#?}");
        let mut fingerprints = BTreeSet::new();
        for issue in issues {
            for key in ["description", "check_name", "fingerprint"] {
                assert!(!issue[key].as_str().unwrap().is_empty(), "{key}: {issue:#}");
            }
            let severity = issue["severity"].as_str().unwrap();
            assert!(["info", "minor", "major", "critical", "blocker"].contains(&severity));
            assert_eq!(issue["location"]["path"], "e.toml");
            assert!(issue["location"]["lines"]["begin"].as_u64().unwrap() >= 1);
            assert!(fingerprints.insert(issue["fingerprint"].as_str().unwrap()), "{issue:#}");
        }
        let of = |line: u64| issues.iter().find(|i| i["location"]["lines"]["begin"] == line);
        let failed = of(if missing { 18 } else { 15 }).unwrap();
        assert_eq!(failed["check_name"], format!("fovqa gate: n {NAME}"));
        assert_eq!(failed["severity"], if missing { "critical" } else { "major" });
    }
}

#[test]
fn json_has_the_documented_keys() {
    let folder = folder(false);
    let run = folder.run(&["gate", "e.toml", "--format", "json"]);
    let json: Value = run.json();
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let sorted = |mut keys: Vec<String>| {
        keys.sort();
        keys
    };
    assert_eq!(
        sorted(keys(&json)),
        ["errors", "experiment", "notes", "rules", "schema", "state", "version"]
    );
    assert_eq!((&json["schema"], &json["state"]), (&"fovqa.gate/1".into(), &"failed".into()));
    assert_eq!(json["experiment"], format!("e {NAME}"));
    assert_eq!(
        sorted(keys(&json["rules"][1])),
        ["checks", "limits", "line", "quantity", "state", "title"]
    );
    assert_eq!(
        sorted(keys(&json["rules"][1]["checks"][0])),
        [
            "baseline",
            "eye",
            "limit",
            "losses",
            "margin",
            "method",
            "reason",
            "scene",
            "state",
            "value",
            "worst_frame",
            "worst_value"
        ]
    );
    assert_eq!(
        (&json["rules"][1]["line"], &json["rules"][1]["limits"]),
        (&15.into(), &"at least 90".into())
    );
}
