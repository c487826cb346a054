//! Plans of pairwise comparisons whose shares are predicted from the scores of a run.

use serde::Serialize;

use super::document::Plan;
use super::pairs::{PairsOptions, PairsPlan, plan_pairs};
use crate::distributions::normal_cdf;
use crate::input::Table;
use crate::metrics::mean_scores;
use crate::pairs::PROBIT_75;
use crate::{Settings, StudyError};

/// The metric whose scores are in JOD.
const METRIC: &str = "fvvdp";
/// The most pairs of methods.
const MOST_PAIRS: usize = 1000;
/// A larger share is as good as certain, and its trials are not worth a plan.
const LARGEST_SHARE: f64 = 0.999_999;

/// What is planned for.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictedOptions {
    /// The plan of each pair. Its share is not used.
    pub pair: PairsOptions,
    /// Only these methods; all if there is none.
    pub methods: Vec<String>,
    /// Only this scene; `None` for the mean over all scenes.
    pub scene: Option<String>,
}

/// The trials that each pair of methods of a run needs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PredictedPlan {
    /// From what and how the shares are predicted.
    pub prediction: String,
    /// The scenes whose scores are averaged.
    pub scenes: Vec<String>,
    /// Methods that are left out, because they lack a finite score in one of the scenes.
    pub left_out: Vec<String>,
    /// The pairs of methods, in the order of their first appearance.
    pub pairs: Vec<PredictedPair>,
}

/// The trials that a pair of methods needs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PredictedPair {
    /// The method with the higher score.
    pub method: String,
    /// The other method.
    pub opponent: String,
    /// Mean JOD of the method.
    pub jod: f64,
    /// Mean JOD of the other method.
    pub opponent_jod: f64,
    /// The predicted share of votes for the method.
    pub share: f64,
    /// The plan for this share.
    #[serde(flatten)]
    pub plan: PairsPlan,
}

/// Plans pairwise comparisons of the methods of a run (`scores`, its results.csv). The share of a pair is
/// Φ(0.6745 d), where d is the difference of the methods' FovVideoVDP scores in JOD: 1 JOD = 75 %.
///
/// # Errors
/// If the table has no FovVideoVDP scores, a name is not in it, or there are fewer than two methods or too
/// many.
pub fn plan_predicted(
    scores: &Table,
    options: &PredictedOptions,
    settings: &Settings,
) -> Result<Plan<PredictedPlan>, StudyError> {
    let known = mean_scores(scores, METRIC)?;
    let scenes = chosen((scores.file(), "scene"), &known.scenes, options.scene.as_slice())?;
    let methods = chosen((scores.file(), "method"), &known.methods, &options.methods)?;
    // A method that lacks a scene cannot be compared with the others.
    let mean = |method: &String| {
        let of_scenes = scenes.iter().map(|scene| known.of(scene, method));
        let sum = of_scenes.sum::<Option<f64>>()?;
        Some((method.clone(), sum / scenes.len() as f64)).filter(|(_, mean)| mean.is_finite())
    };
    let means: Vec<(String, f64)> = methods.iter().filter_map(mean).collect();
    let is_left_out = |method: &&String| !means.iter().any(|(name, _)| name == *method);
    let left_out: Vec<String> = methods.iter().filter(is_left_out).cloned().collect();
    let pairs = means.len() * means.len().saturating_sub(1) / 2;
    if pairs == 0 || pairs > MOST_PAIRS {
        return Err(StudyError::Setting {
            message: format!(
                "{} has {} with a finite {METRIC} score in each scene, which is {} pairs",
                scores.file(),
                if means.len() == 1 {
                    "1 method".to_owned()
                } else {
                    format!("{} methods", means.len())
                },
                pairs
            ),
            help: match left_out.as_slice() {
                [] => format!(
                    "choose 2 or more methods with --methods, and at most {MOST_PAIRS} pairs"
                ),
                _ => format!(
                    "{} lack a score in a scene: choose a scene that has them with --scene",
                    left_out.join(", ")
                ),
            },
        });
    }
    let mut planned = Vec::with_capacity(pairs);
    for (index, first) in means.iter().enumerate() {
        for second in &means[index + 1..] {
            planned.push(pair(first, second, options, settings));
        }
    }
    let prediction = "shares are predicted from the mean FovVideoVDP scores: a difference of 1 JOD is \
                      75 % of votes (Thurstone's Case V)";
    let result =
        PredictedPlan { prediction: prediction.to_owned(), scenes, left_out, pairs: planned };
    Ok(Plan::new("pairs", result))
}

/// The names that were asked for, which have to be known; all if none was.
fn chosen(
    (file, what): (&str, &str),
    known: &[String],
    wanted: &[String],
) -> Result<Vec<String>, StudyError> {
    if let Some(name) = wanted.iter().find(|name| !known.contains(name)) {
        let shown: Vec<&str> = known.iter().take(20).map(String::as_str).collect();
        return Err(StudyError::Setting {
            message: format!("{file} has no {METRIC} score of the {what} {name:?}"),
            help: format!("it has {}", shown.join(", ")),
        });
    }
    let mut names: Vec<String> = Vec::new();
    for name in if wanted.is_empty() { known } else { wanted } {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    Ok(names)
}

fn pair(
    first: &(String, f64),
    second: &(String, f64),
    options: &PredictedOptions,
    settings: &Settings,
) -> PredictedPair {
    let (winner, loser) = if second.1 > first.1 { (second, first) } else { (first, second) };
    let share = normal_cdf(PROBIT_75 * (winner.1 - loser.1));
    let pair = PairsOptions { share: share.min(LARGEST_SHARE), ..options.pair };
    PredictedPair {
        method: winner.0.clone(),
        opponent: loser.0.clone(),
        jod: winner.1,
        opponent_jod: loser.1,
        share,
        plan: plan_pairs(&pair, settings).result,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Alternative;

    const CSV: &[u8] = b"scene,method,frame,metric,statistic,value\n\
        hall,A,0,fvvdp,jod,9\nhall,B,0,fvvdp,jod,8\nhall,C,0,fvvdp,jod,8\n\
        road,A,0,fvvdp,jod,8\nroad,B,0,fvvdp,jod,9\nroad,C,0,fvvdp,jod,6\nroad,C,0,psnr,,30\n";

    fn planned(methods: &[&str], scene: Option<&str>) -> Result<Plan<PredictedPlan>, StudyError> {
        let pair = PairsOptions {
            share: 0.5,
            alpha: 0.05,
            power: 0.8,
            alternative: Alternative::TwoSided,
            trials: Some(30),
            width: None,
        };
        let methods = methods.iter().map(|name| (*name).to_owned()).collect();
        let options = PredictedOptions { pair, methods, scene: scene.map(str::to_owned) };
        let table = Table::read("results.csv", CSV).unwrap();
        plan_predicted(&table, &options, &Settings::default())
    }

    #[test]
    fn one_jod_is_a_share_of_three_quarters() {
        let plan = planned(&[], Some("hall")).unwrap().result;
        let [ab, _, bc] = plan.pairs.as_slice() else { panic!("{plan:?}") };
        assert_eq!((ab.method.as_str(), ab.opponent.as_str()), ("A", "B"));
        assert!((ab.share - 0.75).abs() < 1e-12, "{}", ab.share);
        let known = plan_pairs(
            &PairsOptions {
                share: 0.75,
                alpha: 0.05,
                power: 0.8,
                alternative: Alternative::TwoSided,
                trials: None,
                width: None,
            },
            &Settings::default(),
        );
        assert_eq!(ab.plan.trials, known.result.trials);
        // Equal scores are never told apart.
        assert!((bc.share - 0.5).abs() < 1e-12 && bc.plan.trials.is_none());
    }

    #[test]
    fn scores_are_averaged_over_scenes_and_the_winner_comes_first() {
        let plan = planned(&["C", "A"], None).unwrap().result;
        assert_eq!(plan.scenes, ["hall", "road"]);
        let [pair] = plan.pairs.as_slice() else { panic!("{plan:?}") };
        assert_eq!((pair.method.as_str(), pair.jod, pair.opponent_jod), ("A", 8.5, 7.0));
        assert!((pair.share - normal_cdf(1.5 * PROBIT_75)).abs() < 1e-12);
    }

    #[test]
    fn unknown_names_and_single_methods_are_errors() {
        assert!(planned(&["D"], None).unwrap_err().to_string().contains("method \"D\""));
        assert!(planned(&[], Some("x")).unwrap_err().help().contains("hall, road"));
        assert!(planned(&["A"], None).unwrap_err().to_string().contains("1 method "));
    }
}
