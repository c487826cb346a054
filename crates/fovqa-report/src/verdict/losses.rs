//! Where a loss is, in words.

use std::fmt::Write as _;

use fovqa_results::{BandRecord, CheckRecord, LossRecord, statistic_name};

use super::digits::{beside, number};

/// Frames that a text names; of more, it says how many there are.
const MOST_FRAMES: usize = 8;

/// The frames that violate a rule per frame, the worst first; `None` if there are none.
pub(super) fn frames(check: &CheckRecord) -> Option<String> {
    if check.frames.is_empty() {
        return None;
    }
    let shown = check.frames.iter().take(MOST_FRAMES).map(|frame| {
        let [value, limit] = beside(frame.value.0, frame.limit.0);
        format!("{} ({value}, limit {limit})", frame.frame)
    });
    let mut text = format!("frames that fail: {}", shown.collect::<Vec<_>>().join(", "));
    if check.frames.len() > MOST_FRAMES {
        let _ = write!(text, " and {} more", check.frames.len() - MOST_FRAMES);
    }
    Some(text)
}

/// The frame with a loss, its band and its place in one sentence.
pub(crate) fn place(check: &CheckRecord, loss: &LossRecord) -> String {
    let mut text = format!("frame {}", loss.frame);
    if loss.eye != check.eye {
        let _ = write!(text, " of the {} eye", loss.eye);
    }
    let before = loss.before.map(|before| before.0);
    let name = statistic_name(&loss.metric, &loss.statistic);
    let _ = write!(text, ": {name} {}", compared(loss.value.0, before, &loss.compared));
    if let Some(band) = &loss.band {
        let _ = write!(text, "; of the bands, most is lost in {}", in_band(band));
    }
    if let Some(place) = &loss.place {
        let _ = write!(text, "; the worst place is {:.0}, {:.0} px", place.x_px, place.y_px);
        if let Some(degrees) = place.eccentricity_deg {
            let _ = write!(text, ", {degrees:.1}° from the gaze");
        }
        let _ = write!(text, " (map {}{})", place.map, against(&place.compared));
    }
    text
}

/// Whether the frame with a loss is named by another metric than that of the rule, and why.
pub(super) fn late(check: &CheckRecord) -> Option<&'static str> {
    let of_fvvdp = check.reason.as_deref().is_some_and(|reason| reason.contains("fvvdp"));
    let first = check.losses.first().filter(|_| of_fvvdp)?;
    Some(if first.metric == "fvvdp" {
        "FovVideoVDP shows a loss up to a quarter of a second late: the loss may be in an earlier frame; \
         score psnr or ssim too, which tell the frame"
    } else {
        "FovVideoVDP shows a loss up to a quarter of a second late: the frame is the one whose own \
         difference from the reference grew most"
    })
}

fn in_band(band: &BandRecord) -> String {
    let before = band.before.map(|before| before.0);
    let value = compared(band.value.0, before, &band.compared);
    format!("{}° to {}° ({} {value})", band.from_deg, band.to_deg, band.metric)
}

/// A value with the one that it is compared with.
fn compared(value: f64, before: Option<f64>, how: &str) -> String {
    let Some(before) = before else { return number(value) };
    let [value, before] = beside(value, before);
    match how {
        "baseline" => format!("{value}, in the baseline {before}"),
        _ => format!("{value}, beside it {before}"),
    }
}

fn against(compared: &str) -> &'static str {
    match compared {
        "baseline" => ", compared with the baseline",
        "neighbours" => ", compared with the frames beside it",
        _ => " of this build alone",
    }
}
