//! The entropy-coded data of a scan, split at its restart markers.

use super::error::{Result, damaged};
use super::segments::marker;

/// Data without stuffed zeros, split into the intervals between restart markers.
#[derive(Debug)]
pub(super) struct Intervals {
    bytes: Vec<u8>,
    /// The end of each interval.
    ends: Vec<usize>,
    /// The number of bytes in the file up to the next other marker.
    pub(super) length: usize,
}

impl Intervals {
    /// Reads up to the next marker that is not a restart marker.
    ///
    /// # Errors
    /// When there is none, or restart markers are out of order.
    pub(super) fn read(data: &[u8]) -> Result<Self> {
        let mut intervals = Self { bytes: Vec::new(), ends: Vec::new(), length: 0 };
        let mut at = 0;
        loop {
            let missing = || damaged("its end-of-image marker is missing");
            let plain = data[at..].iter().position(|byte| *byte == 0xff).ok_or_else(missing)?;
            intervals.bytes.extend_from_slice(&data[at..at + plain]);
            at += plain;
            let fill = data[at..].iter().position(|byte| *byte != 0xff).ok_or_else(missing)?;
            match data[at + fill] {
                0 if fill == 1 => intervals.bytes.push(0xff),
                0 => {
                    return Err(damaged("its entropy-coded data contains bytes without a meaning"));
                }
                restart @ marker::RST0..=marker::RST7 => {
                    let expected = marker::RST0 + (intervals.ends.len() % 8) as u8;
                    if restart != expected {
                        return Err(damaged(format!(
                            "restart marker {} is where {} should be",
                            restart - marker::RST0,
                            expected - marker::RST0
                        )));
                    }
                    intervals.ends.push(intervals.bytes.len());
                }
                _ => break,
            }
            at += fill + 1;
        }
        intervals.ends.push(intervals.bytes.len());
        intervals.length = at;
        Ok(intervals)
    }

    /// The data of the intervals, of which there must be exactly `count`.
    ///
    /// # Errors
    /// When there are more or fewer.
    pub(super) fn exactly(&self, count: usize) -> Result<impl Iterator<Item = &[u8]>> {
        let found = self.ends.len();
        let from = |i: usize| if i == 0 { 0 } else { self.ends[i - 1] };
        // Some encoders write a restart marker after the last interval too.
        let one_too_many = found == count + 1 && from(count) == self.ends[count];
        if found != count && !one_too_many {
            return Err(damaged(format!(
                "a scan has {found} restart intervals, but its size needs {count}"
            )));
        }
        Ok((0..count).map(move |i| &self.bytes[from(i)..self.ends[i]]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_and_markers_are_taken_out() {
        let data = [1, 0xff, 0, 2, 0xff, 0xff, 0xd0, 3, 0xff, 0xd1, 0xff, 0xd9, 7];
        let found = Intervals::read(&data).unwrap();
        assert_eq!(found.length, 10);
        let stretches: Vec<&[u8]> = found.exactly(3).unwrap().collect();
        assert_eq!(stretches, [&[1, 0xff, 2][..], &[3], &[]]);
        assert_eq!(found.exactly(2).unwrap().count(), 2, "a marker behind the last is no harm");
        assert!(found.exactly(1).is_err() && found.exactly(4).is_err());
    }

    #[test]
    fn malformed_data_is_refused() {
        for data in [
            &[1, 2, 3][..],
            &[1, 0xff],
            &[1, 0xff, 0xff],
            &[1, 0xff, 0xd1, 2, 0xff, 0xd9],
            &[1, 0xff, 0xff, 0, 2, 0xff, 0xd9],
        ] {
            assert!(Intervals::read(data).is_err(), "{data:?}");
        }
    }
}
