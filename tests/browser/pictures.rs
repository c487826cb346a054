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
    page.show_as([1280, 900], "light");
    page.call("Emulation.setScrollbarsHidden", &json!({ "hidden": true }));
    page.until("document.documentElement.dataset.viewer === 'ready'");
    page.choose("#viewer-b", "map:0:fvvdp");
    page.value("document.querySelector('#viewer-rings').click()");
    page.value("document.querySelector('#viewer-stage').focus()");
    for key in ["ArrowRight"; 24].into_iter().chain(["ArrowDown"; 12]) {
        page.press(key, 8);
    }
    page.until("Number(document.querySelector('#viewer-readout').dataset.value) > 0");
    assert_eq!(page.complaints(), Vec::<String>::new());
    let clip = page.value(
        "(() => { const [top, last] = ['#viewer', '#viewer-main'].map(place => \
         document.querySelector(place).getBoundingClientRect()); \
         return { x: top.x + scrollX - 12, y: top.y + scrollY, width: top.width + 24, \
         height: last.bottom - top.y, scale: 1 }; })()",
    );
    let params = json!({ "format": "png", "captureBeyondViewport": true, "clip": clip });
    let taken = page.call("Page.captureScreenshot", &params);
    let bytes = BASE64_STANDARD.decode(taken["data"].as_str().unwrap()).unwrap();
    let size = image::load_from_memory(&bytes).unwrap();
    assert!(size.width() > 1000 && size.height() > 600, "{}x{}", size.width(), size.height());
    if env::var_os("FOVQA_WRITE_PICTURES").is_some() {
        std::fs::write(root().join("docs/pictures/report-viewer.png"), bytes).unwrap();
    }
}
