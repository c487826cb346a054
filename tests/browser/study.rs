//! The page of a study: nothing is asked of a network, names stay text, and it fits on screens.

use std::fmt::Write as _;

use serde_json::json;

use super::chromium::Page;
use crate::fovqa::Folder;

const METHODS: [&str; 3] = ["<img src=x onerror=alert(1)>", "a & \"b\" </script>", "C'\u{1f600}%#"];

/// Votes on three methods with such names, in two scenes.
fn results() -> Folder {
    let folder = Folder::new();
    let mut votes = String::from("participant,scene,method_a,method_b,answer\n");
    let cell = |name: &str| format!("\"{}\"", name.replace('"', "\"\""));
    for vote in 0..60 {
        let pair = [[0, 1], [0, 2], [1, 2]][vote % 3].map(|method| cell(METHODS[method]));
        let (scene, answer) =
            (["hall", "<b>road</b>"][vote / 3 % 2], ["a", "b"][usize::from(vote % 7 == 0)]);
        let _ = writeln!(votes, "P{},{scene},{},{},{answer}", vote / 12, pair[0], pair[1]);
    }
    folder.write("votes.csv", votes);
    folder.write(
        "s.toml",
        "name = \"page\"\nabout = \"</script><script>window.broken = true</script>\"\n\
         [[analysis]]\nkind = \"pairs\"\ntitle = \"<i>Votes</i>\"\nfile = \"votes.csv\"\nby = [\"scene\"]\n\
         bootstrap = 50\n[[analysis]]\nkind = \"ranks\"\nfile = \"votes.csv\"\n",
    );
    folder.run(&["study", "s.toml", "--output", "out"]).ok();
    folder
}

#[test]
fn the_page_of_a_study_asks_for_nothing_and_names_run_nothing() {
    let folder = results();
    let Some(mut page) = Page::open(&folder.path("out/index.html")) else { return };
    let requests = page.requests();
    assert_eq!(requests.len(), 1, "the page itself: {requests:?}");
    assert_eq!(page.value("window.broken === undefined"), json!(true));
    assert_eq!(page.value("document.querySelectorAll('img[src=\"x\"]').length"), json!(0));
    let text = page.text("document.body.innerText");
    for name in [METHODS[0], METHODS[1], METHODS[2], "<i>Votes</i>", "<b>road</b>"] {
        assert!(text.contains(name), "{name} is shown as it is");
    }
    // Figures: shares and scores of the votes, means of the ranks.
    let drawn = "[...document.querySelectorAll('figure img')].every(i => i.naturalWidth > 100)";
    assert_eq!(page.value("document.querySelectorAll('figure img').length"), json!(3));
    assert_eq!(page.value(drawn), json!(true));
    for [width, height] in [[1440, 900], [390, 844]] {
        for scheme in ["light", "dark"] {
            page.show_as([width, height], scheme);
            let wide = page.value("document.documentElement.scrollWidth");
            assert!(wide.as_u64().unwrap() <= u64::from(width), "{wide} in {width}");
        }
    }
    assert_eq!(page.complaints(), Vec::<String>::new());
}
