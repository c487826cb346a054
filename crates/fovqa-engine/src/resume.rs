//! Continues a run that was interrupted: finds out what in its journal is still valid.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use fovqa_frame::source::Origin;
use fovqa_metrics::{LeadIn, Metric, Needs};
use fovqa_plan::{Emulation, Eye, Gaze, Plan};
use fovqa_results::Inputs;

use crate::error::EngineError;
use crate::findings::{Findings, ViewFindings};
use crate::found::{FoundInputs, FoundView};
use crate::found_frame::FoundFrame;
use crate::inputs::changed_inputs;
use crate::journal::{self, Header, JOURNAL, ViewFiles};
use crate::share::{Shard, shares};
use crate::timing::timings;

/// What a run can continue with.
#[derive(Debug, Default)]
pub struct Resumed {
    /// The findings that are known already; empty if the run starts again.
    pub known: Findings,
    /// Why the run starts again although there was a journal: what has changed since, in words.
    pub changes: Vec<String>,
}

/// Looks for earlier findings that a run with this header would produce again. Every file that the
/// earlier run read is read again to compare its hash.
///
/// # Errors
/// If the journal exists and cannot be read.
pub fn resume(
    folder: &Path,
    header: &Header,
    plan: &Plan,
    found: &FoundInputs,
) -> Result<Resumed, EngineError> {
    let changed = |changes| Ok(Resumed { changes, ..Resumed::default() });
    let text = match journal::read(folder) {
        Ok(journal::Content::Nothing) => return Ok(Resumed::default()),
        Ok(journal::Content::Other) => {
            return changed(vec![format!(
                "{JOURNAL} does not have the format of this version of fovqa"
            )]);
        }
        Ok(journal::Content::OtherFormat(format)) => {
            let kept = format!("{JOURNAL}.old");
            std::fs::rename(folder.join(JOURNAL), folder.join(&kept))
                .map_err(|error| EngineError::JournalRead { path: folder.join(JOURNAL), error })?;
            return changed(vec![format!(
                "another version of fovqa wrote {JOURNAL}, in format {format}; it is kept as {kept}, and that \
                 version can continue with it once it is named {JOURNAL} again"
            )]);
        }
        Ok(journal::Content::Journal(text)) => text,
        Err(error) => return Err(EngineError::JournalRead { path: folder.join(JOURNAL), error }),
    };
    let changes = differences(&text.header, header);
    if !changes.is_empty() {
        return changed(changes);
    }
    let said = text
        .said(plan, &mut journal::Shared::default())
        .map_err(|error| EngineError::JournalRead { path: folder.join(JOURNAL), error })?;
    if let Some(line) = said.changed {
        return Err(EngineError::JournalChanged { path: folder.join(JOURNAL), line });
    }
    let changes = changed_inputs(
        &said.findings.inputs,
        plan,
        &origins(plan, found, header.shard, &said.findings.inputs),
    );
    if !changes.is_empty() {
        return changed(changes);
    }
    let known = still_good(plan, found, header.shard, said.findings)?;
    Ok(Resumed { known, changes: Vec::new() })
}

/// The files of recorded inputs, by the names that results show. Only as many frames are looked at as it
/// takes to find them all: a shard has few files of a long sequence.
fn origins(
    plan: &Plan,
    found: &FoundInputs,
    shard: Option<Shard>,
    inputs: &Inputs,
) -> BTreeMap<String, Origin> {
    let settings = plan.scenes.iter().flat_map(|scene| &scene.eyes).map(|eye| &eye.settings);
    let beside = settings.flat_map(|settings| {
        let trace = match &settings.gaze {
            Gaze::Trace { path, .. } => Some(path),
            Gaze::Centre | Gaze::Point(_) | Gaze::Each(_) | Gaze::Builtin => None,
        };
        [settings.mask.as_ref(), trace].into_iter().flatten()
    });
    let beside = beside.map(|path| (plan.shown(path), Origin::File(path.clone())));
    let pairs: Vec<usize> = found.views.iter().map(FoundView::pairs).collect();
    let shares: Vec<_> = found.views.iter().zip(shares(shard, &pairs)).collect();
    // A method may take from the frames of the other eye.
    let has_share = |scene| shares.iter().any(|(of, share)| of.scene == scene && !share.is_empty());
    let own = shares.iter().filter(|(view, _)| has_share(view.scene));
    let frames = own.flat_map(|(view, share)| {
        nearest_first(view, share).flat_map(move |frame| {
            let sources = view.sources.of_frame(frame);
            sources.flat_map(|(source, at)| source.origins(at)).collect::<Vec<_>>()
        })
    });
    let mut origins = BTreeMap::new();
    for (name, origin) in beside.chain(frames) {
        if inputs.get(&name).is_some() {
            origins.insert(name, origin);
        }
        if origins.len() == inputs.len() {
            break;
        }
    }
    origins
}

/// The frames of a view, those of a share of its pairs first, then the first frame, which settles the view,
/// then the frames before the share, which temporal metrics read, and the rest.
fn nearest_first<'a>(
    view: &'a FoundView,
    share: &Range<usize>,
) -> impl Iterator<Item = &'a FoundFrame> + use<'a> {
    let mut pairs = 0;
    let before = view.frames.iter().take_while(|frame| {
        pairs += frame.tests.len();
        pairs <= share.start
    });
    let (before, own) = view.frames.split_at(before.count());
    own.iter().take(share.len()).chain(before.first()).chain(before.iter().rev()).chain(own)
}

/// The reason if maps are requested that finished frames do not have.
pub const NO_MAPS: &str = "the --maps folder does not contain the maps of finished frames";

/// The differences that prevent a run from continuing with the findings of another.
fn differences(then: &Header, now: &Header) -> Vec<String> {
    let mut differences = Vec::new();
    if then.version != now.version {
        differences
            .push(format!("fovqa {} wrote it, but this is fovqa {}", then.version, now.version));
    }
    // Other plots need no other scores. Shards are merged by the text of their file.
    let same_scores = now.shard.is_none()
        && then.scored_sha256.is_some()
        && then.scored_sha256 == now.scored_sha256;
    if then.experiment_sha256 != now.experiment_sha256 && !same_scores {
        differences.push("the experiment file has changed".to_owned());
    }
    if then.frames != now.frames {
        let frames = |header: &Header| match &header.frames {
            None => "all frames".to_owned(),
            Some(frames) => format!("--frames {frames}"),
        };
        differences.push(format!(
            "its run used {}, but this run uses {}",
            frames(then),
            frames(now)
        ));
    }
    // The finished frames have no maps, or have them in another folder.
    if now.maps.is_some() && then.maps != now.maps {
        differences.push(NO_MAPS.to_owned());
    }
    if then.shard != now.shard {
        let shard = |header: &Header| match header.shard {
            None => "a complete run".to_owned(),
            Some(shard) => format!("shard {shard}"),
        };
        differences.push(format!("it contains {}, but this is {}", shard(then), shard(now)));
    }
    // If there are other differences, this is another experiment, or other frames of it, so the
    // files need no comparison.
    if differences.is_empty() {
        differences.extend(other_files(&then.views, &now.views, now.shard));
    }
    differences
}

/// Names the views whose files have changed. A new view does not affect the others, except in a
/// shard, because it changes the shard's range.
fn other_files(then: &[ViewFiles], now: &[ViewFiles], shard: Option<Shard>) -> Vec<String> {
    let same = |a: &ViewFiles, b: &ViewFiles| a.scene == b.scene && a.eye == b.eye;
    let named = |view: &ViewFiles| match view.eye {
        None => view.scene.clone(),
        Some(eye) => format!("{}, {} eye", view.scene, Eye::name(eye)),
    };
    let gone = then.iter().filter(|old| !now.iter().any(|new| same(old, new)));
    let gone = gone.map(|view| format!("{}: its frames can no longer be found", named(view)));
    let new = now.iter().filter_map(|new| match then.iter().find(|old| same(old, new)) {
        Some(old) if old == new => None,
        Some(_) => Some(format!(
            "{}: its files, or the bands that follow from them, have changed",
            named(new)
        )),
        None if shard.is_none() => None,
        None => Some(format!("{}: its frames were not found before", named(new))),
    });
    gone.chain(new).collect()
}

/// The findings of a journal that are still valid, whatever happens to the rest.
fn still_good(
    plan: &Plan,
    found: &FoundInputs,
    shard: Option<Shard>,
    mut findings: Findings,
) -> Result<Findings, EngineError> {
    let pairs: Vec<usize> = found.views.iter().map(FoundView::pairs).collect();
    let mut views = std::mem::take(&mut findings.views);
    for (view, range) in found.views.iter().zip(shares(shard, &pairs)) {
        let place = (view.scene, view.eye);
        if let Some(known) = views.remove(&place) {
            findings.views.insert(place, of_view(plan, view, range, known)?);
        }
    }
    // Present problems are found again.
    findings.problems.clear();
    Ok(findings)
}

fn of_view(
    plan: &Plan,
    view: &FoundView,
    range: Range<usize>,
    mut known: ViewFindings,
) -> Result<ViewFindings, EngineError> {
    let (metrics, _) = view.metrics(plan)?;
    known.failed = None;
    // A source went on after its last pair. Whether it still does is only known when it has been read to the end.
    if known.pairs.contains_key(&view.pairs()) {
        return Ok(ViewFindings::default());
    }
    // The cause of a failure may have been corrected since.
    known.pairs.retain(|_, outcome| outcome.result.is_ok());
    // The first pair that can be compared determines the size and bands of all pairs, so this pair
    // must not change.
    let begun = range.start > 0 || known.pairs.contains_key(&0);
    if !known.before.is_empty() || !begun {
        return Ok(ViewFindings::default());
    }
    let fvvdp = metrics.contains(&Metric::Fvvdp);
    let temporal = |(_, emulation): (usize, &Emulation)| emulation.is_temporal();
    let filtered = view.sources.emulations().any(temporal);
    if Needs::of(&metrics).lead_in > LeadIn::None || filtered {
        let timings = timings(view, view.fps, &plan.params.fvvdp);
        let timings = timings.unwrap_or_default();
        let good = |index: &usize| {
            let Some(outcome) = known.pairs.get(index) else { return false };
            let Ok(frame) = &outcome.result else { return false };
            let timed = timings.get(&outcome.method).is_some_and(|timing| timing.time.is_ok());
            !(fvvdp && timed && !frame.rows.has(Metric::Fvvdp))
        };
        // Each pair depends on those before it.
        let first = range.clone().find(|index| !good(index)).unwrap_or(range.end);
        known.pairs.split_off(&first);
    }
    if known.pairs.len() < range.len() {
        known.settled = None;
    }
    Ok(known)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::found_frame::GuideFrames;
    use crate::view_sources::ViewSources;

    #[test]
    fn frames_of_a_share_come_first_and_all_frames_come() {
        let frame = |number: usize| FoundFrame {
            number: number as i64,
            position: number,
            reference: number,
            guides: GuideFrames::default(),
            tests: vec![(0, number), (1, number)],
        };
        let view = FoundView {
            scene: 0,
            eye: 0,
            sources: ViewSources::empty(),
            frames: (0..5).map(frame).collect(),
            fps: None,
            trace: None,
            passed_over: 0,
            remarks: Vec::new(),
        };
        let order = |share: Range<usize>| -> Vec<i64> {
            nearest_first(&view, &share).map(|frame| frame.number).collect()
        };
        // Pairs 5 and 6 are the second of frame 2 and the first of frame 3.
        assert_eq!(order(5..7), [2, 3, 0, 1, 0, 2, 3, 4]);
        assert_eq!(order(0..10), [0, 1, 2, 3, 4, 0, 1, 2, 3, 4]);
        for share in [0..1, 3..4, 8..10, 4..4] {
            let mut all = order(share);
            all.sort_unstable();
            all.dedup();
            assert_eq!(all, [0, 1, 2, 3, 4]);
        }
    }
}
