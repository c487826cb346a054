//! Combines the components to the samples of the image.

use rayon::prelude::*;

use super::colour::Colours;
use super::frame_header::FrameHeader;
use super::upsample::{Plane, Upsampled};

/// The number of rows that one task combines.
const ROWS: usize = 16;

/// The image as gray samples or interleaved RGB.
pub(super) fn compose(frame: &FrameHeader, planes: &[Plane], colours: Colours) -> Vec<u8> {
    let width = frame.width;
    let components: Vec<Upsampled<'_>> = frame
        .components
        .iter()
        .zip(planes)
        .map(|(component, plane)| {
            let (h, v) = component.factors;
            Upsampled::new(plane, (frame.largest.0 / h, frame.largest.1 / v))
        })
        .collect();
    let pixel = if colours == Colours::Gray { 1 } else { 3 };
    let mut samples = vec![0; width * frame.height * pixel];
    samples.par_chunks_mut(width * pixel * ROWS).enumerate().for_each(|(band, out)| {
        let mut rows = vec![vec![0; width]; components.len()];
        let mut sums = Vec::new();
        for (y, out) in (band * ROWS..).zip(out.chunks_exact_mut(width * pixel)) {
            if let [gray] = components.as_slice() {
                gray.row(y, &mut sums, out);
                continue;
            }
            for (row, component) in rows.iter_mut().zip(&components) {
                component.row(y, &mut sums, row);
            }
            colours.convert(&rows, out);
        }
    });
    samples
}
