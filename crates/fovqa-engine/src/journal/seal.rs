//! The checksum at the end of each line of a journal. It reveals lines that were truncated or
//! changed.
//!
//! The last key of a line is `"sum"`: the CRC-32 (ISO-HDLC, the variant of PNG and gzip) of all
//! bytes before it, as eight hexadecimal digits.

/// The text before the digits.
const BEFORE: &[u8] = b",\"sum\":\"";
const BEHIND: &[u8] = b"\"}";
const DIGITS: usize = 8;

/// The result of the checksum test for a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Seal {
    /// The line is as it was written.
    Whole,
    /// The line was changed after it was written.
    Broken,
    /// There is no checksum: this is not a line of a journal, or only a part of one.
    None,
}

/// Writes a JSON object as a line with its checksum.
pub(super) fn sealed(mut object: Vec<u8>) -> Vec<u8> {
    // Remove the closing brace.
    object.pop();
    let sum = crc32fast::hash(&object);
    object.extend(BEFORE);
    object.extend(format!("{sum:08x}").bytes());
    object.extend(BEHIND);
    object.push(b'\n');
    object
}

/// Tests the checksum of a line, with or without its line end.
pub(super) fn seal_of(line: &[u8]) -> Seal {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    let parts = line.strip_suffix(BEHIND).and_then(|line| {
        let (line, digits) = line.split_at_checked(line.len().checked_sub(DIGITS)?)?;
        Some((line.strip_suffix(BEFORE)?, digits))
    });
    match parts {
        None => Seal::None,
        Some((object, digits))
            if digits == format!("{:08x}", crc32fast::hash(object)).as_bytes() =>
        {
            Seal::Whole
        }
        Some(_) => Seal::Broken,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The check value of the algorithm: CRC-32 of "123456789" is cbf43926.
    #[test]
    fn a_change_is_seen_and_a_piece_has_none() {
        assert_eq!(sealed(b"123456789}".to_vec()), b"123456789,\"sum\":\"cbf43926\"}\n");
        let line = sealed(b"{\"a\":1}".to_vec());
        assert_eq!((seal_of(&line), seal_of(&line[..line.len() - 1])), (Seal::Whole, Seal::Whole));
        for at in 0..line.len() - 1 {
            let mut changed = line.clone();
            changed[at] ^= 1;
            assert_ne!(seal_of(&changed), Seal::Whole, "{at}");
            assert_eq!(seal_of(&line[..at]), Seal::None, "{at}");
        }
        assert_eq!(seal_of(b"{\"a\":1}\n"), Seal::None);
        assert_eq!(seal_of(b""), Seal::None);
    }
}
