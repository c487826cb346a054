//! The scan header (ITU-T T.81, B.2.3): the components of the scan and the part of their
//! coefficients that it codes.

use super::error::{Result, damaged};
use super::frame_header::{Coding, FrameHeader};

/// One component of a scan, by its index in the frame, and its Huffman tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ScanComponent {
    pub(super) index: usize,
    pub(super) dc: usize,
    pub(super) ac: usize,
}

/// The content of a scan header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ScanHeader {
    pub(super) components: Vec<ScanComponent>,
    /// First and last coefficient, in zigzag order.
    pub(super) from: usize,
    pub(super) to: usize,
    /// The lowest bit of earlier scans; 0 if this is the first scan.
    pub(super) high: u8,
    /// The lowest bit of this scan.
    pub(super) low: u8,
}

/// The largest number of blocks that one unit of an interleaved scan may have.
const MOST_BLOCKS: usize = 10;

impl ScanHeader {
    /// Reads the header of a scan of this frame.
    ///
    /// # Errors
    /// When it names components that the frame does not have, or values that its coding does not
    /// allow.
    pub(super) fn parse(data: &[u8], frame: &FrameHeader) -> Result<Self> {
        let count = usize::from(*data.first().unwrap_or(&0));
        let (1..=4, true) = (count, data.len() == 4 + 2 * count) else {
            return Err(damaged("a scan header has a wrong length"));
        };
        let mut components: Vec<ScanComponent> = Vec::with_capacity(count);
        for bytes in data[1..=2 * count].as_chunks::<2>().0 {
            let (id, dc, ac) = (bytes[0], usize::from(bytes[1] >> 4), usize::from(bytes[1] & 15));
            let free = |index: &usize| components.iter().all(|c| c.index != *index);
            let mut named = (0..frame.components.len()).filter(|i| frame.components[*i].id == id);
            let index = named.find(free).ok_or_else(|| {
                damaged(format!("a scan names component {id}, which its frame does not have"))
            })?;
            components.push(ScanComponent { index, dc, ac });
        }
        let [from, to, bits] = data[1 + 2 * count..] else { unreachable!("three bytes are left") };
        let (from, to) = (usize::from(from), usize::from(to));
        let scan = Self { components, from, to, high: bits >> 4, low: bits & 15 };
        scan.check(frame)
    }

    fn check(mut self, frame: &FrameHeader) -> Result<Self> {
        let wrong = |what: &str| Err(damaged(format!("a scan header declares {what}")));
        if self.components.len() > 1 {
            let blocks = |c: &ScanComponent| {
                let (h, v) = frame.components[c.index].factors;
                h * v
            };
            if self.components.iter().map(blocks).sum::<usize>() > MOST_BLOCKS {
                return wrong("more than 10 blocks per unit");
            }
        }
        match frame.coding {
            Coding::Sequential => {
                // Some encoders write zeros here, which have no meaning in a sequential frame.
                if self.to == 0 {
                    self.to = 63;
                }
                if (self.from, self.to, self.high, self.low) != (0, 63, 0, 0) {
                    return wrong("a part of the coefficients, in a sequential frame");
                }
            }
            Coding::Progressive => {
                if self.from > self.to || self.to > 63 || (self.from == 0 && self.to > 0) {
                    return wrong("a range of coefficients that does not exist");
                }
                if self.from > 0 && self.components.len() > 1 {
                    return wrong("AC coefficients of several components at once");
                }
                if self.low > 13 || (self.high > 0 && self.high != self.low + 1) {
                    return wrong("bits out of order");
                }
            }
        }
        Ok(self)
    }
}
