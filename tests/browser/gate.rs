//! A gate that fails because of one frame of a walk through the gallery: the page begins with it. Its
//! picture is in the documentation.

use std::env;
use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use image::imageops::blur;
use serde_json::{Value, json};

use super::chromium::Page;
use crate::fovqa::{Folder, root};

const EXPERIMENT: &str = "name = \"nightly\"\nbaseline = \"good.json\"\n\
    [view]\nfov_vertical_deg = 100\nluminance = \"htc-vive-pro\"\nbands_deg = [0, 5, 10, 20, 30, 45, 75]\n\
    gaze = { trace = \"hall/gaze.csv\" }\n\
    [[scene]]\nname = \"hall\"\nreference = \"hall/png\"\nfps = 60\n\
    [[method]]\nname = \"RMFR\"\ntest = \"renders\"\n\
    [metrics]\npsnr = {}\nssim = {}\nfvvdp = {}\n\
    [[gate]]\nname = \"the whole walk\"\nmetric = \"fvvdp\"\nmax_drop = 0.05\n\
    [[gate]]\nname = \"every frame\"\nmetric = \"ssim\"\nper_frame = true\nmax_drop = 0.0005\n";

/// The frame that is blurred, and around which pixel within which distance.
const FRAME: i64 = 9;
const PLACE: [u32; 2] = [232, 150];
const RADIUS: f64 = 10.0;

#[test]
fn a_blurred_patch_in_a_walk_is_shown_first() {
    let folder = Folder::new();
    let size = ["--resolution", "320x320", "--fov-vertical", "100"];
    let gallery =
        ["gallery", "--output", "hall", "--frames", "16", "--fps", "60", "--samples", "4"];
    folder.run(&[&gallery[..], &size].concat()).ok();
    let foveate = ["foveate", "hall/png", "renders", "--method", "rmfr", "--set", "sigma=1.6"];
    folder
        .run(&[&foveate[..], &["--fov-vertical", "100", "--gaze", "hall/gaze.csv"]].concat())
        .ok();
    folder.write("nightly.toml", EXPERIMENT);
    folder.run(&["run", "nightly.toml", "--output", "good"]).ok();
    folder.run(&["baseline", "save", "good", "good.json", "--frames"]).ok();
    let file = folder.path(&format!("renders/{FRAME:04}.png"));
    let mut render = image::open(&file).unwrap().into_rgb8();
    let soft = blur(&render, 1.5);
    for (x, y, pixel) in render.enumerate_pixels_mut() {
        let [dx, dy] = [f64::from(x) - f64::from(PLACE[0]), f64::from(y) - f64::from(PLACE[1])];
        if dx.hypot(dy) <= RADIUS {
            *pixel = *soft.get_pixel(x, y);
        }
    }
    render.save(&file).unwrap();
    let run = folder.run(&["gate", "nightly.toml", "--output", "out"]);
    assert_eq!(run.code, 1, "{}{}", run.stdout, run.stderr);
    let verdict: Value =
        serde_json::from_slice(&fs::read(folder.path("out/gate/verdict.json")).unwrap()).unwrap();
    let rules = verdict["rules"].as_array().unwrap();
    assert_eq!(rules[0]["state"], "passed", "it hides in the mean: {verdict:#}");
    let loss = &rules[1]["checks"][0]["losses"][0];
    assert_eq!((&loss["frame"], &loss["place"]["compared"]), (&FRAME.into(), &"baseline".into()));
    let off = [("x_px", PLACE[0]), ("y_px", PLACE[1])]
        .map(|(axis, place)| loss["place"][axis].as_f64().unwrap() - f64::from(place));
    // 2.3 pixels are a degree at the centre.
    assert!(off[0].hypot(off[1]) < 11.0, "{off:?}");
    let Some(mut page) = Page::open(&folder.path("out/report.html")) else { return };
    page.show_as([1280, 900], "light");
    page.call("Emulation.setScrollbarsHidden", &json!({ "hidden": true }));
    page.until("document.documentElement.dataset.viewer === 'ready'");
    assert_eq!(page.complaints(), Vec::<String>::new());
    let first = page.value("document.querySelector('main h2').textContent");
    assert_eq!(first, "The gate fails: 1 of 2 rules");
    let broken =
        "[...document.querySelectorAll('.verdict img')].filter(i => !i.naturalWidth).length";
    assert_eq!(page.value(broken), 0);
    for size in [[1440, 900], [390, 800]] {
        page.show_as(size, "dark");
        let wider = page.value("document.documentElement.scrollWidth > innerWidth");
        assert_eq!(wider, false, "{size:?}");
    }
    page.show_as([1280, 900], "light");
    let clip = page.value(
        "(() => { const box = document.querySelector('.verdict').getBoundingClientRect(); \
         return { x: box.x + scrollX - 12, y: box.y + scrollY, width: box.width + 24, \
         height: box.height + 12, scale: 1 }; })()",
    );
    let params = json!({ "format": "png", "captureBeyondViewport": true, "clip": clip });
    let taken = page.call("Page.captureScreenshot", &params);
    let bytes = BASE64_STANDARD.decode(taken["data"].as_str().unwrap()).unwrap();
    if env::var_os("FOVQA_WRITE_PICTURES").is_some() {
        fs::write(root().join("docs/pictures/gate-verdict.png"), bytes).unwrap();
    }
}
