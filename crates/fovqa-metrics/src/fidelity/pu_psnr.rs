//! PU-PSNR: PSNR of perceptually uniform luminance (PU21; Mantiuk, Azimi 2021).
//!
//! V is the encoded luminance that the display shows ([`fovqa_frame::transfer::pu21`]); PU-PSNR =
//! 20 log10(V(10,000 cd/m²) / sqrt(mean (V_t - V_r)²)) dB. Higher is better; it is infinite for
//! identical pictures.

use fovqa_frame::transfer::pu21;
use fovqa_frame::{Frame, LuminanceScratch, LuminanceTables, map_row_blocks};

use crate::decibels::psnr_db;
use crate::info::{MetricInfo, Needs};
use crate::metric::Metric;
use crate::pooling::{Parts, Pooling, Statistic};
use crate::regions::Regions;
use crate::row::{Key, Rows};
use crate::sums::add_by_band;

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "pu_psnr",
    label: "PU-PSNR",
    unit: "dB",
    needs: Needs { luminance: true, ..Needs::NOTHING },
    statistics: &[Statistic::VALUE.over_eyes(Pooling::Decibels).over_frames(Pooling::Decibels)],
    about: "PSNR of the display's luminance in perceptually uniform units (PU21)",
    source: "Mantiuk, Azimi 2021, banding and glare; as in FovVideoVDP 1.2",
    ..MetricInfo::FIDELITY
};

pub(crate) use crate::metric_params::NoParams as Params;

/// Adds PU-PSNR of a test in dB, both shown by the display of `tables`, over the pixels that count; nothing
/// is added if none counts. Luminance is made row by row: planes of it would take more memory than 8-bit frames.
///
/// # Panics
/// When frames and regions differ in height.
pub fn rows(
    reference: &Frame,
    test: &Frame,
    tables: &LuminanceTables,
    regions: &Regions<'_>,
    rows: &mut Rows,
) {
    let squared = squared_error([reference, test], tables, regions);
    let pixels = regions.pixels().iter().sum::<u64>() as f64;
    let peak = pu21::encode(pu21::PEAK_CD_M2);
    if pixels > 0.0 {
        let value = psnr_db(squared / pixels / (peak * peak));
        let parts = Parts::Mean { sum: squared / (peak * peak), weight: pixels };
        rows.push(Key::of(Metric::PuPsnr), Some(value), parts);
    }
}

/// The squared error of perceptually uniform values, over the pixels that count.
fn squared_error(frames: [&Frame; 2], tables: &LuminanceTables, regions: &Regions<'_>) -> f64 {
    let [(width, height), size] = frames.map(|frame| (frame.width(), frame.height()));
    assert_eq!((width, height), size, "frames of one size");
    assert_eq!(regions.rows(), height, "regions of these frames");
    let encoder = pu21::Encoder::new();
    let pictures = frames.map(|frame| tables.luminance(frame));
    let blocks = map_row_blocks(height, |rows| {
        let mut scratch = LuminanceScratch::new(width);
        let mut sums = vec![0.0; regions.bands() + 1];
        let mut luminance = [vec![0.0; width], vec![0.0; width]];
        let mut squared = vec![0.0; width];
        for y in rows {
            for (picture, row) in pictures.iter().zip(&mut luminance) {
                picture.fill(y, 0..width, &mut scratch, row);
            }
            let [reference, test] = &luminance;
            for (squared, (reference, test)) in squared.iter_mut().zip(reference.iter().zip(test)) {
                let difference = encoder.encode(*test) - encoder.encode(*reference);
                *squared = difference * difference;
            }
            add_by_band(&squared, 0, regions.pixel_runs(y), &mut sums);
        }
        sums.iter().sum::<f64>()
    });
    blocks.iter().sum()
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use fovqa_frame::{Channels, LinearInput, Mask, Samples, SignalParams};
    use fovqa_vision::BandMap;

    use super::*;

    /// PU-PSNR in dB.
    fn pu_psnr_db(reference: &Frame, test: &Frame, regions: &Regions<'_>) -> Option<f64> {
        let mut found = Rows::default();
        rows(reference, test, &tables(), regions, &mut found);
        found.value(Key::of(Metric::PuPsnr))
    }

    const W: usize = 70;
    const H: usize = 130;

    /// Shows values as cd/m².
    fn tables() -> LuminanceTables {
        let shown = fovqa_frame::DisplayRange {
            cd_m2_per_unit: 1.0,
            floor_cd_m2: 0.0,
            peak_cd_m2: 1e5,
            black_cd_m2: 0.0,
        };
        let light = LinearInput::Absolute(shown);
        LuminanceTables::new(SignalParams::default(), |v| v, light, [0.2, 0.7, 0.1])
    }

    /// A picture of this luminance, in cd/m².
    fn luminance(value: impl Fn(usize, usize) -> f32) -> Frame {
        let values = (0..W * H).map(|i| value(i % W, i / W)).collect();
        Frame::new(W, H, Channels::Gray, Samples::F32(values)).unwrap()
    }

    /// V of 1, 100 and 10,000 cd/m² (PU21, banding and glare).
    const V: [f64; 3] = [36.560_429_38, 256.417_341_13, 566.633_957_93];

    #[test]
    fn flat_pictures_are_as_far_apart_as_their_units() {
        let bands = BandMap::without_bands(W, H);
        let regions = Regions::unmasked(&bands);
        let (one, hundred) = (luminance(|_, _| 1.0), luminance(|_, _| 100.0));
        // The chords of the encoder are up to 2e-4 units off: of 220 units, this is 1e-5 dB.
        let wanted = 20.0 * (V[2] / (V[1] - V[0])).log10();
        let found = pu_psnr_db(&one, &hundred, &regions).unwrap();
        assert!((found - wanted).abs() < 2e-5, "{found} for {wanted}");
        assert_eq!(pu_psnr_db(&hundred, &one, &regions), Some(found));
        // A quarter of the pixels has the error, so the result is 6 dB better.
        let part = luminance(|x, y| if x % 2 == 0 && y % 2 == 0 { 100.0 } else { 1.0 });
        let found = pu_psnr_db(&one, &part, &regions).unwrap();
        assert!((found - wanted - 20.0 * 2f64.log10()).abs() < 2e-5, "{found}");
    }

    #[test]
    fn identical_pictures_are_infinitely_near() {
        let bands = BandMap::without_bands(W, H);
        let picture = luminance(|x, y| (1 + x * y % 97) as f32);
        let found = pu_psnr_db(&picture, &picture, &Regions::unmasked(&bands));
        assert_eq!(found, Some(f64::INFINITY));
        // Luminance above the range of the encoding is clamped, so that such values are equal.
        let (bright, brighter) = (luminance(|_, _| 1e4), luminance(|_, _| 5e4));
        let found = pu_psnr_db(&bright, &brighter, &Regions::unmasked(&bands));
        assert_eq!(found, Some(f64::INFINITY));
    }

    #[test]
    fn masked_pixels_are_left_out() {
        let bands = BandMap::without_bands(W, H);
        let inside = |x: usize, y: usize| (10..60).contains(&x) && (20..100).contains(&y);
        let valid = (0..W * H).map(|i| inside(i % W, i / W)).collect();
        let regions = Regions::masked(&bands, &Mask::new(W, H, valid).unwrap(), 0);
        let (one, hundred) = (luminance(|_, _| 1.0), luminance(|_, _| 100.0));
        let outside = luminance(|x, y| if inside(x, y) { 1.0 } else { 100.0 });
        assert_eq!(pu_psnr_db(&one, &outside, &regions), Some(f64::INFINITY));
        let wanted = 20.0 * (V[2] / (V[1] - V[0])).log10();
        let within = luminance(|x, y| if inside(x, y) { 100.0 } else { 7.0 });
        for test in [&within, &hundred] {
            let found = pu_psnr_db(&one, test, &regions).unwrap();
            assert!((found - wanted).abs() < 2e-5, "{found} for {wanted}");
        }
        let nothing = Mask::new(W, H, vec![false; W * H]).unwrap();
        assert_eq!(pu_psnr_db(&one, &hundred, &Regions::masked(&bands, &nothing, 0)), None);
    }
}
