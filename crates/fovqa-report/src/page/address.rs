//! Paths as addresses.

use std::fmt::Write;

/// A path as a URL. Characters that are special in a URL or not plain ASCII are percent-encoded.
pub(crate) fn address(path: &str) -> String {
    let mut plain = String::new();
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'~' | b'/' => {
                plain.push(char::from(byte));
            }
            byte => {
                let _ = write!(plain, "%{byte:02X}");
            }
        }
    }
    plain
}
