//! A baseline contains the values of a run that later runs are compared with. It is a small text
//! file that can be kept in git.

mod frames;

pub use frames::FrameRecords;
pub(crate) use frames::rounded;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use fovqa_metrics::{Better, Metric, MetricKind};
use fovqa_plan::{Aggregate, GateRule, Quantity, Resolved, other_parameter};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::files::{FileError, read_json_file};
use crate::gate::{ComparisonName, RunValues, Series, own_difference, tested_quantities};
use crate::inputs::{Input, Inputs};
use crate::json::{Number, RunRecord};

/// Name and version of the format.
pub const BASELINE_SCHEMA: &str = "fovqa.baseline/1";

/// The content of a baseline file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Baseline {
    /// Name and version of the format.
    pub schema: String,
    /// Version of fovqa.
    pub version: String,
    /// Name of the experiment.
    pub experiment: String,
    /// The metrics by their keys.
    pub metrics: BTreeMap<String, MetricRecord>,
    /// The inputs, grouped by folder.
    pub inputs: BTreeMap<String, InputGroup>,
    /// One entry per scene, method and eye.
    pub comparisons: Vec<BaselineComparison>,
    /// The experiment with all its defaults.
    pub resolved: Resolved,
}

/// How a metric was computed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetricRecord {
    /// Version of the metric. Values of different versions may differ.
    pub version: u32,
    /// Its parameters.
    pub parameters: BTreeMap<String, Value>,
}

/// The inputs of one folder.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputGroup {
    /// Number of files.
    pub files: usize,
    /// SHA-256 of the names and hashes of the files.
    pub sha256: String,
}

/// The values of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BaselineComparison {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// `left`, `right` or `both`; empty if the scene has one image per frame.
    pub eye: String,
    /// Number of frames that were scored.
    pub frames: usize,
    /// Values by their names.
    pub(crate) values: BTreeMap<String, Number>,
    /// The values of single frames that the rules use; `None` in a baseline of an earlier version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) per_frame: Option<FrameRecords>,
    /// Values of all repeated runs, by their names, for rules that test the spread of repeated runs.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) repeats: BTreeMap<String, Vec<Number>>,
}

impl BaselineComparison {
    /// Scene, method and eye.
    pub fn place(&self) -> ComparisonName {
        (self.scene.clone(), self.method.clone(), self.eye.clone())
    }

    /// Scene, method and eye in words.
    pub fn named(&self) -> String {
        let eye = if self.eye.is_empty() { String::new() } else { format!(", {}", self.eye) };
        format!("{}, {}{eye}", self.scene, self.method)
    }

    /// The values with their names.
    pub fn values(&self) -> impl Iterator<Item = (&str, f64)> {
        self.values.iter().map(|(name, value)| (name.as_str(), value.0))
    }
}

/// A value of a baseline and the corresponding value of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Scene, method and eye.
    pub place: String,
    /// Name of the value.
    pub quantity: String,
    /// Value in the baseline; `None` if the value is new.
    pub before: Option<f64>,
    /// Value in the run; `None` if the value no longer exists.
    pub after: Option<f64>,
}

impl Baseline {
    /// Makes the baseline of a run. It contains the values that the rules use and, for each metric
    /// with a better direction, the mean and the worst frame. Of the rules and of what tells in which frame
    /// a loss is, it also contains the values of single frames and bands. `hash` returns the hash of a text.
    pub fn of(
        run: &RunRecord,
        values: &RunValues,
        rules: &[GateRule],
        hash: &dyn Fn(&str) -> String,
    ) -> Self {
        let metrics = run.resolved.metrics.iter().filter_map(|(key, parameters)| {
            let version = Metric::find(key)?.info().version;
            Some((key.clone(), MetricRecord { version, parameters: parameters.clone() }))
        });
        let mut quantities: Vec<Quantity> = run
            .resolved
            .metrics
            .keys()
            .filter_map(|key| Metric::find(key))
            .flat_map(usual)
            .collect();
        quantities
            .extend(rules.iter().map(|rule| &rule.quantity).filter(|q| !q.per_frame).cloned());
        let of_frames = |place: &ComparisonName| {
            let mut of_rules: Vec<Quantity> = Vec::new();
            let own = own_difference(|metric| values.has(place, metric));
            for quantity in rules.iter().map(|rule| rule.quantity.of_frames()).chain(own) {
                if !of_rules.contains(&quantity) {
                    of_rules.push(quantity);
                }
            }
            let series = of_rules.into_iter().filter_map(|quantity| {
                let series = values.series(place, &quantity)?;
                Some((quantity, series))
            });
            FrameRecords::of(&series.collect::<Vec<_>>())
        };
        let comparisons = values.places().map(|place| {
            let found = quantities.iter().filter_map(|quantity| {
                let found = values.of(place, quantity).ok()?;
                Some((quantity.to_string(), Number(found.value)))
            });
            let (scene, method, eye) = place.clone();
            let frames = values.frames_of(place);
            let per_frame = of_frames(place);
            let repeats = repeated(values, rules, place);
            let values = found.collect();
            BaselineComparison { scene, method, eye, frames, values, per_frame, repeats }
        });
        Self {
            schema: BASELINE_SCHEMA.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            experiment: run.resolved.name.clone(),
            metrics: metrics.collect(),
            inputs: grouped(&run.inputs, hash),
            comparisons: comparisons.collect(),
            resolved: run.resolved.clone(),
        }
    }

    /// Reads a baseline file.
    ///
    /// # Errors
    /// If it cannot be read, is not a baseline, or contains a comparison twice, for example after a
    /// wrong merge.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let expected = "a baseline";
        let baseline: Self = read_json_file(path, BASELINE_SCHEMA, expected)?;
        let mut places = BTreeSet::new();
        let wrong = baseline.comparisons.iter().find_map(|one| {
            let is_sound = one.per_frame.as_ref().is_none_or(FrameRecords::is_sound);
            if !places.insert(one.place()) {
                return Some(format!("the comparison {} appears twice", one.named()));
            }
            (!is_sound).then(|| format!("its frames of {} do not have a value each", one.named()))
        });
        match wrong {
            None => Ok(baseline),
            Some(detail) => Err(FileError::Format { path: path.to_owned(), expected, detail }),
        }
    }

    /// The values of single frames; `None` if there are none.
    pub(crate) fn series(&self, place: &ComparisonName, quantity: &Quantity) -> Option<Series> {
        let comparison = self.comparisons.iter().find(|c| c.place() == *place)?;
        comparison.per_frame.as_ref()?.series(quantity)
    }

    /// Number of frames of a comparison; `None` if there is no such comparison.
    pub(crate) fn frames_of(&self, place: &ComparisonName) -> Option<usize> {
        self.comparisons.iter().find(|c| c.place() == *place).map(|c| c.frames)
    }

    /// The value of a comparison.
    pub(crate) fn value(&self, place: &ComparisonName, quantity: &Quantity) -> Result<f64, String> {
        let comparison = self.comparison(place)?;
        let value = comparison.values.get(&quantity.to_string());
        value.map(|number| number.0).ok_or_else(|| lacks(comparison, quantity))
    }

    /// The value of each frame of a comparison.
    pub(crate) fn frames(
        &self,
        place: &ComparisonName,
        quantity: &Quantity,
    ) -> Result<BTreeMap<i64, f64>, String> {
        let comparison = self.comparison(place)?;
        let Some(records) = &comparison.per_frame else {
            return Err(format!(
                "the baseline has no values of single frames of {}; `fovqa baseline accept` adds them",
                comparison.named()
            ));
        };
        let series = records.series(quantity);
        series.map(|series| series.frames).ok_or_else(|| {
            let lacks = lacks(comparison, quantity);
            format!("{lacks}; `fovqa baseline accept` adds it")
        })
    }

    /// The values of the repeated runs of a comparison; empty if the baseline has none.
    pub(crate) fn repeats(
        &self,
        place: &ComparisonName,
        quantity: &Quantity,
    ) -> Result<Vec<f64>, String> {
        let values = self.comparison(place)?.repeats.get(&quantity.to_string());
        Ok(values.into_iter().flatten().map(|number| number.0).collect())
    }

    fn comparison(&self, place: &ComparisonName) -> Result<&BaselineComparison, String> {
        let found = self.comparisons.iter().find(|c| c.place() == *place);
        found.ok_or_else(|| {
            let (scene, method, eye) = place;
            if !self.comparisons.iter().any(|c| c.scene == *scene) {
                return format!("the baseline has no scene {scene}");
            }
            let eye = if eye.is_empty() { String::new() } else { format!(", {eye}") };
            format!("the baseline has no {method}{eye} in scene {scene}")
        })
    }

    /// Why a run cannot be compared with this baseline: metrics of another version, or computed
    /// with other settings. `None` if it can be compared.
    pub fn refuses(&self, run: &Resolved) -> Option<String> {
        for (key, parameters) in &run.metrics {
            let (Some(before), Some(metric)) = (self.metrics.get(key), Metric::find(key)) else {
                continue;
            };
            let version = metric.info().version;
            if before.version != version {
                return Some(format!(
                    "it has version {} of {key}, but this fovqa has version {version}",
                    before.version
                ));
            }
            if let Some(why) = other_parameter(key, &before.parameters, parameters) {
                return Some(why);
            }
        }
        self.resolved.taken_otherwise(run)
    }

    /// The folders whose inputs differ from those of the baseline.
    pub fn other_inputs(&self, run: &RunRecord, hash: &dyn Fn(&str) -> String) -> Vec<String> {
        let now = grouped(&run.inputs, hash);
        let other = |(folder, before): (&String, &InputGroup)| {
            now.get(folder).filter(|now| *now != before).map(|_| folder.clone())
        };
        self.inputs.iter().filter_map(other).collect()
    }

    /// The old and the new value wherever the two differ. Of the values of single frames, those with the
    /// largest difference.
    pub fn differences(&self, new: &Self, scenes: &[String]) -> Vec<Difference> {
        let wanted = |c: &&BaselineComparison| scenes.is_empty() || scenes.contains(&c.scene);
        let mut differences = Vec::new();
        let mut add = |place: &str, quantity: &str, before: Option<f64>, after: Option<f64>| {
            if before.map(f64::to_bits) != after.map(f64::to_bits) {
                let (place, quantity) = (place.to_owned(), quantity.to_owned());
                differences.push(Difference { place, quantity, before, after });
            }
        };
        for comparison in new.comparisons.iter().filter(wanted) {
            let before = self.comparisons.iter().find(|c| c.place() == comparison.place());
            let frames = |of: &BaselineComparison| of.per_frame.clone();
            if let Some((was, is)) = before.and_then(frames).zip(frames(comparison)) {
                for (quantity, [before, after]) in is.differences(&was) {
                    add(&comparison.named(), &quantity, Some(before), Some(after));
                }
            }
            for (quantity, after) in comparison.values() {
                let before = before.and_then(|before| before.values.get(quantity)).map(|n| n.0);
                add(&comparison.named(), quantity, before, Some(after));
            }
        }
        for comparison in self.comparisons.iter().filter(wanted) {
            let after = new.comparisons.iter().find(|c| c.place() == comparison.place());
            for (quantity, before) in comparison.values() {
                if after.is_none_or(|after| !after.values.contains_key(quantity)) {
                    add(&comparison.named(), quantity, Some(before), None);
                }
            }
        }
        differences
    }

    /// The baseline with the values of a run. If scenes are given, only their values are replaced.
    ///
    /// # Errors
    /// If a scene is not in the run, or the values that stay were computed with other settings.
    pub fn accepting(&self, new: &Self, scenes: &[String]) -> Result<Self, String> {
        if scenes.is_empty() {
            return Ok(new.clone());
        }
        if let Some(scene) = scenes.iter().find(|s| !new.comparisons.iter().any(|c| c.scene == **s))
        {
            return Err(format!("the run has no scene {scene}"));
        }
        if let Some(why) = self.refuses(&new.resolved) {
            return Err(format!(
                "values of some scenes cannot be combined with values of other scenes that were measured \
                 differently: {why}"
            ));
        }
        let of = |comparisons: &[BaselineComparison], taken: bool| {
            let chosen = comparisons.iter().filter(|c| scenes.contains(&c.scene) == taken);
            chosen.cloned().collect::<Vec<_>>()
        };
        let mut comparisons = of(&self.comparisons, false);
        comparisons.extend(of(&new.comparisons, true));
        comparisons.sort_by_key(BaselineComparison::place);
        // Values that are not replaced still belong to their old inputs.
        let mut inputs = self.inputs.clone();
        let taken = new
            .inputs
            .iter()
            .filter(|(folder, _)| !self.inputs.contains_key(*folder) || new.reads(folder, scenes));
        inputs.extend(taken.map(|(folder, group)| (folder.clone(), group.clone())));
        let mut metrics = self.metrics.clone();
        metrics.extend(new.metrics.clone());
        Ok(Self { metrics, inputs, comparisons, ..new.clone() })
    }
}

impl Baseline {
    /// Whether any of these scenes has files in a folder.
    fn reads(&self, folder: &str, scenes: &[String]) -> bool {
        let of = self.resolved.scenes.iter().filter(|scene| scenes.contains(&scene.name));
        of.flat_map(|scene| &scene.eyes).any(|eye| {
            let beside = [
                &eye.view["gaze"]["trace"],
                &eye.signal["mask"],
                &eye.signal["motion"]["files"],
                &eye.signal["depth"]["files"],
            ];
            let paths = eye.tests.values().chain([&eye.reference]).map(String::as_str);
            let mut paths = paths.chain(beside.into_iter().filter_map(Value::as_str));
            let parent =
                |path: &str| path.rsplit_once('/').map_or("", |(parent, _)| parent) == folder;
            paths.any(|path| path == folder || parent(path))
        })
    }
}

fn lacks(comparison: &BaselineComparison, quantity: &Quantity) -> String {
    format!("the baseline has no {quantity} of {}", comparison.named())
}

/// The values of all repeated runs that the rules of a comparison test; empty if the run is not
/// repeated.
fn repeated(
    values: &RunValues,
    rules: &[GateRule],
    place: &ComparisonName,
) -> BTreeMap<String, Vec<Number>> {
    let rules = rules.iter().filter(|rule| rule.spread.is_some() && !values.repeats.is_empty());
    let quantities = rules.flat_map(|rule| tested_quantities(rule, values, place));
    let of_all = |quantity: Quantity| {
        let found = values.of_all_runs(place, &quantity).ok()?;
        Some((quantity.to_string(), found.into_iter().map(Number).collect()))
    };
    quantities.filter_map(of_all).collect()
}

/// The values of a metric that are stored whatever the rules are.
fn usual(metric: Metric) -> Vec<Quantity> {
    let of = |aggregate| Quantity::of(metric, aggregate);
    match (metric, metric.info().kind, metric.info().better) {
        (Metric::Fvvdp, ..) => vec![Quantity::jod()],
        (_, MetricKind::Fidelity, Better::Higher) => vec![of(Aggregate::Mean), of(Aggregate::Min)],
        (_, MetricKind::Fidelity, _) => vec![of(Aggregate::Mean), of(Aggregate::Max)],
        (_, MetricKind::Temporal, _) => ["test", "ratio"]
            .map(|image| Quantity { image: image.to_owned(), ..of(Aggregate::Mean) })
            .into(),
        (_, MetricKind::Profile, _) => Vec::new(),
    }
}

/// The inputs, grouped by folder.
fn grouped(inputs: &Inputs, hash: &dyn Fn(&str) -> String) -> BTreeMap<String, InputGroup> {
    let mut folders: BTreeMap<String, Vec<Input>> = BTreeMap::new();
    for input in inputs.all() {
        let folder = input.path.rsplit_once('/').map_or("", |(folder, _)| folder);
        folders.entry(folder.to_owned()).or_default().push(input);
    }
    let group = |inputs: Vec<Input>| {
        let mut lines: Vec<String> =
            inputs.iter().map(|input| format!("{} {}\n", input.sha256, input.path)).collect();
        lines.sort_unstable();
        InputGroup { files: inputs.len(), sha256: hash(&lines.concat()) }
    };
    folders.into_iter().map(|(folder, inputs)| (folder, group(inputs))).collect()
}
