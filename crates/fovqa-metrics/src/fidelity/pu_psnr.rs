//! PU-PSNR: PSNR of perceptually uniform luminance (PU21; Mantiuk, Azimi 2021).
//!
//! V is the encoded luminance of what the display shows ([`fovqa_frame::transfer::pu21`]);
//! PU-PSNR = 20 log10(V(10,000 cd/m²) / sqrt(mean (V_t - V_r)²)) dB. Higher is better, infinite for
//! identical pictures.

use fovqa_frame::map_row_blocks;
use fovqa_frame::transfer::pu21;

use super::fvvdp::Grid;
use super::squared_error::psnr_db;
use crate::regions::Regions;
use crate::sums::add_by_band;

/// PU-PSNR of a test in dB, both given as luminance in cd/m², over the pixels that count; `None` where
/// none does.
///
/// # Panics
/// When planes and regions are not of one height.
pub fn pu_psnr_db(reference: &Grid, test: &Grid, regions: &Regions<'_>) -> Option<f64> {
    assert_eq!(reference.height(), test.height(), "planes of one size");
    assert_eq!(regions.rows(), test.height(), "regions of these planes");
    let encoder = pu21::Encoder::new();
    let blocks = map_row_blocks(test.height(), |rows| {
        let mut sums = vec![0.0; regions.bands() + 1];
        let mut squared = vec![0.0; test.width()];
        for y in rows {
            let pair = reference.row(y).iter().zip(test.row(y));
            for (squared, (reference, test)) in squared.iter_mut().zip(pair) {
                let difference = encoder.encode(*test) - encoder.encode(*reference);
                *squared = difference * difference;
            }
            add_by_band(&squared, 0, regions.pixel_runs(y), &mut sums);
        }
        sums.iter().sum::<f64>()
    });
    let pixels: u64 = regions.pixels().iter().sum();
    let mean = (pixels > 0).then(|| blocks.iter().sum::<f64>() / pixels as f64)?;
    let peak = pu21::encode(pu21::PEAK_CD_M2);
    Some(psnr_db(mean / (peak * peak)))
}
