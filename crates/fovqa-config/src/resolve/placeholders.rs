//! Placeholders in paths: `{scene}`, `{folder}`, `{method}`, `{eye}`.

use std::ops::Range;
use std::path::{Path, PathBuf};

use fovqa_io::sequence::{is_glob, literal};

use crate::fault::{Fault, Faults};

/// The longest path in bytes that Linux opens. Without a limit, a text that consists of
/// placeholders could fill the memory.
const LONGEST_PATH: usize = 4096;

/// The values of the placeholders in a path.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Placeholders<'a> {
    pub(super) scene: &'a str,
    pub(super) folder: &'a str,
    pub(super) method: Option<&'a str>,
    pub(super) eye: Option<&'static str>,
}

impl Placeholders<'_> {
    /// Converts a text from the file to a path below `base`.
    fn path(&self, base: &Path, text: &str) -> Result<PathBuf, (String, String)> {
        if text == "-" {
            let message = "\"-\" is standard input, which an experiment cannot read".to_owned();
            return Err((message, "give a file; `fovqa score` reads standard input".to_owned()));
        }
        // In a pattern, the inserted names are literal, whatever characters they contain.
        let pattern = is_glob(Path::new(text));
        let verbatim = |name: &str| {
            if pattern { literal(name) } else { name.to_owned() }
        };
        let too_long = || {
            let message = format!("the path becomes longer than {LONGEST_PATH} bytes");
            (message, "name fewer placeholders, or shorter ones".to_owned())
        };
        let mut path = String::new();
        let mut rest = text;
        while let Some((before, behind)) = rest.split_once('{') {
            path.push_str(before);
            if path.len() > LONGEST_PATH {
                return Err(too_long());
            }
            let Some((name, after)) = behind.split_once('}') else {
                return Err((
                    format!("\"{text}\" opens a brace but does not close it"),
                    self.known(),
                ));
            };
            path.push_str(&verbatim(match name {
                "scene" => self.scene,
                "folder" => self.folder,
                "method" if self.method.is_some() => self.method.unwrap_or_default(),
                "eye" => self.eye.ok_or_else(|| {
                    let message = format!("\"{text}\" contains {{eye}}, but the scene \"{}\" has one reference for both eyes", self.scene);
                    (message, "give the scene reference = { left = \"…\", right = \"…\" }".to_owned())
                })?,
                other => {
                    return Err((format!("\"{text}\" contains {{{other}}}, which is not a known placeholder"), self.known()));
                }
            }));
            rest = after;
        }
        path.push_str(rest);
        if path.len() > LONGEST_PATH {
            return Err(too_long());
        }
        Ok(base.join(path))
    }

    fn known(&self) -> String {
        let method = if self.method.is_some() { ", {method}" } else { "" };
        format!(
            "braces may hold {{scene}}, {{folder}}{method} or, in a scene with two eyes, {{eye}}"
        )
    }
}

/// A path with its placeholders filled in.
pub(super) fn path(
    placeholders: Placeholders<'_>,
    base: &Path,
    text: &str,
    span: Range<usize>,
    faults: &mut Faults,
) -> Option<PathBuf> {
    match placeholders.path(base, text) {
        Ok(path) => Some(path),
        Err((message, help)) => {
            faults.push(Fault::new(span, message).help(help));
            None
        }
    }
}
