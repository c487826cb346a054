//! Whether the memory of this machine holds what a view needs: foreseen by arithmetic, since what the
//! operating system does when it runs out is end the program without a word.

use std::fs;

use fovqa_config::Plan;
use fovqa_metrics::Metric;
use fovqa_results::Failure;

use crate::assemble::whole;
use crate::find::FoundView;
use crate::timing::timings;

/// Bytes of a pixel of a plane of 32-bit floats.
const PLANE: u64 = 4;

/// Bytes of a pixel of a decoded frame, at least: 8-bit red, green and blue.
const DECODED: u64 = 3;

/// A pyramid has 1 + 1/4 + 1/16 + … of the pixels of its finest level, which is counted by itself.
const COARSER_LEVELS: f64 = 1.0 / 3.0;

/// The least that a view needs, bytes, and what most of it is for.
#[derive(Debug, Clone, PartialEq)]
struct Need {
    bytes: u64,
    /// How many frames the temporal window of FovVideoVDP holds; 0 where there is none.
    window: usize,
}

impl Need {
    /// Of frames of so many pixels. `methods` are compared with one reference; `window` is how many
    /// frames FovVideoVDP looks back over, 1 in a still; `atd` whether differences over time are taken.
    fn of(pixels: u64, methods: usize, window: Option<usize>, atd: bool) -> Self {
        // Reference and test, and with several pairs the next one, which is decoded meanwhile.
        let mut bytes_per_pixel = (2 * DECODED) as f64;
        let planes = |count: usize| (PLANE * count as u64) as f64;
        if let Some(window) = window {
            bytes_per_pixel += planes(window * (1 + methods));
            // Sustained and transient channels of both; a still is its own channel.
            let channels = if window > 1 { 4 } else { 2 };
            let filtered = if window > 1 { planes(channels) } else { 0.0 };
            bytes_per_pixel += filtered + planes(channels) * COARSER_LEVELS;
        }
        if atd {
            // The luma of the frame before, of the reference and of each method.
            bytes_per_pixel += planes(1 + methods);
        }
        let bytes = (pixels as f64 * bytes_per_pixel) as u64;
        Self { bytes, window: window.filter(|window| *window > 1).unwrap_or(0) }
    }
}

/// Why a view cannot be scored on this machine, if so. `size` is that of the frames after any crop.
pub(crate) fn shortage(
    plan: &Plan,
    view: &FoundView,
    metrics: &[Metric],
    size: (usize, usize),
    fps: Option<f64>,
) -> Option<Failure> {
    let timings = || timings(view, fps, &plan.params.fvvdp).ok();
    let reach = |timings: &std::collections::BTreeMap<usize, crate::timing::Timing>| {
        let reaches = timings.values().map(|timing| {
            let reach = timing.time.as_ref().map_or(1, fovqa_metrics::fvvdp::Time::reach);
            reach.min(timing.frames.len())
        });
        reaches.max().unwrap_or(1)
    };
    let wants = |metric| metrics.contains(&metric);
    let window = wants(Metric::Fvvdp).then(|| timings().as_ref().map_or(1, reach));
    let methods = view.frames.iter().map(|frame| frame.tests.len()).max().unwrap_or(0);
    let pixels = (size.0 as u64).saturating_mul(size.1 as u64);
    let need = Need::of(pixels, methods, window, wants(Metric::Atd));
    refusal(&need, size, methods, available_bytes()?)
}

fn refusal(
    need: &Need,
    (width, height): (usize, usize),
    methods: usize,
    available: u64,
) -> Option<Failure> {
    if need.bytes <= available {
        return None;
    }
    let gigabytes = |bytes: u64| bytes as f64 / 1e9;
    let why = match need.window {
        0 => String::new(),
        window => {
            let tests =
                if methods == 1 { "the test".to_owned() } else { format!("{methods} tests") };
            format!(": FovVideoVDP keeps {window} frames of the reference and of {tests}")
        }
    };
    let message = format!(
        "frames of {width}x{height} need at least {:.1} GB of memory, and {:.1} GB are free{why}",
        gigabytes(need.bytes),
        gigabytes(available)
    );
    let help = match need.window {
        0 => "score a part of the frame at a time with {crop}, or fewer {metrics}".to_owned(),
        _ => "leave fvvdp out of {metrics}, score a part of the frame at a time with {crop}, every second \
              frame with {frames}:2, or fewer methods in a run"
            .to_owned(),
    };
    Some(whole(message, help))
}

/// Memory that this process can still have, bytes: what Linux says, with its swap, or what is left of
/// the process' control group. `None` elsewhere.
fn available_bytes() -> Option<u64> {
    let machine = fs::read_to_string("/proc/meminfo").ok().and_then(|text| of_meminfo(&text))?;
    let group = || {
        let limit = fs::read_to_string("/sys/fs/cgroup/memory.max").ok()?;
        let used = fs::read_to_string("/sys/fs/cgroup/memory.stat").ok()?;
        of_control_group(&limit, &used)
    };
    Some(group().map_or(machine, |group| group.min(machine)))
}

/// MemAvailable and SwapFree together.
fn of_meminfo(text: &str) -> Option<u64> {
    let value = |name: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
        line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
    };
    Some(value("MemAvailable")?.saturating_add(value("SwapFree").unwrap_or(0)))
}

/// The limit, less what cannot be given back: pages of files can.
fn of_control_group(limit: &str, statistics: &str) -> Option<u64> {
    // "max" is no limit.
    let limit: u64 = limit.trim().parse().ok()?;
    let used = statistics.lines().find_map(|line| line.strip_prefix("anon "))?;
    Some(limit.saturating_sub(used.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_system_says_is_read() {
        let text = "MemTotal:       24000000 kB\nMemAvailable:    1000 kB\nSwapFree:  24 kB\n";
        assert_eq!(of_meminfo(text), Some(1_048_576));
        assert_eq!(of_meminfo("MemAvailable:    1000 kB\n"), Some(1_024_000));
        assert_eq!(of_meminfo("MemAvailable: many\n"), None);
        assert_eq!(of_control_group("max\n", "anon 5\n"), None);
        assert_eq!(of_control_group("100\n", "anon 30\nfile 60\n"), Some(70));
        assert_eq!(of_control_group("100\n", "anon 300\n"), Some(0));
    }

    /// The retinal resolution of the papers at 90 Hz: 23 frames of reference and test alone are 13.7 GB.
    #[test]
    fn a_retinal_sequence_needs_its_window() {
        let pixels = 11_520 * 6480;
        let sequence = Need::of(pixels, 1, Some(23), false);
        assert!((13.7e9..17e9).contains(&(sequence.bytes as f64)), "{sequence:?}");
        let still = Need::of(pixels, 1, Some(1), false);
        assert!((1e9..2e9).contains(&(still.bytes as f64)), "{still:?}");
        assert!(Need::of(pixels, 1, None, false).bytes < still.bytes);
        let both = Need::of(pixels, 3, Some(23), true);
        assert!(both.bytes > 3 * sequence.bytes / 2);
    }

    #[test]
    fn a_shortage_says_what_helps() {
        let need = Need::of(11_520 * 6480, 1, Some(23), false);
        assert_eq!(refusal(&need, (11_520, 6480), 1, need.bytes), None);
        let failure = refusal(&need, (11_520, 6480), 1, 8_000_000_000).unwrap();
        for words in
            ["11520x6480", "at least 15.", "8.0 GB", "23 frames of the reference and of the test"]
        {
            assert!(failure.message.contains(words), "{}", failure.message);
        }
        assert!(failure.help.contains("{crop}") && failure.help.contains("fvvdp"));
        let plain = refusal(&Need::of(100, 1, None, false), (10, 10), 1, 1).unwrap();
        assert!(!plain.message.contains("FovVideoVDP") && plain.help.contains("{metrics}"));
    }
}
