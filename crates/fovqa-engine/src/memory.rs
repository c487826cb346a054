//! Estimates whether a view's frames fit into memory, before any of them is read.
//!
//! A failed allocation ends the process. The table gives lower bounds of the memory that is in use at
//! the same time, for frames of `n` pixels, so that no view is refused that would have fitted:
//!
//! | used by | bytes |
//! | --- | --- |
//! | decoded frames | 6 n for a pair of 8-bit RGB, 12 n for half floats; in a sequence also for the next pair |
//! | FovVideoVDP | luminance, 4 n for each image |
//! | FovVideoVDP over time | 4 n for each frame of its window (0.25 s), once for the reference and once for each method; 16 n for the filtered channels of both |
//! | FovVideoVDP of several methods | 16/3 n, and 32/3 n for each channel of the reference |
//! | FovVideoVDP's pyramids | 5/4 n for each channel of reference and test: two levels at a time |
//! | temporal metrics | luma, 4 n for this frame of reference and test, and for each frame before it that is compared, of the reference and of each method |
//! | emulation | 24 n for the picture of the reference and that of a test, and 12 n for each temporal filter |
//! | reprojection | the decoded frames of the dominant eye, 24 n for its pictures, and 12 n for each temporal filter |
//! | maps | 4 n for the values of each map (n for GMSD), and 3 n for a picture of one |
//! | MS-SSIM | 3 n for the second level of both images |
//!
//! Data that is kept row by row, or in bands of rows, is not counted.

use std::collections::BTreeMap;

use fovqa_io::ReadOptions;
use fovqa_metrics::{Metric, MetricKind};
use fovqa_plan::Plan;

use crate::available_memory::available_bytes;
use crate::error::EngineError;
use crate::found::FoundView;
use crate::needed_memory::{FVVDP, Needed, gigabytes};
use crate::timing::timings;

/// The quantities that the memory estimate depends on.
#[derive(Debug, Clone, Copy)]
struct Amount<'a> {
    /// Number of pixels of a file, and of the crop that is scored.
    pixels: [u64; 2],
    /// Bytes per pixel of a decoded file.
    pixel_bytes: u64,
    frames: u64,
    methods: u64,
    metrics: &'a [Metric],
    /// Number of frames in the window of FovVideoVDP's temporal filters; 1 for still images.
    window: u64,
    /// The most frames that a temporal metric compares, the present one included; 0 if there is none.
    compared: u64,
    /// Whether maps are requested.
    maps: bool,
    /// Number of emulated methods, and of those with a temporal filter.
    emulated: [u64; 2],
    /// The same of methods that take from the frames of the dominant eye, and of their filters there.
    reprojected: [u64; 2],
}

impl Amount<'_> {
    fn needed(&self) -> Needed {
        let has = |metric| self.metrics.contains(&metric);
        let [file, pixels] = self.pixels;
        let pairs = if self.frames > 1 { 2 } else { 1 };
        let decoded = file.saturating_mul(2 * pairs * self.pixel_bytes);
        let planes = |planes: u64| pixels.saturating_mul(4 * planes);
        let fvvdp = if has(Metric::Fvvdp) {
            let held = self.window.min(self.frames).max(1);
            let (filtered, channels) = if self.window > 1 { (4, 2) } else { (0, 1) };
            let kept = if self.methods > 1 { (1 + 2 * channels) * 16 / 3 } else { 0 };
            let pyramids = 2 * channels * 5 / 4;
            planes(held * (1 + self.methods) + filtered)
                .saturating_add(pixels.saturating_mul(kept + pyramids))
        } else {
            0
        };
        let of = |metric, bytes| if has(metric) { bytes } else { 0 };
        let before = self.compared.min(self.frames).saturating_sub(1);
        let temporal = if before > 0 { planes(2 + before * (1 + self.methods)) } else { 0 };
        // Metrics with a common map share its memory.
        let maps = self.metrics.iter().flat_map(|metric| metric.info().maps());
        let maps: BTreeMap<&str, u64> =
            maps.map(|map| (map.name, pixels / (map.block * map.block) as u64 * 4)).collect();
        let maps = if self.maps { maps.into_values().sum::<u64>() + 3 * pixels } else { 0 };
        let [emulated, filtered] = self.emulated;
        let emulation = if emulated > 0 { planes(6 + 3 * filtered) } else { 0 };
        let [reprojected, filtered] = self.reprojected;
        let reprojection = if reprojected > 0 {
            file.saturating_mul(pairs * self.pixel_bytes).saturating_add(planes(6 + 3 * filtered))
        } else {
            0
        };
        Needed(vec![
            ("decoded frames", decoded),
            ("emulation", emulation),
            ("reprojection", reprojection),
            ("maps", maps),
            (FVVDP, fvvdp),
            ("temporal metrics", temporal),
            ("MS-SSIM", of(Metric::MsSsim, pixels.saturating_mul(3))),
        ])
    }
}

/// If a view needs more bytes than this, a message says so before its first frame is read.
const ANNOUNCED: u64 = 4_000_000_000;

/// The message about a view that needs much memory.
fn announcement((width, height): (usize, usize), needed: &Needed) -> Option<String> {
    let bytes = needed.bytes();
    (bytes > ANNOUNCED).then(|| {
        let all = gigabytes(bytes);
        format!("frames of {width}x{height} pixels will take at least {all} of memory ({needed})")
    })
}

/// Refuses a view whose frames cannot fit into memory. If the size of the frames or the available
/// memory is unknown, the view is accepted. Returns a message if the view needs much memory.
///
/// # Errors
/// [`EngineError::Memory`].
pub(crate) fn check(
    plan: &Plan,
    view: &FoundView,
    metrics: &[Metric],
) -> Result<Option<String>, EngineError> {
    let settings = &plan.scenes[view.scene].eyes[view.eye].settings;
    let Some(first) = view.frames.first() else { return Ok(None) };
    let reference = &view.sources.reference;
    let Ok((width, height)) = reference.size(first.reference) else { return Ok(None) };
    let file = (width as u64).saturating_mul(height as u64);
    if !is_read(&settings.read, file) {
        return Ok(None);
    }
    let crop = settings.crop.map(|crop| (crop.width as u64).saturating_mul(crop.height as u64));
    let timings = timings(view, view.fps, &plan.params.fvvdp).unwrap_or_default();
    let windows = timings.values().filter_map(|timing| Some(timing.time.as_ref().ok()?.reach()));
    let temporal = metrics.iter().filter(|metric| metric.is(MetricKind::Temporal));
    let compared = temporal.map(|metric| plan.params.frames_needed(*metric));
    let taken = || view.sources.emulations().filter_map(|(_, of)| of.reproject());
    let amount = Amount {
        pixels: [file, crop.unwrap_or(file).min(file)],
        pixel_bytes: reference.bytes_per_pixel(),
        frames: view.frames.len() as u64,
        methods: timings.len().max(1) as u64,
        metrics,
        window: windows.max().unwrap_or(1) as u64,
        compared: compared.max().unwrap_or(0) as u64,
        maps: plan.maps || !plan.pictures.is_empty(),
        emulated: [
            view.sources.emulations().count() as u64,
            view.sources.emulations().filter(|(_, of)| of.spec.is_temporal()).count() as u64,
        ],
        reprojected: [
            taken().count() as u64,
            taken().filter(|reproject| reproject.spec.is_temporal()).count() as u64,
        ],
    };
    let needed = amount.needed();
    match available_bytes() {
        Some(available) if needed.bytes() > available => {
            Err(EngineError::Memory { size: (width, height), needed, available })
        }
        _ => Ok(announcement((width, height), &needed)),
    }
}

/// Whether the limit on the file size allows the file to be read.
fn is_read(read: &ReadOptions, pixels: u64) -> bool {
    pixels <= read.max_megapixels.saturating_mul(1_000_000)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RETINAL: u64 = 11_520 * 6480;

    fn amount(metrics: &[Metric]) -> Amount<'_> {
        Amount {
            pixels: [RETINAL; 2],
            pixel_bytes: 3,
            frames: 100,
            methods: 1,
            metrics,
            window: 23,
            compared: 0,
            maps: false,
            emulated: [0; 2],
            reprojected: [0; 2],
        }
    }

    /// The window has 23 frames of 299 MB, for reference and test, plus the filtered channels.
    #[test]
    fn a_window_of_retinal_frames_takes_as_much_as_was_measured() {
        let bytes = amount(&[Metric::Fvvdp]).needed().bytes();
        assert!((14_000_000_000..17_000_000_000).contains(&bytes), "{bytes}");
        let short = Amount { frames: 2, ..amount(&[Metric::Fvvdp]) }.needed();
        assert!(short.bytes() < 5_000_000_000, "{short}");
        let still = Amount { frames: 1, window: 1, ..amount(&[Metric::Fvvdp]) }.needed();
        assert!((1_000_000_000..1_500_000_000).contains(&still.bytes()), "{still}");
    }

    #[test]
    fn what_takes_much_memory_is_announced() {
        let said = |amount: Amount<'_>| announcement((11_520, 6480), &amount.needed());
        let window = said(amount(&[Metric::Fvvdp])).unwrap();
        let all = amount(&[Metric::Fvvdp]).needed().bytes() as f64 / 1e9;
        assert!(window.contains("11520x6480") && window.contains(&format!("{all:.1} GB")));
        assert!(window.contains("decoded frames 0.9 GB, FovVideoVDP 1"), "{window}");
        let still = Amount { frames: 1, window: 1, ..amount(&[Metric::Fvvdp]) };
        assert_eq!(said(still), None);
        assert_eq!(said(amount(&[Metric::Psnr, Metric::Ssim, Metric::Haar])), None);
    }

    #[test]
    fn each_metric_adds_what_it_holds() {
        let of = |metrics: &[Metric]| amount(metrics).needed().bytes() / RETINAL;
        let frames = of(&[Metric::Psnr, Metric::Ssim, Metric::Haar]);
        assert_eq!(frames, 12, "the pair and the next one");
        let over_time = |compared| Amount { compared, ..amount(&[Metric::Atd]) }.needed().bytes();
        assert_eq!(over_time(2) / RETINAL - frames, 16);
        assert_eq!(over_time(8) / RETINAL - frames, 4 * (2 + 7 + 7));
        assert_eq!(of(&[Metric::PuPsnr]), frames, "its luminance is made row by row");
        assert_eq!(of(&[Metric::MsSsim]) - frames, 3);
        assert_eq!(of(&[Metric::Fvvdp, Metric::PuPsnr]), of(&[Metric::Fvvdp]));
        let metrics = [Metric::Mse, Metric::Psnr, Metric::Ssim];
        let maps = Amount { maps: true, ..amount(&metrics) }.needed().bytes() / RETINAL;
        assert_eq!(maps - of(&metrics), 8 + 3, "MSE and PSNR have one map");
        let crop = Amount { pixels: [RETINAL, 1000], ..amount(&[Metric::Fvvdp]) }.needed();
        assert!(crop.bytes() < RETINAL * 12 + 1_000_000, "{crop}");
        let emulated = Amount { emulated: [5, 1], ..amount(&metrics) }.needed().bytes() / RETINAL;
        assert_eq!(emulated - of(&metrics), 24 + 12, "one test at a time, and one history");
        let reprojected = Amount { reprojected: [2, 1], ..amount(&metrics) }.needed();
        assert_eq!(
            reprojected.bytes() / RETINAL - of(&metrics),
            6 + 24 + 12,
            "two frames of the other eye"
        );
        let several = Amount { methods: 3, ..amount(&[Metric::Fvvdp]) }.needed();
        assert!(several.bytes() > 2 * 13_000_000_000 && several.is_of_fvvdp(), "{several}");
    }
}
