//! Which frame and which part of it lost most: what a failed rule points at.

use std::collections::BTreeMap;

use fovqa_metrics::{Key, Metric, Subject};
use fovqa_plan::Quantity;

use super::series::{Series, amount, growth};
use super::values::{ComparisonName, RunValues};
use crate::baseline::{Baseline, rounded};

/// FovVideoVDP shows a loss up to this long after the frame that has it, in seconds: its temporal
/// filters look back as far.
const LATE_S: f64 = 0.25;
/// Frames per second where they are not known.
const USUAL_FPS: f64 = 60.0;
/// Frames before and after one that are compared with it if there is no baseline.
const BESIDE: i64 = 2;

/// The frame and the eccentricity band with the largest loss.
#[derive(Debug, Clone, PartialEq)]
pub struct Loss {
    /// The eye, where the check is of both; else the eye of the check.
    pub eye: String,
    /// The number of the frame.
    pub frame: i64,
    /// The key of the metric that named the frame.
    pub metric: String,
    /// Its statistic; empty for the metric's own value.
    pub statistic: String,
    /// Its value in this frame.
    pub value: f64,
    /// What it is compared with.
    pub compared: Compared,
    /// The value that it is compared with.
    pub before: Option<f64>,
    /// The band; `None` if no metric has values for bands.
    pub band: Option<BandLoss>,
    /// The place in the frame, once its maps were looked at.
    pub place: Option<Place>,
    /// Pictures of the frame and the place.
    pub pictures: Vec<LossPicture>,
}

/// The band with the largest loss.
#[derive(Debug, Clone, PartialEq)]
pub struct BandLoss {
    /// Its lower and upper edge in degrees.
    pub band_deg: [f64; 2],
    /// The key of the metric.
    pub metric: String,
    /// The value in the band.
    pub value: f64,
    /// What it is compared with.
    pub compared: Compared,
    /// The value that it is compared with.
    pub before: Option<f64>,
}

/// The place with the largest loss.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Column and row in pixels of the frame.
    pub px: [f64; 2],
    /// Its eccentricity in degrees; `None` without a view.
    pub eccentricity_deg: Option<f64>,
    /// The map in which it was found.
    pub map: String,
    /// What the map was compared with.
    pub compared: Compared,
}

/// A picture of a loss.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LossPicture {
    /// What it shows.
    pub what: String,
    /// Its file, relative to the results folder.
    pub path: String,
}

/// What a frame is compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compared {
    /// The same frame of the baseline.
    Baseline,
    /// The frames before and after it.
    Neighbours,
    /// Nothing: the frame or place with the worst value.
    Nothing,
}

impl Compared {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Neighbours => "neighbours",
            Self::Nothing => "nothing",
        }
    }
}

/// The metric that says in which frame a loss is: how much a frame differs from its reference, whatever
/// is before it.
pub(crate) fn own_difference(is_scored: impl Fn(Metric) -> bool) -> Option<Quantity> {
    const METRICS: [Metric; 8] = [
        Metric::Mse,
        Metric::Psnr,
        Metric::Ssim,
        Metric::Fpsnr,
        Metric::Fssim,
        Metric::MsSsim,
        Metric::PuPsnr,
        Metric::Gmsd,
    ];
    let metric = Metric::scoring_frames(&METRICS).find(|metric| is_scored(*metric))?;
    Some(Quantity::of(metric, fovqa_plan::Aggregate::Mean).of_frames())
}

/// The name of a metric's statistic, as messages write it.
pub fn statistic_name(metric: &str, statistic: &str) -> String {
    let key = Metric::find(metric).and_then(|of| Key::named(Subject::Metric(of), statistic));
    match statistic {
        "" => metric.to_owned(),
        _ if key.is_some_and(|key| key.statistic().is_named_alone) => statistic.to_owned(),
        _ => format!("{metric} {statistic}"),
    }
}

/// What a loss is looked for in.
pub(super) struct Search<'a> {
    pub(super) run: &'a RunValues,
    pub(super) baseline: Option<&'a Baseline>,
    /// Frames per second of the scene, if they are known.
    pub(super) fps: Option<f64>,
}

/// The values of a quantity in a run and in its baseline.
struct Pair {
    quantity: Quantity,
    now: Series,
    before: Option<Series>,
    /// Significant digits of the baseline's values of frames, if they are rounded.
    digits: Option<usize>,
}

/// A frame, and how much was lost in it.
struct Named {
    frame: i64,
    value: f64,
    before: Option<f64>,
    compared: Compared,
    growth: f64,
}

impl Search<'_> {
    /// The frames that a rule for a quantity points at, the one with the largest loss first. `failing` are the
    /// frames that break the rule, the worst first; if it is not a rule per frame, there are none. A frame in
    /// which FovVideoVDP breaks the rule may only be shortly after the one with the loss.
    pub(super) fn losses(
        &self,
        of: &Quantity,
        place: &ComparisonName,
        failing: &[i64],
    ) -> Vec<Loss> {
        let (scene, method, eye) = place;
        let of_eyes: Vec<ComparisonName> = if eye == "both" {
            let eyes = ["left", "right"].map(|eye| (scene.clone(), method.clone(), eye.to_owned()));
            eyes.into_iter().filter(|place| self.run.places.contains_key(place)).collect()
        } else {
            vec![place.clone()]
        };
        let mut losses: Vec<(f64, Loss)> = Vec::new();
        for place in &of_eyes {
            for (growth, loss) in self.of_eye(of, place, failing) {
                match losses.iter_mut().find(|(_, known)| known.frame == loss.frame) {
                    Some(known) if known.0 < growth => *known = (growth, loss),
                    Some(_) => {}
                    None => losses.push((growth, loss)),
                }
            }
        }
        // Of two eyes, only one may have lost something.
        if losses.iter().any(|(growth, _)| *growth > 0.0) {
            losses.retain(|(growth, _)| *growth > 0.0);
        }
        let is_late = of.metric == Metric::Fvvdp.key();
        if is_late || failing.is_empty() {
            losses.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.frame.cmp(&b.1.frame)));
        } else {
            let nth = |frame: i64| failing.iter().position(|failing| *failing == frame);
            losses.sort_by_key(|(_, loss)| nth(loss.frame));
        }
        losses.into_iter().map(|(_, loss)| loss).collect()
    }

    fn of_eye(&self, of: &Quantity, place: &ComparisonName, failing: &[i64]) -> Vec<(f64, Loss)> {
        let is_late = of.metric == Metric::Fvvdp.key();
        let own = || self.own_difference(place);
        let pair = if is_late { own() } else { None };
        let Some(pair) = pair.or_else(|| self.pair(place, of.of_frames())).or_else(own) else {
            return Vec::new();
        };
        let named: Vec<Named> = if failing.is_empty() {
            pair.largest(pair.now.frames.keys().copied()).into_iter().collect()
        } else if is_late {
            let before = (LATE_S * self.fps.unwrap_or(USUAL_FPS)).ceil() as i64;
            let window = |frame: &i64| {
                let frames = pair.now.frames.range(frame.saturating_sub(before)..=*frame);
                pair.largest(frames.map(|(frame, _)| *frame))
            };
            let mut named: Vec<Named> = failing.iter().filter_map(window).collect();
            named.sort_by_key(|named| named.frame);
            named.dedup_by_key(|named| named.frame);
            named
        } else {
            failing.iter().filter_map(|frame| pair.named(*frame)).collect()
        };
        let loss = |named: Named| {
            let band = self.band(of, place, named.frame);
            let loss = Loss {
                eye: place.2.clone(),
                frame: named.frame,
                metric: pair.quantity.metric.clone(),
                statistic: pair.quantity.statistic.clone(),
                value: named.value,
                compared: named.compared,
                before: named.before,
                band,
                place: None,
                pictures: Vec::new(),
            };
            (named.growth, loss)
        };
        named.into_iter().map(loss).collect()
    }

    fn own_difference(&self, place: &ComparisonName) -> Option<Pair> {
        let quantity = own_difference(|metric| self.run.has(place, metric))?;
        self.pair(place, quantity)
    }

    fn pair(&self, place: &ComparisonName, quantity: Quantity) -> Option<Pair> {
        let now = self.run.series(place, &quantity)?;
        let before = self.baseline.and_then(|baseline| {
            let own = baseline.series(place, &quantity).map(|series| (series, None));
            own.or_else(|| in_band(baseline, place, &quantity))
        });
        let (before, digits) =
            before.map_or((None, None), |(series, digits)| (Some(series), digits));
        Some(Pair { quantity, now, before, digits })
    }

    /// The band with the largest loss of a frame: of the rule's metric if it has bands, and within the
    /// rule's band.
    fn band(&self, of: &Quantity, place: &ComparisonName, frame: i64) -> Option<BandLoss> {
        let has_bands = |pair: &Pair| !pair.now.bands.is_empty();
        let pair = self.pair(place, of.of_frames()).filter(has_bands);
        // A statistic may be of whole frames alone, although its metric has bands.
        let own = || Quantity { statistic: String::new(), ..of.of_frames() };
        let pair = pair.or_else(|| self.pair(place, own()).filter(has_bands));
        let pair = pair.or_else(|| self.own_difference(place).filter(has_bands))?;
        let inside = |[from, to]: [f64; 2]| {
            of.band_deg.is_none_or(|[least, most]| least <= from && to <= most)
        };
        let bands = pair.now.bands.iter().filter(|(edges, _)| inside(*edges));
        let bands: Vec<_> = bands.collect();
        let most = |is_compared: bool| {
            let losses = bands.iter().filter_map(|(edges, now)| {
                let earlier = pair.before.as_ref().filter(|_| is_compared);
                let before = earlier.and_then(|before| before.band(*edges));
                let digits = earlier.and_then(|before| before.digits);
                let named = pair.quantity.named(frame, (now, before), digits)?;
                Some((*edges, named))
            });
            losses.reduce(|best, one| if one.1.growth > best.1.growth { one } else { best })
        };
        // If no band has lost anything against the baseline, the worst one is told.
        let compared = most(true)?;
        let (band_deg, named) = if compared.1.has_lost() { compared } else { most(false)? };
        let (metric, before) = (pair.quantity.metric.clone(), named.before);
        let compared = named.compared;
        Some(BandLoss { band_deg, metric, value: named.value, compared, before })
    }
}

impl Pair {
    /// A frame with its loss. If it has lost nothing against the baseline, it is not compared with it.
    fn named(&self, frame: i64) -> Option<Named> {
        let before = self.before.as_ref().map(|before| &before.frames);
        let named = self.quantity.named(frame, (&self.now.frames, before), self.digits)?;
        if named.has_lost() { Some(named) } else { self.alone(frame) }
    }

    fn alone(&self, frame: i64) -> Option<Named> {
        self.quantity.named(frame, (&self.now.frames, None), None)
    }

    /// The frame with the largest loss against the baseline. If there is none, the frame with the worst
    /// value: a rule with a fixed limit may fail although nothing was lost.
    fn largest(&self, frames: impl Iterator<Item = i64> + Clone) -> Option<Named> {
        let named: Vec<Named> = frames.clone().filter_map(|frame| self.named(frame)).collect();
        let lost = named.into_iter().filter(|named| named.compared == Compared::Baseline);
        let most = lost.reduce(|best, one| if one.growth > best.growth { one } else { best });
        most.or_else(|| {
            let alone = frames.filter_map(|frame| self.alone(frame));
            let amount = |named: &Named| amount(&self.quantity, named.value);
            alone.reduce(|worst, one| if amount(&one) > amount(&worst) { one } else { worst })
        })
    }
}

impl Named {
    /// Whether something was lost, if it is compared with the baseline.
    fn has_lost(&self) -> bool {
        self.compared != Compared::Baseline || self.growth > 0.0
    }
}

/// The values of frames in a band, from those of all bands.
fn in_band(
    baseline: &Baseline,
    place: &ComparisonName,
    quantity: &Quantity,
) -> Option<(Series, Option<usize>)> {
    let edges = quantity.band_deg?;
    let whole = Quantity { band_deg: None, ..quantity.clone() };
    let series = baseline.series(place, &whole)?;
    let frames = series.band(edges)?.clone();
    let digits = series.digits;
    Some((Series { frames, ..series }, digits))
}

trait NamedFrames {
    fn named(
        &self,
        frame: i64,
        series: (&BTreeMap<i64, f64>, Option<&BTreeMap<i64, f64>>),
        digits: Option<usize>,
    ) -> Option<Named>;
}

impl NamedFrames for Quantity {
    /// A frame, compared with that of the baseline, or else with the best of the frames beside it.
    fn named(
        &self,
        frame: i64,
        (now, before): (&BTreeMap<i64, f64>, Option<&BTreeMap<i64, f64>>),
        digits: Option<usize>,
    ) -> Option<Named> {
        let value = *now.get(&frame)?;
        // Rounded as the baseline is, what has not changed is equal.
        let shown = digits.map_or(value, |digits| rounded(value, digits));
        if let Some(before) = before.and_then(|before| before.get(&frame)) {
            let growth = growth(self, shown, *before);
            return Some(Named {
                frame,
                value,
                before: Some(*before),
                compared: Compared::Baseline,
                growth,
            });
        }
        let around = now.range(frame.saturating_sub(BESIDE)..=frame.saturating_add(BESIDE));
        let around = around.filter(|(number, _)| **number != frame).map(|(_, value)| *value);
        let best = around.reduce(|a, b| if amount(self, b) < amount(self, a) { b } else { a });
        let (compared, growth) = match best {
            Some(best) => (Compared::Neighbours, growth(self, value, best)),
            None => (Compared::Nothing, amount(self, value)),
        };
        Some(Named { frame, value, before: best, compared, growth })
    }
}

#[cfg(test)]
mod tests {
    use super::super::values::{ValueRow, Values};
    use super::*;

    /// FovVideoVDP looks back from a failing frame, but no number is before the first one.
    #[test]
    fn the_first_possible_frame_number_has_a_loss() {
        let row = |frame, value| ValueRow { frame: Some(frame), band: None, value: Some(value) };
        let kind = (Metric::Mse.key().to_owned(), String::new(), "pair".to_owned(), None);
        let rows = vec![row(i64::MIN, 0.2), row(i64::MIN + 1, 0.1)];
        let values = Values { rows: BTreeMap::from([(kind, rows)]), ..Values::default() };
        let place = ("s".to_owned(), "m".to_owned(), String::new());
        let places = BTreeMap::from([(place.clone(), values)]);
        let run = RunValues { places, ..RunValues::default() };
        let search = Search { run: &run, baseline: None, fps: None };
        let losses = search.losses(&Quantity::jod(), &place, &[i64::MIN, i64::MIN + 1]);
        let frames: Vec<i64> = losses.iter().map(|loss| loss.frame).collect();
        assert_eq!(frames, [i64::MIN]);
    }
}
