//! The page of a run: `report.html`.

use std::fs;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{experiment, json, two_scenes};

fn page(folder: &Folder) -> String {
    fs::read_to_string(folder.path("reports/e/report.html")).unwrap()
}

/// The texts between a beginning and an end.
fn between<'a>(text: &'a str, begin: &str, end: &str) -> Vec<&'a str> {
    text.split(begin).skip(1).filter_map(|rest| rest.split(end).next()).collect()
}

/// Names that would end what they are in, load a picture, or run a script.
const SCENE: &str = "r\"><img src=x onerror=alert(1)>";
const METHOD: &str = "A'\"&<b>😀";

#[test]
fn names_are_text_and_nothing_is_loaded() {
    let folder = two_scenes();
    let text = experiment("[metrics]\npsnr = {}\nssim = {}\nrms_contrast = {}\n")
        .replace("name = \"room\"", &format!("name = '''{SCENE}'''\nfolder = \"room\""))
        .replace("name = \"hall\"", "name = \"hall\"\nfolder = \"hall\"")
        .replace("{scene}", "{folder}")
        .replace("name = \"A\"", &format!("name = '''{METHOD}'''"))
        .replace("name = \"e\"", "name = \"e\"\nabout = \"</script><script>alert(2)</script>\"");
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml"]).ok();
    let page = page(&folder);
    for shown in [
        "r&#34;&#62;&#60;img src=x onerror=alert(1)&#62;",
        "A&#39;&#34;&#38;&#60;b&#62;😀",
        "&#60;/script&#62;&#60;script&#62;alert(2)&#60;/script&#62;",
    ] {
        assert!(page.contains(shown), "{shown}");
    }
    for never in [
        SCENE,
        METHOD,
        "<img src=x",
        "<script>alert",
        "http:",
        "https:",
        "<link",
        "@import",
        "url(",
    ] {
        assert!(!page.contains(never), "{never}");
    }
    let sources = between(&page, " src=\"", "\"");
    assert!(sources.len() > 3, "{}", sources.len());
    assert!(sources.iter().all(|source| source.starts_with("data:image/svg+xml;base64,")));
    // The policy would refuse attributes that are styles or scripts.
    let body = page.split("<body>").nth(1).unwrap().split("<script>").next().unwrap();
    for attribute in [" style=", " onclick=", " onload="] {
        assert!(!body.contains(attribute), "{attribute}");
    }
    for link in between(&page, " href=\"", "\"") {
        assert!(!link.starts_with('/') && !link.contains("//") && !link.contains(':'), "{link}");
    }
    for image in between(&page, "<img", ">") {
        assert!(image.contains(" width=\"") && image.contains(" alt=\""));
        assert!(!image.contains(" alt=\"\""));
    }
}

#[test]
fn the_policy_has_the_hashes_of_the_style_and_the_script() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml"]).ok();
    let page = page(&folder);
    let policy = between(&page, "http-equiv=\"Content-Security-Policy\" content=\"", "\"")[0];
    assert!(policy.starts_with("default-src 'none'; img-src data:; "), "{policy}");
    for (tag, source) in [("style", "style-src"), ("script", "script-src")] {
        let texts = between(&page, &format!("<{tag}>"), &format!("</{tag}>"));
        assert_eq!(texts.len(), 2, "those of all pages and those of the viewer");
        let hash = |text: &&str| format!(" 'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
        let hashes = texts.iter().map(hash).collect::<Vec<_>>().concat();
        assert!(policy.contains(&format!("{source}{hashes}; ")), "{tag}: {policy}");
    }
}

#[test]
fn every_number_has_its_full_value_and_every_heading_sorts() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml"]).ok();
    let page = page(&folder);
    let table = between(&page, "<table>", "</table>")[0];
    let cells = between(table, "<td", "</td>");
    assert_eq!(cells.len(), 3 * 2 * 4, "two scenes and their average");
    for cell in &cells {
        let value = between(cell, " data-value=\"", "\"")[0];
        assert_eq!(between(cell, " title=\"", "\""), [value], "{cell}");
        assert!(value.parse::<f64>().unwrap().is_finite());
    }
    let summary = json(&folder, "reports/e/summary.json");
    let psnr = summary["comparisons"][0]["metrics"]["psnr"]["mean"].as_f64().unwrap();
    assert!(cells[1].contains(&format!("data-value=\"{psnr:?}\"")), "{}", cells[1]);
    // A section is a part of the table, in which its rows stay.
    let sections = between(table, "<tbody>", "</tbody>");
    let rows = sections.iter().map(|section| section.matches("<th scope=\"row\">").count());
    assert_eq!(rows.collect::<Vec<_>>(), [2, 2, 2]);
    let headings = between(table, "data-column=\"", "</th>");
    assert_eq!(headings.len(), 5);
    for (index, heading) in headings.iter().enumerate() {
        let begin = format!("{index}\" aria-sort=\"none\"><button type=\"button\"");
        assert!(heading.starts_with(&begin), "{heading}");
    }
    let about = "Peak signal-to-noise ratio, -10 log10 MSE. Unit: dB. Higher is better.";
    assert!(headings[2].contains(&format!("title=\"{about}")), "{}", headings[2]);
    assert!(page.contains(&format!("<dt>PSNR (dB) ↑</dt><dd>{about}")));
}

#[test]
fn the_index_forwards_and_both_are_listed() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml"]).ok();
    let index = fs::read_to_string(folder.path("reports/e/index.html")).unwrap();
    assert!(index.contains("content=\"0; url=report.html\""), "{index}");
    assert!(index.contains("href=\"report.html\""), "{index}");
    let listed = json(&folder, "reports/e/report.json");
    for file in ["index.html", "report.html"] {
        assert!(listed["files"].as_array().unwrap().contains(&file.into()), "{file}");
    }
    folder.run(&["report", "reports"]).ok();
    let overview = fs::read_to_string(folder.path("reports/index.html")).unwrap();
    assert!(overview.contains("href=\"e/report.html\""), "{overview}");
    assert!(!overview.contains("e/index.html"), "{overview}");
    let policy = between(&overview, "Content-Security-Policy\" content=\"", "\"")[0];
    let style = between(&overview, "<style>", "</style>")[0];
    assert!(policy.contains(&STANDARD.encode(Sha256::digest(style))), "{policy}");
}

#[test]
fn conditions_are_said_once_unless_they_differ() {
    let folder = two_scenes();
    let mask: Vec<u8> = (0..48 * 40).map(|at| if at < 96 { 0 } else { 255 }).collect();
    folder.png("mask.png", 48, 40, &mask);
    let text = experiment("[metrics]\npsnr = {}\natd = {}\n").replace(
        "reference = \"room/gt\"\n",
        "reference = \"room/gt\"\nframes = \"0..1\"\ngaze = [10, 20]\nmask = \"mask.png\"\n",
    );
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml"]).ok();
    let page = page(&folder);
    let term = |name: &str| between(&page, &format!("<dt>{name}</dt><dd>"), "</dd>");
    assert_eq!(term("Resolution"), ["48 × 40 px"]);
    assert_eq!(term("Gaze"), ["fixed at (10, 20) px", "the centre of the view, at (24, 20) px"]);
    assert_eq!(term("Frames"), ["1 (of 0..1:1)", "3"]);
    assert_eq!(term("A"), ["read from files"]);
    for left_out in [
        "The mask mask.png leaves out pixels (room).",
        "room: 96 pixels of a frame are left out.",
        "ATD: needs two frames (room, A, room, B).",
    ] {
        assert!(page.contains(&format!("<li>{left_out}</li>")), "{left_out}");
    }
}

#[test]
fn inputs_are_listed_with_size_and_hash() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml"]).ok();
    let page = page(&folder);
    assert!(page.contains("<summary>18 input files</summary>"));
    let record = json(&folder, "reports/e/run.json");
    for input in record["inputs"].as_array().unwrap() {
        let path = input["path"].as_str().unwrap();
        let row = between(&page, &format!("<th scope=\"row\">{path}</th>"), "</tr>");
        assert!(row[0].contains(&format!("data-value=\"{}\"", input["bytes"])), "{row:?}");
        assert!(row[0].contains(input["sha256"].as_str().unwrap()), "{row:?}");
    }
    // The experiment is shown line by line.
    assert!(page.contains("reference = &#34;room/gt&#34;\n[[scene]]\n"));
}
