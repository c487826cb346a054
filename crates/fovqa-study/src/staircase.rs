//! Thresholds of adaptive staircases, from the levels at their reversals (Levitt 1971).

use std::collections::HashMap;

use serde::{Serialize, Serializer};

use crate::input::{Column, Data};
use crate::json::{self, Document, Group};
use crate::moments::{Moments, mean, sd};
use crate::options::LevelMean;
use crate::{Settings, StudyError};

/// How a threshold follows from the reversals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// First reversals that are left out.
    pub drop_reversals: usize,
    /// The mean of the levels at the others.
    pub mean: LevelMean,
}

impl Default for Options {
    fn default() -> Self {
        Self { drop_reversals: 2, mean: LevelMean::default() }
    }
}

/// The result of one group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Staircases {
    /// The staircases, by first appearance.
    pub staircases: Vec<Staircase>,
    /// The thresholds of the methods, by first appearance.
    pub methods: Vec<MethodThreshold>,
    /// The mean of the levels at reversals, for figures.
    #[serde(skip)]
    pub mean: LevelMean,
}

/// One staircase.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Staircase {
    /// The participant.
    pub participant: String,
    /// The method, if the table has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// The scene, if the table has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// The staircase, if the table has its name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub staircase: Option<String>,
    /// The number of trials.
    pub trials: usize,
    /// The share of correct answers.
    pub share_correct: f64,
    /// The number of reversals.
    pub reversals: usize,
    /// The trials of the reversals.
    #[serde(serialize_with = "whole_numbers")]
    pub reversal_trials: Vec<f64>,
    /// The threshold.
    #[serde(flatten)]
    pub threshold: Threshold,
    /// The trials in their order, for figures.
    #[serde(skip)]
    pub track: Vec<TrackTrial>,
}

/// A trial of a staircase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackTrial {
    /// The number of the trial, from the table.
    pub trial: f64,
    /// The level.
    pub level: f64,
    /// Whether the answer was correct.
    pub is_correct: bool,
    /// Whether the trial is a reversal that enters the threshold.
    pub is_used: bool,
}

/// The threshold of a staircase.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Threshold {
    /// The number of reversals that enter the threshold.
    pub used: usize,
    /// The mean of the levels at these reversals.
    pub threshold: Option<f64>,
    /// The standard deviation of these levels; of their logarithms for a geometric mean.
    pub sd: Option<f64>,
    /// Why the threshold is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The threshold of a method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MethodThreshold {
    /// The method, if the table has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// The participants with a threshold.
    pub participants: usize,
    /// The mean over participants, of each the mean of the staircases.
    pub threshold: Option<f64>,
    /// The standard error of the mean; of its logarithm for a geometric mean.
    pub se: Option<f64>,
    /// The t interval of the mean.
    pub ci: Option<[f64; 2]>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Writes numbers of trials as whole numbers where they are.
fn whole_numbers<S: Serializer>(numbers: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    struct Whole(f64);
    impl Serialize for Whole {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            json::votes(&self.0, serializer)
        }
    }
    serializer.collect_seq(numbers.iter().copied().map(Whole))
}

/// Computes the thresholds of each group. Trials belong to one staircase if they are equal in
/// participant, method, scene and staircase; they are put in the order of `trial`.
///
/// # Errors
///
/// If a column is missing or a cell cannot be used, and if a level is not above 0 for a geometric
/// mean.
pub fn staircase(
    data: &Data,
    options: &Options,
    settings: &Settings,
) -> Result<Document<Staircases>, StudyError> {
    let mut groups = Vec::new();
    for (by, data) in data.groups()? {
        let staircases: Vec<Staircase> =
            read(&data, options)?.into_iter().map(|rows| rows.finish(options)).collect();
        let methods = methods(&staircases, options, settings);
        let result = Staircases { staircases, methods, mean: options.mean };
        groups.push(Group { by, result });
    }
    Ok(Document::new("staircase", groups))
}

/// One trial of a staircase.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Trial {
    number: f64,
    level: f64,
    is_correct: bool,
}

/// The trials of one staircase.
struct Trials {
    participant: String,
    method: Option<String>,
    scene: Option<String>,
    staircase: Option<String>,
    trials: Vec<Trial>,
}

fn read(data: &Data, options: &Options) -> Result<Vec<Trials>, StudyError> {
    let participant = data.column("participant")?;
    let (number, level) = (data.column("trial")?, data.column("level")?);
    let correct = data.column("correct")?;
    let names: [Option<&Column>; 3] =
        [data.optional("method")?, data.optional("scene")?, data.optional("staircase")?];
    let mut known: HashMap<[u32; 4], usize> = HashMap::new();
    let mut staircases: Vec<Trials> = Vec::new();
    for &row in data.rows() {
        let code = |column: Option<&Column>| column.map_or(0, |column| column.code(row));
        let key = [participant.code(row), code(names[0]), code(names[1]), code(names[2])];
        let index = *known.entry(key).or_insert(staircases.len());
        if index == staircases.len() {
            let text = |column: Option<&Column>| column.map(|column| column.text(row).to_owned());
            staircases.push(Trials {
                participant: participant.text(row).to_owned(),
                method: text(names[0]),
                scene: text(names[1]),
                staircase: text(names[2]),
                trials: Vec::new(),
            });
        }
        let value = data.number(level, row)?;
        if options.mean == LevelMean::Geometric && value <= 0.0 {
            let help = "use --mean arithmetic, or leave the level out with --where";
            return Err(data.wrong_cell(level, row, "above 0, as --mean geometric needs", help));
        }
        let answer = data.count(correct, row).ok().filter(|answer| *answer < 2);
        let answer = answer.ok_or_else(|| {
            let help = "write 1 for a correct answer and 0 for a wrong one";
            data.wrong_cell(correct, row, "0 or 1", help)
        })?;
        let number = data.number(number, row)?;
        staircases[index].trials.push(Trial { number, level: value, is_correct: answer == 1 });
    }
    Ok(staircases)
}

impl Trials {
    fn finish(mut self, options: &Options) -> Staircase {
        self.trials.sort_by(|a, b| a.number.total_cmp(&b.number));
        let levels: Vec<f64> = self.trials.iter().map(|trial| trial.level).collect();
        let reversals = reversals(&levels);
        let correct = self.trials.iter().filter(|trial| trial.is_correct).count();
        let threshold = threshold(&levels, &reversals, options);
        let used = &reversals[reversals.len() - threshold.used..];
        let track = self.trials.iter().enumerate().map(|(index, trial)| TrackTrial {
            trial: trial.number,
            level: trial.level,
            is_correct: trial.is_correct,
            is_used: used.binary_search(&index).is_ok(),
        });
        let track = track.collect();
        Staircase {
            participant: self.participant,
            method: self.method,
            scene: self.scene,
            staircase: self.staircase,
            trials: self.trials.len(),
            share_correct: correct as f64 / self.trials.len() as f64,
            reversals: reversals.len(),
            reversal_trials: reversals.iter().map(|&index| self.trials[index].number).collect(),
            threshold,
            track,
        }
    }
}

/// The indices of the trials before a step whose direction differs from that of the step before it.
/// Equal levels are no step.
pub(crate) fn reversals(levels: &[f64]) -> Vec<usize> {
    let mut direction = 0.0;
    let mut reversals = Vec::new();
    for (index, pair) in levels.windows(2).enumerate() {
        let step = pair[1] - pair[0];
        if step == 0.0 {
            continue;
        }
        if direction * step.signum() < 0.0 {
            reversals.push(index);
        }
        direction = step.signum();
    }
    reversals
}

/// The threshold from the levels at the reversals that remain: without the first ones, and without one
/// more if the rest is odd.
pub(crate) fn threshold(levels: &[f64], reversals: &[usize], options: &Options) -> Threshold {
    let rest = reversals.get(options.drop_reversals..).unwrap_or(&[]);
    let rest = &rest[rest.len() % 2..];
    let used: Vec<f64> = rest.iter().map(|&index| options.mean.scale(levels[index])).collect();
    if used.len() < 2 {
        let reason = format!(
            "{} reversals leave fewer than 2 after the first {}",
            reversals.len(),
            options.drop_reversals
        );
        return Threshold { used: 0, threshold: None, sd: None, reason: Some(reason) };
    }
    let threshold = mean(&used).map(|mean| options.mean.level(mean));
    Threshold { used: used.len(), threshold, sd: sd(&used), reason: None }
}

impl LevelMean {
    /// The scale on which levels are averaged.
    pub(crate) fn scale(self, level: f64) -> f64 {
        match self {
            Self::Arithmetic => level,
            Self::Geometric => libm::log(level),
        }
    }

    /// The level of a value on that scale.
    pub(crate) fn level(self, value: f64) -> f64 {
        match self {
            Self::Arithmetic => value,
            Self::Geometric => libm::exp(value),
        }
    }
}

fn methods(
    staircases: &[Staircase],
    options: &Options,
    settings: &Settings,
) -> Vec<MethodThreshold> {
    let mut indices: HashMap<&Option<String>, usize> = HashMap::new();
    let mut methods: Vec<Vec<&Staircase>> = Vec::new();
    for staircase in staircases {
        let index = *indices.entry(&staircase.method).or_insert(methods.len());
        if index == methods.len() {
            methods.push(Vec::new());
        }
        methods[index].push(staircase);
    }
    let one = |staircases: Vec<&Staircase>| {
        let mut indices: HashMap<&str, usize> = HashMap::new();
        let mut values: Vec<Vec<f64>> = Vec::new();
        for staircase in &staircases {
            let index = *indices.entry(&staircase.participant).or_insert(values.len());
            if index == values.len() {
                values.push(Vec::new());
            }
            let threshold = staircase.threshold.threshold;
            values[index].extend(threshold.map(|threshold| options.mean.scale(threshold)));
        }
        let means: Vec<f64> = values.iter().filter_map(|values| mean(values)).collect();
        method_threshold(staircases[0].method.clone(), &means, options, settings)
    };
    methods.into_iter().map(one).collect()
}

fn method_threshold(
    method: Option<String>,
    means: &[f64],
    options: &Options,
    settings: &Settings,
) -> MethodThreshold {
    let moments = Moments::of(means, settings.confidence);
    let reason = match means.len() {
        0 => Some("no participant has a threshold"),
        1 => Some("one participant has no standard error"),
        _ => None,
    };
    MethodThreshold {
        method,
        participants: moments.n,
        threshold: moments.mean.map(|mean| options.mean.level(mean)),
        se: moments.se,
        ci: moments.ci.map(|ci| ci.map(|limit| options.mean.level(limit))),
        reason: reason.map(str::to_owned),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Selection, Table};

    #[test]
    fn a_reversal_is_the_trial_before_a_turn() {
        // Down, repeat, down, up, repeat, down, up.
        let levels = [4.0, 3.0, 3.0, 2.0, 3.0, 3.0, 2.0, 3.0];
        assert_eq!(reversals(&levels), [3, 5, 6]);
        assert!(reversals(&[1.0]).is_empty());
        assert!(reversals(&[]).is_empty());
    }

    #[test]
    fn one_more_reversal_is_dropped_if_the_rest_is_odd() {
        let levels = [9.0, 1.0, 2.0, 4.0, 8.0];
        let of = |drop_reversals, mean| {
            threshold(&levels, &[0, 1, 2, 3, 4], &Options { drop_reversals, mean })
        };
        let three_left = of(2, LevelMean::Arithmetic);
        assert_eq!((three_left.used, three_left.threshold), (2, Some(6.0)));
        let geometric = of(1, LevelMean::Geometric);
        assert!((geometric.threshold.unwrap() - 64.0_f64.powf(0.25)).abs() < 1e-12);
        let none = of(4, LevelMean::Arithmetic);
        assert!(none.used == 0 && none.threshold.is_none() && none.reason.is_some());
        assert_eq!(of(9, LevelMean::Arithmetic).used, 0);
    }

    #[test]
    fn staircases_are_sorted_by_trial_and_averaged_by_participant() {
        let csv = b"participant,trial,level,correct\nP1,2,1,1\nP1,1,2,1\nP1,3,2,0\nP1,4,1,1\nP1,5,2,1\nP2,1,1,1\n";
        let table = Table::read("t.csv", csv).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        let options = Options { drop_reversals: 0, ..Options::default() };
        let result = staircase(&data, &options, &Settings::default()).unwrap();
        let group = &result.groups[0].result;
        assert_eq!(group.staircases[0].reversal_trials, [2.0, 3.0, 4.0]);
        assert_eq!(group.staircases[0].threshold.threshold, Some(1.5));
        // Of three reversals, the first one is left out.
        let track = &group.staircases[0].track;
        let used: Vec<f64> = track.iter().filter(|trial| trial.is_used).map(|t| t.trial).collect();
        assert_eq!((track.len(), used), (5, vec![3.0, 4.0]));
        assert_eq!((track[2].level, track[2].is_correct), (2.0, false));
        assert_eq!((group.methods[0].participants, group.methods[0].threshold), (1, Some(1.5)));
        assert!(group.methods[0].ci.is_none() && group.methods[0].reason.is_some());
    }
}
