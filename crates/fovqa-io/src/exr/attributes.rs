//! Checks the headers before they are decoded: the number of attributes and their lengths.
//!
//! The decoder keeps all attributes in memory, and a file may declare millions of them, or one of
//! two gigabytes. Regular headers are far below these limits: the longest attribute that renderers
//! write, a Cryptomatte manifest, has some megabytes.

use std::io::{BufRead, Read, Seek, SeekFrom};

use crate::error::ReadErrorKind;

/// The largest number of attributes of all headers together.
const MOST_ATTRIBUTES: u64 = 65_536;
/// The largest size of one attribute, in bytes.
const MOST_BYTES: u64 = 16 << 20;
/// The largest size of an attribute whose values take many times their bytes in memory (lists of
/// channels and texts), in bytes.
const MOST_LIST_BYTES: u64 = 1 << 20;
/// The largest size of all attributes together, in bytes.
const MOST_BYTES_IN_ALL: u64 = 64 << 20;
/// The longest name, in bytes (OpenEXR, "OpenEXR File Layout", section "Attribute Names").
const LONGEST_NAME: u64 = 255;

/// Checks the headers of a file, and then restores its position.
///
/// # Errors
/// When they exceed the limits, or end too early.
pub(super) fn check(file: &mut (impl BufRead + Seek)) -> Result<(), ReadErrorKind> {
    let start = file.stream_position()?;
    let end = file.seek(SeekFrom::End(0))?;
    file.seek(SeekFrom::Start(start))?;
    let checked = Scan { file: &mut *file, end, attributes: 0, bytes: 0 }.headers();
    file.seek(SeekFrom::Start(start))?;
    checked
}

struct Scan<'a, R> {
    file: &'a mut R,
    /// Length of the file in bytes.
    end: u64,
    attributes: u64,
    bytes: u64,
}

impl<R: BufRead + Seek> Scan<'_, R> {
    fn headers(&mut self) -> Result<(), ReadErrorKind> {
        /// The bit of the version field that says that the file has several parts.
        const SEVERAL_PARTS: u32 = 0x1000;
        let [_magic, version] = [self.word()?, self.word()?];
        loop {
            let empty = self.header()?;
            // An empty header ends the list of several headers.
            if empty || version & SEVERAL_PARTS == 0 {
                return Ok(());
            }
        }
    }

    /// Reads a header, and returns whether it had no attribute.
    fn header(&mut self) -> Result<bool, ReadErrorKind> {
        let mut empty = true;
        loop {
            let name = self.name()?;
            if name.is_empty() {
                return Ok(empty);
            }
            empty = false;
            let kind = self.name()?;
            let size = self.word()?;
            self.attribute(&name, &kind, u64::from(size))?;
        }
    }

    fn attribute(&mut self, name: &[u8], kind: &[u8], size: u64) -> Result<(), ReadErrorKind> {
        self.attributes += 1;
        self.bytes += size;
        let limit = match kind {
            b"chlist" | b"stringvector" => MOST_LIST_BYTES,
            _ => MOST_BYTES,
        };
        let name = String::from_utf8_lossy(name);
        if size > limit {
            let what = format!("an attribute ({name:?}) of {size} bytes");
            return Err(ReadErrorKind::Header { what, limit: format!("{limit} bytes") });
        }
        if self.attributes > MOST_ATTRIBUTES {
            let what = format!("more than {MOST_ATTRIBUTES} attributes");
            let limit = format!("{MOST_ATTRIBUTES} attributes");
            return Err(ReadErrorKind::Header { what, limit });
        }
        if self.bytes > MOST_BYTES_IN_ALL {
            let what = format!("attributes of more than {MOST_BYTES_IN_ALL} bytes in all");
            let limit = format!("{MOST_BYTES_IN_ALL} bytes");
            return Err(ReadErrorKind::Header { what, limit });
        }
        let at = self.file.stream_position()?;
        if self.end.saturating_sub(at) < size {
            return Err(cut_short());
        }
        // The largest attribute is far smaller than an `i64` can count.
        self.file.seek_relative(size as i64)?;
        Ok(())
    }

    /// Reads a text that ends with a zero byte.
    fn name(&mut self) -> Result<Vec<u8>, ReadErrorKind> {
        let mut name = Vec::new();
        self.file.by_ref().take(LONGEST_NAME + 1).read_until(0, &mut name)?;
        match name.pop() {
            Some(0) => Ok(name),
            Some(_) if name.len() as u64 >= LONGEST_NAME => {
                let detail = "the name of an attribute does not end".to_owned();
                Err(ReadErrorKind::Damaged { format: "OpenEXR", detail })
            }
            _ => Err(cut_short()),
        }
    }

    fn word(&mut self) -> Result<u32, ReadErrorKind> {
        let mut bytes = [0; 4];
        self.file.read_exact(&mut bytes).map_err(|error| match error.kind() {
            std::io::ErrorKind::UnexpectedEof => cut_short(),
            _ => error.into(),
        })?;
        Ok(u32::from_le_bytes(bytes))
    }
}

fn cut_short() -> ReadErrorKind {
    let detail = "the file ends too early".to_owned();
    ReadErrorKind::Damaged { format: "OpenEXR", detail }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn header(attributes: &[(&str, &str, u32, usize)], several: bool) -> Vec<u8> {
        let mut bytes = 20_000_630u32.to_le_bytes().to_vec();
        bytes.extend((2 | if several { 0x1000u32 } else { 0 }).to_le_bytes());
        for (name, kind, declared, held) in attributes {
            bytes.extend([name.as_bytes(), b"\0", kind.as_bytes(), b"\0"].concat());
            bytes.extend(declared.to_le_bytes());
            bytes.extend(vec![7; *held]);
        }
        bytes.push(0);
        bytes
    }

    fn words(bytes: Vec<u8>) -> String {
        let mut file = Cursor::new(bytes);
        let checked = check(&mut file);
        assert_eq!(file.position(), 0, "the file is left where it was");
        checked.err().map(|error| error.to_string()).unwrap_or_default()
    }

    #[test]
    fn attributes_are_counted_and_measured_before_they_are_read() {
        let (many, megabyte) = (MOST_ATTRIBUTES as usize, 1 << 20);
        assert_eq!(words(header(&[("a", "int", 4, 4), ("b", "string", 9, 9)], false)), "");
        assert_eq!(words(header(&vec![("a", "b", 0, 0); many], false)), "");
        let long = words(header(&[("x", "blob", 0x8000_0000, 4)], false));
        assert!(long.contains("\"x\"") && long.contains("2147483648 bytes"), "{long}");
        let list = words(header(&[("channels", "chlist", 1_048_577, 4)], false));
        assert!(list.contains("\"channels\""), "{list}");
        let count = words(header(&vec![("a", "b", 0, 0); many + 1], false));
        assert!(count.contains("more than 65536 attributes"), "{count}");
        let all = words(header(&[("a", "b", 13 * megabyte as u32, 13 * megabyte); 5], false));
        assert!(all.contains("67108864 bytes in all"), "{all}");
    }

    #[test]
    fn headers_that_end_too_early_are_damaged() {
        let whole = header(&[("a", "int", 4, 4)], false);
        for end in 0..whole.len() {
            assert!(words(whole[..end].to_vec()).contains("ends too early"), "{end}");
        }
        // A file with several parts ends its headers with an empty one.
        let part = header(&[("a", "int", 4, 4)], true);
        assert!(words(part.clone()).contains("ends too early"));
        assert_eq!(words([&part[..], &[0]].concat()), "");
        let endless = words(header(&[(&"n".repeat(300), "int", 4, 4)], false));
        assert!(endless.contains("does not end"), "{endless}");
    }
}
