//! The page of a run of stills: nothing is asked of a network, names stay text, tables are sorted, and the
//! viewer shows what the files hold.

use fovqa_frame::Samples;
use fovqa_io::{ReadOptions, read_frame};
use fovqa_vision::{Eccentricity, EccentricityKind, View};
use serde_json::{Value, json};

use super::chromium::Page;
use crate::fovqa::Folder;

const SCENE: &str = "a<b>&\"'\u{1f600} #1%";
const METHOD: &str = "<img src=x onerror=alert(1)>";

/// A run of a still scene with two methods, a gaze beside the centre, and maps of every frame as files.
fn results() -> Folder {
    let folder = Folder::new();
    let quoted = |text: &str| Value::from(text).to_string();
    folder.write(
        "s.toml",
        format!(
            "name = \"page\"\nabout = {}\n[view]\nfov_vertical_deg = 90\ngaze = [100, 90]\n\
             bands_deg = [0, 10, 20, 40, 60]\n[[scene]]\nname = {}\nbuiltin = \"gallery\"\n\
             resolution = \"180x160\"\nframes = 1\nsamples = 2\n\
             [[method]]\nname = {}\nemulate = {{ model = \"rmfr\" }}\n\
             [[method]]\nname = \"DEAMP\"\nemulate = {{ model = \"deamp\" }}\n\
             [metrics]\nmse = {{}}\npsnr = {{}}\nssim = {{}}\ngmsd = {{}}\n\
             [report]\nsize = 120\n[output]\nmaps = [\"mse\", \"ssim\", \"gmsd\"]\n",
            quoted("</script><script>window.broken = true</script> <!-- & -->"),
            quoted(SCENE),
            quoted(METHOD),
        ),
    );
    folder.run(&["run", "s.toml", "--output", "out"]).ok();
    folder
}

fn opened(folder: &Folder) -> Option<Page> {
    let mut page = Page::open(&folder.path("out/report.html"))?;
    page.until("document.documentElement.dataset.viewer === 'ready'");
    Some(page)
}

/// The mean of a map's file over a block of pixels of the frame; `step` pixels share a value.
fn block_mean(folder: &Folder, map: &str, (block, step): (usize, usize), at: [usize; 2]) -> f64 {
    let file = format!("out/maps/{SCENE}/{METHOD}/{map}-0000.exr");
    let frame = read_frame(&folder.path(&file), &ReadOptions::default()).unwrap().frame;
    let Samples::F32(values) = frame.samples() else { panic!("32-bit floats") };
    let side = block / step;
    let [left, top] = at.map(|at| at / block * side);
    let rows = top..(top + side).min(frame.height());
    let places = rows.flat_map(|y| (left..(left + side).min(frame.width())).map(move |x| (x, y)));
    let found: Vec<f64> = places
        .map(|(x, y)| f64::from(values[y * frame.width() + x]))
        .filter(|value| !value.is_nan())
        .collect();
    found.iter().sum::<f64>() / found.len() as f64
}

fn readout(page: &mut Page, name: &str) -> f64 {
    let text = page.text(&format!("document.querySelector('#viewer-readout').dataset.{name}"));
    text.parse().unwrap_or_else(|_| panic!("{name} is {text:?}"))
}

#[test]
fn the_page_asks_for_nothing_and_names_run_nothing() {
    let folder = results();
    let Some(mut page) = opened(&folder) else { return };
    let requests = page.requests();
    assert_eq!(requests.len(), 1, "the page itself: {requests:?}");
    assert_eq!(page.complaints(), Vec::<String>::new());
    assert_eq!(page.value("window.broken === undefined"), json!(true));
    assert_eq!(page.value("document.querySelectorAll('img[src=\"x\"]').length"), json!(0));
    let text = page.text("document.body.innerText");
    for name in [SCENE, METHOD, "</script><script>window.broken = true</script>"] {
        assert!(text.contains(name), "{name} is shown as it is");
    }
    let chosen = page.text("document.querySelector('#viewer-b').selectedOptions[0].textContent");
    assert!(chosen.contains(METHOD), "{chosen}");
    // A link to a file beside the page leads to it, whatever its name.
    let link = page.text(
        "decodeURIComponent(new URL(document.querySelector('#viewer-full-b').href).pathname)",
    );
    assert!(std::path::Path::new(&link).is_file(), "{link}");
    for [width, height] in [[1440, 900], [390, 844]] {
        for scheme in ["light", "dark"] {
            page.show_as([width, height], scheme);
            let wide = page.value("document.documentElement.scrollWidth");
            assert!(wide.as_u64().unwrap() <= u64::from(width), "{wide} in {width}");
        }
    }
    assert_eq!(page.complaints(), Vec::<String>::new());
}

#[test]
fn a_heading_sorts_the_table() {
    let folder = results();
    let Some(mut page) = opened(&folder) else { return };
    let column = |name: &str| {
        format!(
            "[...document.querySelectorAll('th button')].find(b => b.textContent.includes('{name}'))"
        )
    };
    let values = |page: &mut Page| -> Vec<f64> {
        let found = page.value(&format!(
            "(() => {{ const th = {}.closest('th'); const table = th.closest('table'); \
             const at = [...table.querySelectorAll('thead tr:last-child th')].indexOf(th); \
             const offset = table.querySelector('tbody tr[class=\"\"], tbody tr:not([class])').cells.length \
             - table.querySelectorAll('thead tr:last-child th').length; \
             return [...table.querySelectorAll('tbody tr')].filter(r => r.cells.length > 2 && \
             !r.className).map(r => Number(r.cells[at + offset].dataset.value)); }})()",
            column("PSNR")
        ));
        serde_json::from_value(found).unwrap()
    };
    let order = |page: &mut Page| page.text(&format!("{}.closest('th').ariaSort", column("PSNR")));
    let before = values(&mut page);
    assert_eq!(before.len(), 2);
    assert!(before.iter().all(|value| value.is_finite()), "{before:?}");
    let mut seen = Vec::new();
    for _ in 0..3 {
        page.value(&format!("{}.focus()", column("PSNR")));
        page.press("Enter", 0);
        let now = (order(&mut page), values(&mut page));
        let is_sorted = match now.0.as_str() {
            "ascending" => now.1[0] < now.1[1],
            "descending" => now.1[0] > now.1[1],
            _ => now.1 == before,
        };
        assert!(is_sorted, "{now:?}");
        seen.push(now.0);
    }
    seen.sort();
    assert_eq!(&seen[..2], ["ascending", "descending"], "and then as before: {seen:?}");
}

#[test]
fn the_divider_moves_by_drag_and_by_keys() {
    const AT: &str =
        "Number(document.querySelector('#viewer-divider').getAttribute('aria-valuenow'))";
    let folder = results();
    let Some(mut page) = opened(&folder) else { return };
    let pixel = |page: &mut Page| {
        page.value(
            "(() => { const c = document.querySelector('#viewer-stage'); \
             const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; \
             let sum = 0; for (let i = 0; i < d.length; i++) sum = (sum * 31 + d[i]) % 1000000007; \
             return sum; })()",
        )
    };
    let begin = page.value(AT).as_f64().unwrap();
    page.value("document.querySelector('#viewer-divider').focus()");
    let picture = pixel(&mut page);
    for _ in 0..20 {
        page.press("ArrowRight", 0);
    }
    // The stage is drawn with the next picture of the screen.
    let moved = begin + 20.0;
    page.until(&format!("{AT} === {moved}"));
    assert_ne!(pixel(&mut page), picture, "the stage is drawn again");
    let from = page.middle("#viewer-divider");
    page.pointer("mouseMoved", from);
    page.pointer("mousePressed", from);
    page.pointer("mouseMoved", [from[0] - 60.0, from[1]]);
    page.pointer("mouseReleased", [from[0] - 60.0, from[1]]);
    page.until(&format!("{AT} < {}", moved - 3.0));
    let zoom = "document.querySelector('#viewer-zoom').textContent";
    let before = page.value(zoom);
    page.click("#viewer-zoom-in");
    page.until(&format!("{zoom} !== {before}"));
}

#[test]
fn the_value_under_the_pointer_is_the_mean_of_the_map_over_the_block() {
    let folder = results();
    let Some(mut page) = opened(&folder) else { return };
    // 180 pixels, 120 on the page, 30 blocks: 6 pixels a block.
    for (map, step) in [("mse", 1), ("ssim", 1), ("gmsd", 2)] {
        page.choose("#viewer-b", &format!("map:0:{map}"));
        page.until("document.documentElement.dataset.viewer === 'ready'");
        let middle = page.middle("#viewer-stage");
        for [dx, dy] in [[20.0, 10.0], [-35.0, 22.0], [41.0, -30.0]] {
            // The next drawing fills it again.
            page.value("document.querySelector('#viewer-readout').dataset.value = ''");
            page.pointer("mouseMoved", [middle[0] + dx, middle[1] + dy]);
            page.until("document.querySelector('#viewer-readout').dataset.value !== ''");
            let at = [readout(&mut page, "x") as usize, readout(&mut page, "y") as usize];
            let expected = block_mean(&folder, map, (6, step), at);
            let found = readout(&mut page, "value");
            // Half floats have eleven bits.
            let tolerance = expected.abs() / 2048.0 + 1e-7;
            assert!((found - expected).abs() <= tolerance, "{map} at {at:?}: {found}, {expected}");
            let focal = 80.0;
            let view =
                View { width: 180, height: 160, focal_px: [focal; 2], principal_px: [90.0, 80.0] };
            let eccentricity = Eccentricity::new(view, [100.0, 90.0], EccentricityKind::Angular);
            let deg = eccentricity.at_deg(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
            let shown = readout(&mut page, "eccentricity");
            assert!((shown - deg).abs() < 1e-6, "{shown} {deg}");
        }
    }
}

#[test]
fn the_viewer_works_from_the_keyboard_alone() {
    let folder = results();
    let Some(mut page) = opened(&folder) else { return };
    let focused = |page: &mut Page| page.text("document.activeElement?.id");
    let mut reached = Vec::new();
    for _ in 0..200 {
        page.press("Tab", 0);
        reached.push(focused(&mut page));
        if reached.iter().any(|id| id == "viewer-borders") {
            break;
        }
    }
    for id in
        ["viewer-a", "viewer-b", "viewer-map", "viewer-stage", "viewer-divider", "viewer-rings"]
    {
        assert!(reached.iter().any(|reached| reached == id), "{id} is reached: {reached:?}");
    }
    page.value("document.querySelector('#viewer-stage').focus()");
    page.press("ArrowRight", 8);
    page.press("ArrowDown", 8);
    page.until("document.querySelector('#viewer-readout').dataset.x !== ''");
    let first = readout(&mut page, "x");
    page.press("ArrowRight", 8);
    page.press("ArrowRight", 8);
    page.until(&format!("document.querySelector('#viewer-readout').dataset.x > {first}"));
    let scores = page.value("document.querySelectorAll('#viewer-scores tbody tr').length");
    assert_eq!(scores, json!(2), "a row of scores for each method");
    page.value("document.querySelector('#viewer-mode-flicker').click()");
    page.value("document.querySelector('#viewer-stage').focus()");
    let shown = "[...document.querySelectorAll('.viewer-tag')].map(t => t.hidden || \
                 getComputedStyle(t).display === 'none' ? '' : t.textContent).join('|')";
    let before = page.text(shown);
    page.press("f", 0);
    page.until(&format!("{shown} !== {}", json!(before)));
    assert_eq!(page.complaints(), Vec::<String>::new());
}
