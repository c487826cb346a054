//! The page of a run of a sequence: frames are chosen from a list and from a curve.

use serde_json::{Value, json};

use super::chromium::Page;
use crate::fovqa::Folder;

fn opened() -> Option<(Folder, Page)> {
    let folder = Folder::new();
    folder.write(
        "s.toml",
        "name = \"s\"\n[view]\nfov_vertical_deg = 90\n[[scene]]\nname = \"walk\"\n\
         builtin = \"gallery\"\nresolution = \"90x80\"\nframes = 9\nsamples = 1\n\
         [[method]]\nname = \"RMFR\"\nemulate = { model = \"rmfr\", jitter = \"halton\" }\n\
         [[method]]\nname = \"CPS\"\nemulate = { model = \"cps\" }\n\
         [metrics]\npsnr = {}\nssim = {}\n[report]\nsize = 64\nframes = [\"worst\", \"first\"]\n",
    );
    folder.run(&["run", "s.toml", "--output", "out"]).ok();
    let mut page = Page::open(&folder.path("out/report.html"))?;
    page.until("document.documentElement.dataset.viewer === 'ready'");
    Some((folder, page))
}

#[test]
fn frames_are_listed_by_their_loss_and_chosen() {
    let Some((folder, mut page)) = opened() else { return };
    let listed = "[...document.querySelectorAll('#viewer-frames-list button')]\
                  .map(b => Number(b.dataset.frame))";
    let listed: Vec<i64> = serde_json::from_value(page.value(listed)).unwrap();
    let mut sums = [(0.0, 0); 9];
    let mut rows = csv::Reader::from_path(folder.path("out/results.csv")).unwrap();
    for row in rows.records().map(Result::unwrap) {
        if &row[6] == "psnr" && row[9].is_empty() && !row[4].is_empty() {
            let frame: usize = row[4].parse().unwrap();
            sums[frame].0 += row[11].parse::<f64>().unwrap();
            sums[frame].1 = frame as i64;
        }
    }
    sums.sort_by(|a, b| a.0.total_cmp(&b.0));
    let expected: Vec<i64> = sums.iter().map(|(_, frame)| *frame).collect();
    assert_eq!(listed, expected, "the worst frame first");

    let list: Value =
        serde_json::from_slice(&std::fs::read(folder.path("out/images/images.json")).unwrap())
            .unwrap();
    let frames = list["views"][0]["frames"].as_array().unwrap();
    let options = page.value("document.querySelectorAll('#viewer-frame option').length");
    assert_eq!(options, json!(frames.len()));
    let pictured: Vec<i64> = frames.iter().map(|f| f["frame"].as_i64().unwrap()).collect();
    let bare = expected.iter().find(|frame| !pictured.contains(frame)).unwrap();
    page.value(&format!(
        "document.querySelector('#viewer-frames-list [data-frame=\"{bare}\"]').click()"
    ));
    let note = page.text("document.querySelector('#viewer-note').textContent");
    assert!(note.contains(&bare.to_string()), "a frame without pictures is named: {note}");
    page.choose("#viewer-curve-metric", "ssim");
    page.value("document.querySelector('#viewer-curve').focus()");
    page.press("Home", 0);
    let chosen =
        page.text("document.querySelector('#viewer-frame').selectedOptions[0].textContent");
    assert!(chosen.contains('0') && chosen.contains("first"), "{chosen}");
    assert_eq!(page.complaints(), Vec::<String>::new());
    assert_eq!(page.requests().len(), 1);
}
