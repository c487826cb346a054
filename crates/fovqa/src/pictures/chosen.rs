//! Which frames and methods of a run the report shows.

use std::collections::BTreeMap;

use fovqa_engine::{Findings, Named};
use fovqa_metrics::{Better, Key, Metric};
use fovqa_plan::{Eye, FrameChoice, FrameWord, Plan, ReportSettings};
use fovqa_results::{ChosenFrame, FrameResult, IMAGES_SCHEMA, ImagesRecord, ViewImages};

/// What a scene's frames were scored, by number and by the index of the method.
#[derive(Default)]
struct Scores {
    frames: BTreeMap<i64, BTreeMap<usize, Vec<f64>>>,
    /// The gaze of each frame of an eye, if it comes from a trace.
    gaze: BTreeMap<Option<Eye>, BTreeMap<i64, [f64; 2]>>,
}

/// The frames that the report shows of each scene, and of which methods. Both eyes of a scene show the
/// same frames. Of a swept method, the best point is shown.
pub(super) fn chosen(plan: &Plan, settings: &ReportSettings, findings: &Findings) -> ImagesRecord {
    let mut views = Vec::new();
    if settings.frames.is_empty() {
        return ImagesRecord { schema: IMAGES_SCHEMA.to_owned(), views };
    }
    let methods: BTreeMap<&str, usize> =
        plan.methods.iter().enumerate().map(|(index, name)| (name.as_str(), index)).collect();
    let mut of_scenes: BTreeMap<&str, Vec<(Named<'_>, &FrameResult)>> = BTreeMap::new();
    for (named, frame) in findings.scored(plan) {
        of_scenes.entry(named.scene).or_default().push((named, frame));
    }
    for scene in &plan.scenes {
        let Some(scored) = of_scenes.get(scene.name.as_str()) else { continue };
        let is_scored = |metric: Metric| scored.iter().any(|(_, frame)| frame.rows.has(metric));
        let metric = settings.ranking(is_scored);
        let scores = Scores::new(scored, &methods, metric);
        let frames = scores.frames(settings, metric);
        let shown = scores.methods(plan, metric);
        for eye in &scene.eyes {
            let gaze = scores.gaze.get(&eye.eye).into_iter().flatten();
            views.push(ViewImages {
                scene: scene.name.clone(),
                eye: eye.eye,
                ranked_by: metric.map(|metric| metric.key().to_owned()),
                frames: frames.clone(),
                methods: shown.iter().map(|method| plan.methods[*method].clone()).collect(),
                gaze: gaze.map(|(frame, gaze)| (*frame, *gaze)).collect(),
            });
        }
    }
    ImagesRecord { schema: IMAGES_SCHEMA.to_owned(), views }
}

/// The better of two scores, for `max_by`.
fn rising(metric: Option<Metric>, a: f64, b: f64) -> std::cmp::Ordering {
    match metric.map(|metric| metric.info().better) {
        Some(Better::Lower) => b.total_cmp(&a),
        _ => a.total_cmp(&b),
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0_u32);
    for value in values {
        sum += value;
        count += 1;
    }
    sum / f64::from(count.max(1))
}

impl Scores {
    fn new(
        scored: &[(Named<'_>, &FrameResult)],
        methods: &BTreeMap<&str, usize>,
        metric: Option<Metric>,
    ) -> Self {
        let mut scores = Self::default();
        for (named, frame) in scored {
            let of_frame = scores.frames.entry(frame.frame).or_default();
            let of_method = of_frame.entry(methods[named.method]).or_default();
            of_method.extend(metric.and_then(|metric| frame.rows.value(Key::of(metric))));
            if let Some(gaze) = frame.gaze_px {
                scores.gaze.entry(named.eye).or_default().insert(frame.frame, gaze);
            }
        }
        scores
    }

    /// The chosen frames that exist, in ascending order.
    fn frames(&self, settings: &ReportSettings, metric: Option<Metric>) -> Vec<ChosenFrame> {
        let mut chosen: BTreeMap<i64, Vec<FrameChoice>> = BTreeMap::new();
        for choice in &settings.frames {
            let frame = match choice {
                FrameChoice::Of(FrameWord::First) => self.frames.keys().next().copied(),
                FrameChoice::Of(FrameWord::Worst) => self.worst(metric),
                FrameChoice::Of(FrameWord::Median) => self.median(metric),
                FrameChoice::Number(number) => {
                    Some(*number).filter(|number| self.frames.contains_key(number))
                }
            };
            if let Some(frame) = frame {
                chosen.entry(frame).or_default().push(*choice);
            }
        }
        chosen.into_iter().map(|(frame, why)| ChosenFrame { frame, why }).collect()
    }

    fn worst(&self, metric: Option<Metric>) -> Option<i64> {
        let worst = self.frames.iter().filter_map(|(frame, methods)| {
            let values = methods.values().flatten().copied();
            Some((*frame, values.min_by(|a, b| rising(metric, *a, *b))?))
        });
        worst.min_by(|a, b| rising(metric, a.1, b.1)).map(|(frame, _)| frame)
    }

    fn median(&self, metric: Option<Metric>) -> Option<i64> {
        let mut means: Vec<(i64, f64)> = self
            .frames
            .iter()
            .filter(|(_, methods)| methods.values().any(|values| !values.is_empty()))
            .map(|(frame, methods)| {
                let values = methods.values().filter(|values| !values.is_empty());
                (*frame, mean(values.map(|values| mean(values.iter().copied()))))
            })
            .collect();
        means.sort_by(|a, b| rising(metric, a.1, b.1).then(a.0.cmp(&b.0)));
        // Of an even number, the worse one in the middle: a frame is shown, not a mean of two.
        means.get(means.len().saturating_sub(1) / 2).map(|(frame, _)| *frame)
    }

    /// The methods that are shown: of each sweep, the point with the best mean over all frames.
    fn methods(&self, plan: &Plan, metric: Option<Metric>) -> Vec<usize> {
        let mut sums: BTreeMap<usize, (f64, u32)> = BTreeMap::new();
        for (method, values) in self.frames.values().flatten() {
            let sum = sums.entry(*method).or_default();
            for value in values {
                *sum = (sum.0 + value, sum.1 + 1);
            }
        }
        let score = |method: usize| {
            let (sum, count) = sums.get(&method).copied()?;
            (count > 0).then(|| sum / f64::from(count))
        };
        let is_best = |method: usize| {
            let sweep = plan.sweeps.iter().find(|sweep| sweep.methods().contains(&method));
            let Some(sweep) = sweep else { return true };
            let points = sweep.methods().rev().filter_map(|point| Some((point, score(point)?)));
            let best = points.max_by(|a, b| rising(metric, a.1, b.1));
            best.map_or(sweep.first == method, |(best, _)| best == method)
        };
        sums.keys().copied().filter(|method| is_best(*method)).collect()
    }
}
