//! The pictures of the committed page in the documentation.

use std::env;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::json;

use super::chromium::Page;
use crate::fovqa::root;

/// Takes the pictures anew with `FOVQA_WRITE_PICTURES`; otherwise, only looks at whether the page opens.
/// (How a browser draws text differs from machine to machine.)
#[test]
fn the_committed_page_is_what_the_documentation_shows() {
    let file = root().join("reports/sample/report.html");
    let Some(mut page) = Page::open(&file) else { return };
    // So high that nothing has to scroll.
    page.show_as([1280, 4000], "light");
    page.until("document.documentElement.dataset.viewer === 'ready'");
    page.choose("#viewer-b", "map:0:fvvdp");
    page.value("document.querySelector('#viewer-rings').click()");
    page.value("document.querySelector('#viewer-stage').focus()");
    for key in ["ArrowRight"; 24].into_iter().chain(["ArrowDown"; 12]) {
        page.press(key, 8);
    }
    page.until("Number(document.querySelector('#viewer-readout').dataset.value) > 0");
    assert_eq!(page.complaints(), Vec::<String>::new());
    let mut take = |name: &str, place: &str| {
        let clip = page.value(&format!(
            "(() => {{ const r = document.querySelector({}).getBoundingClientRect(); \
             return {{ x: r.x - 12, y: r.y, width: r.width + 24, height: r.height, scale: 1 }}; }})()",
            json!(place)
        ));
        let params = json!({ "format": "png", "clip": clip });
        let taken = page.call("Page.captureScreenshot", &params);
        let bytes = BASE64_STANDARD.decode(taken["data"].as_str().unwrap()).unwrap();
        assert!(image::load_from_memory(&bytes).unwrap().width() > 600, "{name}");
        if env::var_os("FOVQA_WRITE_PICTURES").is_some() {
            std::fs::write(root().join(format!("docs/pictures/{name}.png")), bytes).unwrap();
        }
    };
    take("report-viewer", "#viewer");
}
