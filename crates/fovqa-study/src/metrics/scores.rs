//! Mean opinion scores, and the scores of metrics for the same conditions.

use std::collections::HashMap;

use crate::StudyError;
use crate::input::{Column, Data, Table};

/// A scene with a method, and its mean opinion score.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// The mean opinion score; the mean if there are several rows.
    pub value: f64,
    /// Its standard error, if there is one.
    pub error: Option<f64>,
}

/// The conditions of a group, by first appearance.
pub(super) fn conditions(data: &Data) -> Result<Vec<Condition>, StudyError> {
    let (scene, method) = (data.column("scene")?, data.column("method")?);
    let (value, error) = (data.column("value")?, data.optional("se")?);
    let mut known: HashMap<(u32, u32), usize> = HashMap::new();
    let mut found: Vec<(Condition, f64)> = Vec::new();
    for &row in data.rows() {
        let score = data.number(value, row)?;
        let error = match error.filter(|error| !error.text(row).is_empty()) {
            Some(error) => Some(standard_error(data, error, row)?),
            None => None,
        };
        let index = *known.entry((scene.code(row), method.code(row))).or_insert(found.len());
        if index == found.len() {
            let condition = Condition {
                scene: scene.text(row).to_owned(),
                method: method.text(row).to_owned(),
                value: 0.0,
                error: Some(0.0),
            };
            found.push((condition, 0.0));
        }
        let (condition, count) = &mut found[index];
        condition.value += score;
        // Squares, until the mean is taken.
        condition.error = condition.error.zip(error).map(|(sum, error)| sum + error * error);
        *count += 1.0;
    }
    let mean = |(mut condition, count): (Condition, f64)| {
        condition.value /= count;
        condition.error = condition.error.map(|squares| libm::sqrt(squares) / count);
        condition
    };
    Ok(found.into_iter().map(mean).collect())
}

fn standard_error(data: &Data, column: &Column, row: usize) -> Result<f64, StudyError> {
    let error = data.number(column, row)?;
    if error < 0.0 {
        let help = "write the standard error of the mean opinion score, or leave the cell empty";
        return Err(data.wrong_cell(column, row, "0 or more", help));
    }
    Ok(error)
}

/// The scores of metrics by scene and method.
#[derive(Debug, Clone, Default)]
pub(super) struct Scores {
    /// The metrics, by first appearance.
    pub(super) metrics: Vec<String>,
    /// The numbers of scenes and methods in `means`.
    scenes: HashMap<String, u32>,
    methods: HashMap<String, u32>,
    /// Per scene, method and metric: the mean score, which need not be finite.
    means: HashMap<(u32, u32, usize), f64>,
}

/// Columns that divide scores further, and the cells that belong to the score as a whole.
const WHOLE: [(&str, &[&str]); 6] = [
    ("parameters", &[]),
    ("level", &[]),
    ("from_deg", &[]),
    ("statistic", &["jod"]),
    ("image", &["pair"]),
    ("eye", &["both"]),
];

impl Scores {
    /// The scores in the table of a run (results.csv).
    ///
    /// # Errors
    ///
    /// If a column is missing, a cell is no number, or the table has no scores.
    pub(super) fn read(table: &Table) -> Result<Self, StudyError> {
        let selection = crate::input::Selection::default();
        let data = Data::new(table, &selection)?;
        let mut whole: Vec<(&Column, &[&str])> = Vec::new();
        for (name, allowed) in WHOLE {
            whole.extend(table.find(name)?.map(|column| (column, allowed)));
        }
        let value = data.column("value")?;
        let is_whole = |row: usize| {
            let belongs = |(column, allowed): &(&Column, &[&str])| {
                let text = column.text(row);
                text.is_empty() || allowed.contains(&text)
            };
            !value.text(row).is_empty() && whole.iter().all(belongs)
        };
        let rows: Vec<usize> = data.rows().iter().copied().filter(|&row| is_whole(row)).collect();
        if rows.is_empty() {
            return Err(StudyError::Setting {
                message: format!("{} has no scores of whole images", table.file()),
                help: "use results.csv of `fovqa run`; its rows of parameters, levels, bands and \
                       single eyes are left out"
                    .to_owned(),
            });
        }
        let data = data.with_rows(rows)?;
        let (scene, method) = (data.column("scene")?, data.column("method")?);
        let metrics = data.levels("metric")?;
        let metric = data.column("metric")?;
        let mut scores = Self { metrics: metrics.names().to_vec(), ..Self::default() };
        let mut sums: HashMap<(u32, u32, usize), (f64, f64)> = HashMap::new();
        for &row in data.rows() {
            let key = (scene.code(row), method.code(row), metrics.of_row(metric, row));
            let (sum, count) = sums.entry(key).or_default();
            if *count == 0.0 {
                scores.scenes.entry(scene.text(row).to_owned()).or_insert(key.0);
                scores.methods.entry(method.text(row).to_owned()).or_insert(key.1);
            }
            *sum += score(&data, value, row)?;
            *count += 1.0;
        }
        scores.means = sums.into_iter().map(|(key, (sum, count))| (key, sum / count)).collect();
        Ok(scores)
    }

    /// The scores of these metrics for a condition, if all of them are finite.
    pub(super) fn of(&self, condition: &Condition, metrics: &[usize]) -> Option<Vec<f64>> {
        let mean = |metric: &usize| self.mean(&condition.scene, &condition.method, *metric);
        metrics.iter().map(|metric| mean(metric).filter(|mean| mean.is_finite())).collect()
    }

    /// The mean of a metric for a scene and a method; `None` if there is none.
    fn mean(&self, scene: &str, method: &str, metric: usize) -> Option<f64> {
        let key = (*self.scenes.get(scene)?, *self.methods.get(method)?, metric);
        self.means.get(&key).copied()
    }

    /// The names of the metrics, for a message.
    pub(super) fn names(&self) -> String {
        let shown: Vec<&str> = self.metrics.iter().take(20).map(String::as_str).collect();
        let dots = if self.metrics.len() > shown.len() { ", …" } else { "" };
        format!("{}{dots}", shown.join(", "))
    }
}

/// The mean scores of one metric by scene and method.
#[derive(Debug, Clone)]
pub(crate) struct MeanScores {
    /// The scenes, by first appearance.
    pub(crate) scenes: Vec<String>,
    /// The methods, by first appearance.
    pub(crate) methods: Vec<String>,
    metric: usize,
    scores: Scores,
}

impl MeanScores {
    /// The mean score, which need not be finite.
    pub(crate) fn of(&self, scene: &str, method: &str) -> Option<f64> {
        self.scores.mean(scene, method, self.metric)
    }
}

/// The mean scores of a metric in the table of a run (results.csv), with the scenes and methods that have
/// one.
///
/// # Errors
///
/// If the table has no such scores.
pub(crate) fn mean_scores(table: &Table, metric: &str) -> Result<MeanScores, StudyError> {
    let scores = Scores::read(table)?;
    let index = scores.metrics.iter().position(|known| known == metric);
    let index = index.ok_or_else(|| StudyError::Setting {
        message: format!("{} has no scores of {metric}", table.file()),
        help: format!("score this metric in the run; the table has {}", scores.names()),
    })?;
    let scored = |of: &HashMap<String, u32>, code_of: fn(&(u32, u32, usize)) -> u32| {
        let is_scored =
            |code: u32| scores.means.keys().any(|key| key.2 == index && code_of(key) == code);
        let mut names: Vec<(u32, String)> =
            of.iter().map(|(name, code)| (*code, name.clone())).collect();
        names.retain(|(code, _)| is_scored(*code));
        // Codes are given by first appearance.
        names.sort();
        names.into_iter().map(|(_, name)| name).collect()
    };
    let scenes = scored(&scores.scenes, |key| key.0);
    let methods = scored(&scores.methods, |key| key.1);
    Ok(MeanScores { scenes, methods, metric: index, scores })
}

/// A score, which may be infinite: PSNR is, for equal frames.
fn score(data: &Data, value: &Column, row: usize) -> Result<f64, StudyError> {
    match value.text(row).to_ascii_lowercase().as_str() {
        "inf" | "+inf" | "infinity" => Ok(f64::INFINITY),
        "-inf" | "-infinity" => Ok(f64::NEG_INFINITY),
        "nan" => Ok(f64::NAN),
        _ => data.number(value, row),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Selection;

    #[test]
    fn scores_are_means_of_whole_frames() {
        let csv = b"scene,method,eye,frame,metric,statistic,from_deg,value\n\
            s,A,,0,psnr,,,30\ns,A,,1,psnr,,,40\ns,A,,1,psnr,,5.0,99\ns,A,left,1,psnr,,,99\n\
            s,A,both,0,fvvdp,jod,,9\ns,B,,0,psnr,,,inf\ns,B,,0,fvvdp,jod,,9\ns,A,,0,fvvdp,q,,1\n";
        let scores = Scores::read(&Table::read("results.csv", csv).unwrap()).unwrap();
        assert_eq!(scores.metrics, ["psnr", "fvvdp"]);
        let condition = |method: &str| Condition {
            scene: "s".into(),
            method: method.into(),
            value: 0.0,
            error: None,
        };
        assert_eq!(scores.of(&condition("A"), &[0, 1]), Some(vec![35.0, 9.0]));
        assert_eq!(scores.of(&condition("B"), &[0, 1]), None);
        assert_eq!(scores.of(&condition("B"), &[1]), Some(vec![9.0]));
        assert_eq!(scores.of(&condition("C"), &[1]), None);
    }

    #[test]
    fn opinion_scores_of_a_condition_are_averaged() {
        let csv = b"scene,method,value,se\ns,A,1,3\ns,A,3,4\ns,B,2,\n";
        let table = Table::read("mos.csv", csv).unwrap();
        let selection = Selection::default();
        let found = conditions(&Data::new(&table, &selection).unwrap()).unwrap();
        assert_eq!((found[0].value, found[0].error), (2.0, Some(2.5)));
        assert_eq!((found[1].value, found[1].error), (2.0, None));
    }
}
