//! Paths as results show them.

use std::ffi::OsStr;
use std::fmt::Write;
use std::path::{Component, Path};

/// A path as results show it: relative to the folder `base` if it lies there, else as it is.
/// Folders are separated by `/`, and bytes that are not UTF-8 are written as `\\xff`.
pub fn shown(base: &Path, path: &Path) -> String {
    slashed(path.strip_prefix(base).unwrap_or(path))
}

/// A path with `/` between its folders and without `.`.
fn slashed(path: &Path) -> String {
    let mut parts: Vec<String> = Vec::new();
    for part in path.components() {
        match part {
            Component::RootDir => parts.push(String::new()),
            Component::CurDir => {}
            part => parts.push(text_of(part.as_os_str())),
        }
    }
    parts.join("/")
}

/// A name as text, such that different names have different texts. Bytes that are not UTF-8 are
/// written as `\\xff`; if a name has such bytes, or text that looks like them, its backslashes are
/// doubled.
fn text_of(name: &OsStr) -> String {
    if let Some(text) = name.to_str().filter(|text| !text.contains("\\x")) {
        return text.to_owned();
    }
    let mut text = String::new();
    for chunk in name.as_encoded_bytes().utf8_chunks() {
        text.push_str(&chunk.valid().replace('\\', "\\\\"));
        for byte in chunk.invalid() {
            // Writing to a string does not fail.
            let _ = write!(text, "\\x{byte:02x}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn names_that_are_not_utf8_stay_distinct() {
        use std::os::unix::ffi::OsStrExt;
        let of = |name: &[u8]| text_of(std::ffi::OsStr::from_bytes(name));
        assert_eq!(of(b"g\xfft"), r"g\xfft");
        assert_eq!(of(b"g\xfet"), r"g\xfet");
        assert_eq!(of(br"g\xfft"), r"g\\xfft");
        assert_eq!(of(br"a\b"), r"a\b");
        assert_eq!(of("g\u{fffd}t".as_bytes()), "g\u{fffd}t");
    }

    #[test]
    fn paths_are_shown_from_the_experiment() {
        let of = |base: &str, path: &str| shown(Path::new(base), Path::new(path));
        assert_eq!(of("configs", "configs/../data/./gt.png"), "../data/gt.png");
        assert_eq!(of("configs", "/data/gt.png"), "/data/gt.png");
        assert_eq!(of("", "./gt/0.png"), "gt/0.png");
    }
}
