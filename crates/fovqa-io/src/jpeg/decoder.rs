//! Decodes a file's scans to the samples of its components.

use rayon::prelude::*;

use super::coverage::Coverage;
use super::error::{Result, damaged};
use super::frame_header::{BLOCK, Coding, Component, FrameHeader};
use super::head::{Head, Settings, declared_height};
use super::idct;
use super::intervals::Intervals;
use super::order::Order;
use super::quantisation::{COEFFICIENTS, Steps};
use super::scan::Scan;
use super::scan_header::ScanHeader;
use super::segments::marker;
use super::sequential::{Coefficients, impossible};
use super::standard_huffman;
use super::upsample::Plane;

/// The decoded components of a file.
#[derive(Debug)]
pub(super) struct Decoder {
    frame: FrameHeader,
    coverage: Coverage,
    /// The quantisation table of each component, as it was in its first scan.
    steps: Vec<Steps>,
    /// The coefficients of each component, block by block; used only for progressive files.
    coefficients: Vec<Vec<Coefficients>>,
    planes: Vec<Plane>,
}

/// Decodes all scans. The returned settings are those at the end of the file.
///
/// # Errors
/// When data is damaged or missing.
pub(super) fn decode(head: Head<'_>) -> Result<(Vec<Plane>, Settings)> {
    let Head { mut segments, frame, mut settings, scan } = head;
    let mut decoder = Decoder::new(frame);
    let mut scan = Some(scan);
    loop {
        if let Some(header) = scan.take() {
            let intervals = Intervals::read(segments.rest())?;
            segments.skip(intervals.length);
            decoder.scan(header, &mut settings, &intervals)?;
        }
        let segment = segments.next()?;
        match segment.marker {
            marker::SOS => scan = Some(segment.data),
            marker::EOI => break,
            marker::DNL => {
                if declared_height(segment) != Some(decoder.frame.height) {
                    return Err(damaged("it declares two different heights"));
                }
            }
            _ => settings.take(segment)?,
        }
    }
    decoder.coverage.check_complete()?;
    Ok((decoder.finish()?, settings))
}

fn plane(component: &Component) -> Plane {
    let (columns, rows) = component.blocks;
    let samples = vec![0; columns * rows * BLOCK * BLOCK];
    Plane { samples, stride: columns * BLOCK, size: component.size }
}

/// Computes the samples of a row of blocks.
fn draw(blocks: &[Coefficients], steps: &Steps, plane: &mut [u8], stride: usize) -> Result<()> {
    if idct::samples(blocks, steps, stride, plane) { Ok(()) } else { Err(impossible()) }
}

impl Decoder {
    fn new(frame: FrameHeader) -> Self {
        let coefficients = match frame.coding {
            Coding::Sequential => Vec::new(),
            Coding::Progressive => {
                let blocks = frame.components.iter().map(|c| c.blocks.0 * c.blocks.1);
                blocks.map(|count| vec![[0; COEFFICIENTS]; count]).collect()
            }
        };
        // The samples of progressive files are computed after the last scan.
        let planes = match frame.coding {
            Coding::Sequential => frame.components.iter().map(plane).collect(),
            Coding::Progressive => Vec::new(),
        };
        let coverage = Coverage::new(&frame);
        let steps = vec![[0; COEFFICIENTS]; frame.components.len()];
        Self { frame, coverage, steps, coefficients, planes }
    }

    fn scan(&mut self, header: &[u8], settings: &mut Settings, data: &Intervals) -> Result<()> {
        let header = ScanHeader::parse(header, &self.frame)?;
        for component in &header.components {
            if !self.coverage.has_begun(component.index) {
                let number = self.frame.components[component.index].quantisation;
                let steps = settings.quantisation[number];
                self.steps[component.index] = steps.ok_or_else(|| {
                    damaged(format!(
                        "a component uses quantisation table {number}, which is missing"
                    ))
                })?;
            }
        }
        let coding = self.frame.coding;
        self.coverage.add(coding, &header)?;
        if coding == Coding::Sequential {
            standard_huffman::fill_in(&mut settings.huffman)?;
        }
        let order = Order::new(&self.frame, &header);
        let (tables, interval) = (&settings.huffman, settings.restart_interval);
        let scan = Scan::new(coding, &header, &order, tables, data, interval)?;
        match coding {
            Coding::Sequential => self.sequential(scan, &order),
            Coding::Progressive => self.progressive(scan, &order),
        }
    }

    /// Decodes a scan and converts its coefficients to samples, one row of units after the other.
    fn sequential(&mut self, mut scan: Scan<'_>, order: &Order) -> Result<()> {
        let blocks_of_row = order.shares.iter().map(|share| share.within.0 * share.blocks.1);
        let mut strips: Vec<Vec<Coefficients>> =
            blocks_of_row.map(|count| vec![[0; COEFFICIENTS]; count]).collect();
        for y in 0..order.units.1 {
            for strip in &mut strips {
                strip.fill([0; COEFFICIENTS]);
            }
            let mut rows: Vec<&mut [Coefficients]> =
                strips.iter_mut().map(Vec::as_mut_slice).collect();
            scan.row(y, &mut rows)?;
            for (strip, share) in strips.iter().zip(&order.shares) {
                let plane = &mut self.planes[share.component];
                let stride = plane.stride;
                let rows = plane.samples.chunks_exact_mut(BLOCK * stride);
                let rows = rows.skip(y * share.blocks.1).take(share.blocks.1);
                for (samples, blocks) in rows.zip(strip.chunks_exact(share.within.0)) {
                    draw(blocks, &self.steps[share.component], samples, stride)?;
                }
            }
        }
        scan.finish()
    }

    /// Decodes a scan and adds it to the coefficients of the earlier scans.
    fn progressive(&mut self, mut scan: Scan<'_>, order: &Order) -> Result<()> {
        for y in 0..order.units.1 {
            let mut of_component: Vec<_> = self.coefficients.iter_mut().map(Some).collect();
            let mut rows = Vec::with_capacity(order.shares.len());
            for share in &order.shares {
                let blocks = of_component[share.component].take();
                let Some(blocks) = blocks else { unreachable!("components of a scan differ") };
                let row = share.within.0 * share.blocks.1;
                let from = (y * row).min(blocks.len());
                let to = ((y + 1) * row).min(blocks.len());
                rows.push(&mut blocks[from..to]);
            }
            scan.row(y, &mut rows)?;
        }
        scan.finish()
    }

    /// Returns the samples of all components.
    fn finish(mut self) -> Result<Vec<Plane>> {
        for ((component, blocks), steps) in self
            .frame
            .components
            .iter()
            .zip(std::mem::take(&mut self.coefficients))
            .zip(&self.steps)
        {
            let mut plane = plane(component);
            let stride = plane.stride;
            let rows = plane.samples.par_chunks_exact_mut(BLOCK * stride);
            rows.zip(blocks.par_chunks_exact(component.blocks.0))
                .try_for_each(|(samples, blocks)| draw(blocks, steps, samples, stride))?;
            self.planes.push(plane);
        }
        Ok(self.planes)
    }
}
