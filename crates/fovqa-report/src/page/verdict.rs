//! The verdict of a gate, the first part of the page.

use std::fs;
use std::path::Path;

use fovqa_results::{CheckRecord, LossRecord, RuleRecord, VerdictRecord};

use super::address;
use super::figure::data_image;
use crate::verdict::{place_in_words, shown};

/// Frames with a loss whose pictures the page holds. Those of others are in the folder of the results.
const MOST_WITH_PICTURES: usize = 6;
/// Bytes of a picture; one of ours is much smaller.
const MOST_BYTES: u64 = 4 << 20;
/// Checks in the table. A gate may have many thousands.
const MOST_CHECKS: usize = 500;

/// The verdict as the page shows it.
pub(crate) struct PageVerdict {
    pub(super) state: String,
    pub(super) heading: String,
    pub(super) baseline: Option<String>,
    pub(super) checks: Vec<PageCheck>,
    pub(super) more_checks: usize,
    pub(super) failures: Vec<PageFailure>,
    /// Errors and remarks.
    pub(super) lines: Vec<String>,
}

/// A row of the table.
pub(super) struct PageCheck {
    pub(super) state: String,
    pub(super) rule: String,
    pub(super) of: String,
    pub(super) value: String,
    pub(super) limit: String,
    pub(super) margin: String,
    pub(super) frame: String,
}

/// A check that did not pass.
pub(super) struct PageFailure {
    pub(super) title: String,
    pub(super) reason: String,
    pub(super) losses: Vec<PageLoss>,
}

/// A frame with a loss.
pub(super) struct PageLoss {
    pub(super) text: String,
    pub(super) pictures: Vec<PagePicture>,
}

impl PageLoss {
    /// Whether the page holds a picture of it.
    pub(super) fn has_images(&self) -> bool {
        self.pictures.iter().any(|picture| picture.image.is_some())
    }
}

/// A picture of it.
pub(super) struct PagePicture {
    pub(super) what: String,
    pub(super) address: String,
    /// The picture itself; `None` beyond the first frames.
    pub(super) image: Option<String>,
}

impl PageVerdict {
    pub(crate) fn of(verdict: &VerdictRecord, folder: &Path) -> Self {
        let checks =
            || verdict.rules.iter().flat_map(|rule| rule.checks.iter().map(move |c| (rule, c)));
        // What did not pass comes first.
        let (mut rows, passed): (Vec<_>, Vec<_>) =
            checks().partition(|(_, check)| check.state != "passed");
        rows.extend(passed);
        let mut shown_pictures: Vec<&str> = Vec::new();
        let mut failures: Vec<PageFailure> = Vec::new();
        for (rule, check) in checks().filter(|(_, check)| check.state != "passed") {
            let losses = check.losses.iter().map(|loss| {
                let pictures = pictures(loss, folder, &mut shown_pictures);
                PageLoss { text: place_in_words(check, loss), pictures }
            });
            failures.push(PageFailure {
                title: format!("{}: {}", rule.title, of(check)),
                losses: losses.collect(),
                reason: check.reason.clone().unwrap_or_default(),
            });
        }
        let whole = verdict.rules.iter().filter_map(|rule| Some((rule, rule.reason.as_ref()?)));
        failures.extend(whole.map(|(rule, reason)| PageFailure {
            title: rule.title.clone(),
            reason: reason.clone(),
            losses: Vec::new(),
        }));
        let errors = verdict.errors.iter().map(|error| format!("not scored: {error}"));
        Self {
            state: verdict.state.clone(),
            heading: heading(verdict),
            baseline: verdict.baseline.clone(),
            more_checks: rows.len().saturating_sub(MOST_CHECKS),
            checks: rows.into_iter().take(MOST_CHECKS).map(row).collect(),
            failures,
            lines: errors.chain(verdict.notes.iter().cloned()).collect(),
        }
    }
}

fn heading(verdict: &VerdictRecord) -> String {
    let failed = verdict.rules.iter().filter(|rule| rule.state == "failed").count();
    let rules = verdict.rules.len();
    let s = if rules == 1 { "" } else { "s" };
    match verdict.state.as_str() {
        "passed" => format!("The gate holds: {rules} rule{s}"),
        "failed" => format!("The gate fails: {} of {rules} rule{s}", failed.max(1)),
        "wrong" => "No verdict: a rule is wrong".to_owned(),
        _ => "No verdict: not everything could be scored".to_owned(),
    }
}

fn of(check: &CheckRecord) -> String {
    let parts = [&check.scene, &check.method, &check.eye];
    let parts = parts.into_iter().filter(|part| !part.is_empty());
    let band = check.band_deg.map(|[from, to]| format!("{from}° to {to}°"));
    parts.cloned().chain(band).collect::<Vec<_>>().join(", ")
}

fn row((rule, check): (&RuleRecord, &CheckRecord)) -> PageCheck {
    let [value, limit] = shown(check.value.map(|v| v.0), check.limit.map(|l| l.0));
    let frame = match (check.losses.first(), check.worst_frame) {
        (Some(loss), _) => loss.frame.to_string(),
        (None, Some(frame)) => frame.to_string(),
        (None, None) => String::new(),
    };
    let [margin, _] = shown(check.margin.map(|margin| margin.0), None);
    PageCheck {
        state: check.state.clone(),
        rule: rule.title.clone(),
        of: of(check),
        value,
        limit,
        margin,
        frame,
    }
}

fn pictures<'a>(loss: &'a LossRecord, folder: &Path, shown: &mut Vec<&'a str>) -> Vec<PagePicture> {
    // Rules that point at the same frame share its pictures: they are shown once.
    let Some(first) = loss.pictures.first() else { return Vec::new() };
    let is_new = !shown.contains(&first.path.as_str());
    // Their addresses are shown below each check that they belong to.
    let has_room = shown.len() < MOST_WITH_PICTURES;
    if is_new && has_room {
        shown.push(&first.path);
    }
    let is_inside =
        |path: &str| path.starts_with("gate/") && !path.split('/').any(|part| part == "..");
    let pictures = loss.pictures.iter().filter(|picture| is_inside(&picture.path));
    let picture = |what: &str, path: &str| {
        let file = folder.join(path);
        let is_small =
            || file.metadata().is_ok_and(|file| file.is_file() && file.len() < MOST_BYTES);
        let bytes = if is_new && has_room && is_small() { fs::read(&file).ok() } else { None };
        PagePicture {
            what: what.to_owned(),
            address: address(path),
            image: bytes.and_then(|bytes| data_image("png", &bytes)),
        }
    };
    pictures.map(|one| picture(&one.what, &one.path)).collect()
}
