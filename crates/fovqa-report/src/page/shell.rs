//! What all pages share: title, style, scripts, and the policy that a browser enforces.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// The style of all pages.
const STYLE: &str = include_str!("../../templates/report.css");
/// The script of all pages, which sorts tables.
const SCRIPT: &str = include_str!("../../templates/report.js");
/// The style of the viewer of frames.
const VIEWER_STYLE: &str = include_str!("../../templates/viewer/viewer.css");
/// The script of the viewer of frames: one script of several files, each of which uses those before it.
const VIEWER_SCRIPT: &str = concat!(
    include_str!("../../templates/viewer/elements.js"),
    include_str!("../../templates/viewer/numbers.js"),
    include_str!("../../templates/viewer/state.js"),
    include_str!("../../templates/viewer/decoding.js"),
    include_str!("../../templates/viewer/geometry.js"),
    include_str!("../../templates/viewer/drawing.js"),
    include_str!("../../templates/viewer/colour-bars.js"),
    include_str!("../../templates/viewer/readout.js"),
    include_str!("../../templates/viewer/choices.js"),
    include_str!("../../templates/viewer/pointer.js"),
    include_str!("../../templates/viewer/keys.js"),
    include_str!("../../templates/viewer/sequence.js"),
    include_str!("../../templates/viewer/start.js"),
);

/// The frame of a page.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shell {
    pub(crate) title: String,
    /// The Content-Security-Policy. Only the styles and scripts of the page pass it.
    pub(crate) policy: String,
    pub(crate) styles: Vec<&'static str>,
    pub(crate) scripts: Vec<&'static str>,
}

impl Shell {
    /// The frame of a page whose pictures are all inside it.
    pub(crate) fn new(title: &str) -> Self {
        Self::of(title, "data:", vec![STYLE], vec![SCRIPT])
    }

    /// The frame of a page that also shows pictures that lie beside it.
    pub(crate) fn with_files(title: &str) -> Self {
        // In a page that is read from a disk, 'self' is not the disk in every browser.
        Self::of(title, "'self' data: file:", vec![STYLE], vec![SCRIPT])
    }

    /// The frame of a page with a viewer of frames.
    pub(crate) fn with_viewer(title: &str) -> Self {
        Self::of(title, "data:", vec![STYLE, VIEWER_STYLE], vec![SCRIPT, VIEWER_SCRIPT])
    }

    fn of(
        title: &str,
        images: &str,
        styles: Vec<&'static str>,
        scripts: Vec<&'static str>,
    ) -> Self {
        let policy = format!(
            "default-src 'none'; img-src {images}; style-src{}; script-src{}; base-uri 'none'; form-action 'none'",
            hashes(&styles),
            hashes(&scripts),
        );
        Self { title: title.to_owned(), policy, styles, scripts }
    }
}

/// The sources of a policy that texts between tags match.
fn hashes(texts: &[&str]) -> String {
    let hash = |text: &&str| format!(" 'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    texts.iter().map(hash).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_policy_of_a_viewer_lets_its_script_run() {
        assert_eq!(hashes(&["abc"]), " 'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='");
        let shell = Shell::with_viewer("x");
        assert_eq!(shell.policy.matches("'sha256-").count(), 4);
        for text in shell.styles.iter().chain(&shell.scripts) {
            assert!(shell.policy.contains(&hashes(&[text])) && !text.contains("</"), "{text}");
        }
        assert!(!Shell::new("x").policy.contains("file:"));
        assert!(Shell::with_files("x").policy.contains("img-src 'self' data: file:;"));
    }
}
