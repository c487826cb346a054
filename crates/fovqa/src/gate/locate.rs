//! Looks at the frames that failed rules point at: the place of the loss, and pictures of it.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::Arc;

use fovqa_engine::{EngineError, Entry, Finished, FoundInputs, Named};
use fovqa_frame::Frame;
use fovqa_metrics::Metric;
use fovqa_plan::{Eye, GateRule, Plan};
use fovqa_results::{
    GATE, Loss, LossPicture, MapBlocks, Place, Verdict, make_folder, padded, write_whole,
};
use fovqa_vision::Seen;

use super::places::Losses;
use super::sheets::Sheets;
use crate::baseline::{BaselineFrames, place_metric};
use crate::pictures::{Again, blocks};
use crate::reopened::KnownInputs;

/// Frames of a check that are looked at.
const MOST_OF_CHECK: usize = 3;
/// Frames of a gate that are looked at.
const MOST: usize = 12;
/// Longer side of the pictures to which the blocks of maps fit, as in the frames of a baseline.
const SIDE: usize = 512;
/// Frames before and after one that are compared with it if no good frame is kept.
const BESIDE: i64 = 2;

/// A run whose gate has failed.
pub(super) struct Site<'a> {
    pub(super) plan: &'a Plan,
    pub(super) found: &'a FoundInputs,
    pub(super) results: &'a Path,
    pub(super) good: Option<&'a BaselineFrames>,
    /// The inputs as they were scored, if they were scored before.
    pub(super) known: Option<&'a KnownInputs>,
}

/// A frame that is looked at: scene, eye, method and number.
type Target = (String, Option<Eye>, String, i64);

/// A loss in a verdict: rule, check and loss.
type Index = [usize; 3];

/// What was found out about a frame.
struct Looked {
    pictures: Option<(Arc<Frame>, Frame)>,
    maps: Vec<MapBlocks>,
    seen: Option<Seen>,
}

/// Adds places and pictures to the losses of a verdict. Pictures are written into the results folder.
/// Returns whether every frame was looked at; of many, only the first ones are.
///
/// # Errors
/// If a frame cannot be read, or a picture cannot be written.
pub(super) fn locate(verdict: &mut Verdict, site: &Site<'_>) -> Result<bool, EngineError> {
    let mut targets: Vec<(Target, Vec<Index>)> = Vec::new();
    let mut is_all = true;
    for (r, rule) in verdict.rules.iter().enumerate() {
        for (c, check) in rule.checks.iter().enumerate() {
            is_all &= check.losses.len() <= MOST_OF_CHECK;
            for (l, loss) in check.losses.iter().take(MOST_OF_CHECK).enumerate() {
                let (scene, method, _) = &check.place;
                let target = (scene.clone(), eye_of(&loss.eye), method.clone(), loss.frame);
                match targets.iter().position(|(known, _)| *known == target) {
                    Some(known) => targets[known].1.push([r, c, l]),
                    None if targets.len() < MOST => targets.push((target, vec![[r, c, l]])),
                    None => is_all = false,
                }
            }
        }
    }
    for (target, indices) in &targets {
        site.look(verdict, target, indices)?;
    }
    Ok(is_all)
}

fn eye_of(name: &str) -> Option<Eye> {
    [Eye::Left, Eye::Right].into_iter().find(|eye| eye.name() == name)
}

/// The metric in whose map the place of a loss is looked for.
fn map_of(rule: &GateRule, loss: &Loss) -> Metric {
    let of = |key: &str| Metric::find(key).and_then(place_metric);
    of(&rule.quantity.metric).or_else(|| of(&loss.metric)).unwrap_or(Metric::Mse)
}

impl Site<'_> {
    /// Looks at a frame.
    fn look(
        &self,
        verdict: &mut Verdict,
        target: &Target,
        indices: &[Index],
    ) -> Result<(), EngineError> {
        let (scene, eye, method, frame) = target;
        let named = Named { scene, method, eye: *eye };
        let searches: Vec<(Metric, Option<[f64; 2]>)> = indices
            .iter()
            .map(|[r, c, l]| {
                let rule = &verdict.rules[*r];
                let check = &rule.checks[*c];
                let band = check.band.or(rule.rule.quantity.band_deg);
                (map_of(&rule.rule, &check.losses[*l]), band)
            })
            .collect();
        let mut mapped: Vec<Metric> = Vec::new();
        for (metric, _) in &searches {
            if !mapped.contains(metric) {
                mapped.push(*metric);
            }
        }
        let mut looked = self.scored(named, (*frame, 0), &mapped)?;
        // Without good frames to compare with, those beside it are needed.
        let has_good = looked.get(frame).is_some_and(|this| {
            mapped.iter().all(|metric| {
                let good = self.good_losses(named, *frame, *metric);
                let this = losses(this, *metric);
                good.zip(this).is_some_and(|(good, this)| this.is_like(&good))
            })
        });
        if !has_good {
            looked = self.scored(named, (*frame, BESIDE), &mapped)?;
        }
        // Without the frame, which may have gone since, there is nothing to see.
        let Some(this) = looked.remove(frame) else { return Ok(()) };
        let mut pictures: Vec<(Option<[f64; 2]>, Vec<LossPicture>)> = Vec::new();
        for ([r, c, l], (metric, band)) in indices.iter().zip(searches) {
            let good = self.good_losses(named, *frame, metric);
            let place = place(&this, &looked, good.as_ref(), (metric, band));
            let px = place.as_ref().map(|place| place.px);
            let known = pictures.iter().position(|(known, _)| *known == px);
            let nth = known.unwrap_or(pictures.len());
            if known.is_none() {
                let made = self.pictures(named, *frame, &this, (px, nth));
                let path = || self.results.join(GATE);
                let made = made.map_err(|error| EngineError::Picture { path: path(), error })?;
                pictures.push((px, made));
            }
            let loss = &mut verdict.rules[*r].checks[*c].losses[*l];
            loss.place = place;
            loss.pictures.clone_from(&pictures[nth].1);
        }
        Ok(())
    }

    /// The losses of a frame in the last good build; `None` if they are not kept, or damaged.
    fn good_losses(&self, named: Named<'_>, frame: i64, metric: Metric) -> Option<Losses> {
        let info = metric.info().map?;
        Losses::of(&self.good?.map(named, frame, info.name)?, info)
    }

    /// A frame and those beside it, scored again.
    fn scored(
        &self,
        named: Named<'_>,
        (frame, beside): (i64, i64),
        mapped: &[Metric],
    ) -> Result<BTreeMap<i64, Looked>, EngineError> {
        let hash_inputs = self.known.is_some();
        let again = Again { plan: self.plan, found: self.found, mapped, hash_inputs };
        let around = frame.saturating_sub(beside)..=frame.saturating_add(beside);
        let is_wanted = |of: Named<'_>, number: i64| {
            (of.scene, of.method, of.eye) == (named.scene, named.method, named.eye)
                && around.contains(&number)
        };
        let mut looked = BTreeMap::new();
        let mut changed = None;
        again.score(&is_wanted, &mut |entry| {
            if let (Entry::Input(input), Some(known)) = (&entry, self.known)
                && !known.is_same(input)
            {
                changed.get_or_insert_with(|| input.path.clone());
            }
            if let Entry::Pair(Finished { maps, seen, pictures, result: Ok(result), .. }) = entry {
                let pictures = pictures.filter(|_| result.frame == frame);
                let one = Looked {
                    pictures: pictures.map(|pair| (pair.reference.clone(), pair.test.clone())),
                    maps: maps.iter().map(|map| blocks(map, SIDE)).collect(),
                    seen: seen.cloned(),
                };
                looked.insert(result.frame, one);
            }
            Ok(())
        })?;
        if let Some(path) = changed {
            let error =
                io::Error::other(format!("{path}: the file has changed since it was scored"));
            return Err(EngineError::Picture { path: self.results.join(GATE), error });
        }
        Ok(looked)
    }

    fn pictures(
        &self,
        named: Named<'_>,
        frame: i64,
        looked: &Looked,
        (place, nth): (Option<[f64; 2]>, usize),
    ) -> io::Result<Vec<LossPicture>> {
        let Some((reference, test)) = &looked.pictures else { return Ok(Vec::new()) };
        let good = self.good.and_then(|good| good.picture(named, frame));
        let (good, seen) = (good.as_ref(), looked.seen.as_ref());
        let sheets = Sheets { reference, test, good, seen, place }.all()?;
        let eye = named.eye.map(Eye::name);
        let parts = [Some(GATE), Some(named.scene), eye, Some(named.method)];
        let mut folder = parts.into_iter().flatten().collect::<Vec<_>>().join("/");
        folder.push('/');
        folder.push_str(&padded(frame));
        make_folder(&self.results.join(&folder))?;
        let mut pictures = Vec::new();
        for (name, what, bytes) in sheets {
            // Rules that point at another place of the frame have pictures of their own.
            let ending = if nth == 0 { String::new() } else { format!("-{}", nth + 1) };
            let path = format!("{folder}/{name}{ending}.png");
            write_whole(&self.results.join(&path), &bytes).map_err(io::Error::other)?;
            pictures.push(LossPicture { what, path });
        }
        Ok(pictures)
    }
}

/// The losses in the map of a frame.
fn losses(looked: &Looked, metric: Metric) -> Option<Losses> {
    let info = metric.info().map?;
    Losses::of(looked.maps.iter().find(|blocks| blocks.map == info.name)?, info)
}

/// The place of a loss in a map, within a band if the rule has one.
fn place(
    this: &Looked,
    beside: &BTreeMap<i64, Looked>,
    good: Option<&Losses>,
    (metric, band): (Metric, Option<[f64; 2]>),
) -> Option<Place> {
    let info = metric.info().map?;
    let beside: Vec<Losses> = beside.values().filter_map(|looked| losses(looked, metric)).collect();
    let degrees = |[x, y]: [f64; 2]| Some(this.seen.as_ref()?.eccentricity.at_deg(x, y));
    let is_allowed = |px: [f64; 2]| match (band, degrees(px)) {
        (Some([from, to]), Some(degrees)) => (from..to).contains(&degrees),
        _ => true,
    };
    let (px, compared) = losses(this, metric)?.worst(good, &beside, is_allowed)?;
    Some(Place { px, eccentricity_deg: degrees(px), map: info.name.to_owned(), compared })
}
