//! Decoding one scan: its units, row by row, and its restart intervals.

use super::bits::Bits;
use super::error::{Result, damaged};
use super::frame_header::Coding;
use super::huffman::{Huffman, Tables};
use super::intervals::Intervals;
use super::order::Order;
use super::progressive::{self, Band};
use super::quantisation::COEFFICIENTS;
use super::scan_header::ScanHeader;
use super::sequential::{self, Coefficients};

/// The operation that a scan performs on a block.
#[derive(Debug, Clone, Copy)]
enum Step<'a> {
    Whole(&'a Huffman, &'a Huffman),
    Mean(&'a Huffman),
    RefineMean,
    First(&'a Huffman),
    Refine(&'a Huffman),
}

/// A scan while it is decoded.
pub(super) struct Scan<'a> {
    order: &'a Order,
    intervals: Box<dyn Iterator<Item = &'a [u8]> + 'a>,
    /// The operation for each component of the scan.
    steps: Vec<Step<'a>>,
    band: Band,
    interval: usize,
    /// The number of units left in the interval.
    left: usize,
    bits: Bits<'a>,
    /// The previous mean of each component of the scan.
    means: Vec<i32>,
    /// The number of blocks that have no further coefficients.
    run: u32,
}

impl<'a> Scan<'a> {
    /// Prepares a scan over `intervals`, each of `restart_interval` units; 0 means a single
    /// interval for all units.
    ///
    /// # Errors
    /// When a table or an interval is missing.
    pub(super) fn new(
        coding: Coding,
        header: &ScanHeader,
        order: &'a Order,
        tables: &'a Tables,
        intervals: &'a Intervals,
        restart_interval: usize,
    ) -> Result<Self> {
        let steps = header.components.iter().map(|component| -> Result<Step<'_>> {
            Ok(match (coding, header.from, header.high) {
                (Coding::Sequential, ..) => {
                    Step::Whole(tables.means(component.dc)?, tables.others(component.ac)?)
                }
                (_, 0, 0) => Step::Mean(tables.means(component.dc)?),
                (_, 0, _) => Step::RefineMean,
                (.., 0) => Step::First(tables.others(component.ac)?),
                _ => Step::Refine(tables.others(component.ac)?),
            })
        });
        let units = order.units.0 * order.units.1;
        let interval = if restart_interval == 0 { units } else { restart_interval };
        Ok(Self {
            order,
            intervals: Box::new(intervals.exactly(units.div_ceil(interval))?),
            steps: steps.collect::<Result<_>>()?,
            band: Band { from: header.from, to: header.to, low: header.low },
            interval,
            left: 0,
            bits: Bits::new(&[]),
            means: vec![0; header.components.len()],
            run: 0,
        })
    }

    /// Decodes row `y` of units into the blocks of each component of the scan, row by row.
    pub(super) fn row(&mut self, y: usize, blocks: &mut [&mut [Coefficients]]) -> Result<()> {
        let order = self.order;
        for x in 0..order.units.0 {
            if self.left == 0 {
                self.next_interval()?;
            }
            for (i, share) in order.shares.iter().enumerate() {
                let (across, down) = share.blocks;
                for v in 0..down {
                    for column in x * across..(x + 1) * across {
                        // Blocks beyond the edges are coded too, but not visible.
                        let seen = column < share.within.0 && y * down + v < share.within.1;
                        if seen {
                            self.decode(i, &mut blocks[i][v * share.within.0 + column])?;
                        } else {
                            self.decode(i, &mut [0; COEFFICIENTS])?;
                        }
                    }
                }
            }
            self.left -= 1;
        }
        Ok(())
    }

    #[inline(always)]
    fn decode(&mut self, component: usize, block: &mut Coefficients) -> Result<()> {
        let Self { bits, means, run, band, steps, .. } = self;
        let before = &mut means[component];
        match steps[component] {
            Step::Whole(dc, ac) => sequential::block(bits, dc, ac, before, block),
            Step::Mean(dc) => {
                block[0] = sequential::mean(bits, dc, before, band.low)?;
                bits.check()
            }
            Step::RefineMean => {
                if bits.bit() {
                    block[0] |= 1 << band.low;
                }
                bits.check()
            }
            Step::First(ac) => progressive::first(bits, ac, *band, run, block),
            Step::Refine(ac) => progressive::refine(bits, ac, *band, run, block),
        }
    }

    fn next_interval(&mut self) -> Result<()> {
        let next = self.intervals.next().unwrap_or(&[]);
        self.end_interval(Bits::new(next))?;
        self.means.fill(0);
        self.left = self.interval;
        Ok(())
    }

    fn end_interval(&mut self, next: Bits<'a>) -> Result<()> {
        if self.run > 0 {
            return Err(damaged("a run of blocks reaches beyond the end of its scan"));
        }
        std::mem::replace(&mut self.bits, next).finish()
    }

    /// Ends the scan.
    ///
    /// # Errors
    /// When the last interval has data left over.
    pub(super) fn finish(mut self) -> Result<()> {
        self.end_interval(Bits::new(&[]))
    }
}
