//! Rank tests of methods: Kruskal-Wallis, Friedman, and tests of each pair of methods.

mod friedman;
mod kruskal;
mod mid_ranks;
mod options;
mod pairwise;
mod signed_rank;
mod units;

pub use friedman::Friedman;
pub use kruskal::Kruskal;
pub(crate) use mid_ranks::mid_ranks;
pub use options::Options;
pub use pairwise::Pairwise;

use serde::Serialize;

use crate::input::Data;
use crate::json::{Document, Group};
use crate::moments::{mean, sd};
use crate::options::PairwiseTest;
use crate::quantile::median;
use crate::{Settings, StudyError};
use units::Units;

/// The result of one group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ranks {
    /// The methods, in their order.
    pub methods: Vec<Method>,
    /// The test of all methods as independent groups.
    pub kruskal: Kruskal,
    /// The test of all methods within units.
    pub friedman: Friedman,
    /// The tests of pairs of methods.
    pub pairwise: Vec<Pairwise>,
    /// What the tests assume.
    pub note: &'static str,
}

/// The values of a method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Method {
    /// The method.
    pub method: String,
    /// The number of units with a value.
    pub n: usize,
    /// Their mean.
    pub mean: Option<f64>,
    /// Their median.
    pub median: Option<f64>,
    /// The standard error of the mean, for figures.
    #[serde(skip)]
    pub se: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Computes the tests for each group. The value of a unit and method is the mean of its rows; for
/// pairwise comparisons (a table without the column `value`), it is the number of votes won.
///
/// # Errors
///
/// If a column is missing, a value is no number, an answer is unknown or tied with [`Ties::Error`],
/// a method of the options does not occur, or there are too many methods.
pub fn ranks(
    data: &Data,
    options: &Options,
    settings: &Settings,
) -> Result<Document<Ranks>, StudyError> {
    let has_values = units::has_values(data)?;
    let data = if has_values { data.without_empty("value")? } else { data.clone() };
    let all = units::methods(&data, has_values)?;
    for name in &options.order {
        if all.index(name).is_none() {
            return Err(crate::pairs::unknown_method("--order", name, all.names()));
        }
    }
    let mut groups = Vec::new();
    for (by, data) in data.groups()? {
        let units = Units::read(&data, options, has_values)?;
        groups.push(Group { by, result: of_units(&units, options, settings) });
    }
    Ok(Document::new("ranks", groups))
}

fn of_units(units: &Units, options: &Options, settings: &Settings) -> Ranks {
    let values = units.values();
    let methods = units.methods.names().iter().zip(&values);
    let methods = methods.map(|(method, values)| Method {
        method: method.clone(),
        n: values.len(),
        mean: mean(values),
        median: median(values),
        se: sd(values).map(|sd| sd / libm::sqrt(values.len() as f64)),
        reason: values.is_empty().then(|| "all votes of the method are left out".to_owned()),
    });
    let slices: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
    Ranks {
        methods: methods.collect(),
        kruskal: kruskal::kruskal(&slices),
        friedman: friedman::friedman(&units.whole(), units.methods.len()),
        pairwise: pairwise::pairwise(units, options.pairwise, settings.adjust),
        note: match options.pairwise {
            PairwiseTest::SignedRank => {
                "kruskal assumes independent groups, which the values of the same units are not; \
                 friedman and signed-rank compare within units"
            }
            PairwiseTest::Kruskal | PairwiseTest::Dunn => {
                "kruskal and the pairwise tests assume independent groups, which the values of the \
                 same units are not; friedman and --pairwise signed-rank compare within units"
            }
        },
    }
}
