//! Pairwise comparisons (two-alternative forced choice): shares with tests and intervals, scores in
//! JOD, and the consistency of judges.

mod consistency;
mod linked;
mod newton;
mod options;
mod scaling;
mod table;
mod votes;

pub(crate) use newton::PROBIT_75;

pub use consistency::{Agreement, Consistency, Judge};
pub use options::Options;
pub use scaling::{Scaled, Scaling, Score};
pub use table::Pair;
pub(crate) use votes::methods;
pub use votes::{JudgeName, Outcome, Vote, Votes};

use serde::Serialize;

use crate::input::Data;
use crate::json::{Document, Group};
use crate::{Settings, StudyError};

/// The result of one group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pairs {
    /// The number of participants.
    pub participants: usize,
    /// Pairs with votes, in the order of the methods.
    pub pairs: Vec<Pair>,
    /// Scores of the methods.
    pub scaling: Scaling,
    /// Consistency of the judges and their agreement.
    pub consistency: Consistency,
}

/// Computes shares, scores and consistency for each group.
///
/// # Errors
///
/// If a column is missing, an answer is unknown or tied with [`Ties::Error`], or a method of the
/// options does not occur.
pub fn pairs(
    data: &Data,
    options: &Options,
    settings: &Settings,
) -> Result<Document<Pairs>, StudyError> {
    let all = methods(data)?;
    let named = options.order.iter().map(|name| ("--order", name));
    let reference = options.reference.iter().map(|name| ("--reference", name));
    for (option, name) in named.chain(reference) {
        if all.index(name).is_none() {
            return Err(unknown_method(option, name, all.names()));
        }
    }
    let mut groups = Vec::new();
    for (by, data) in data.groups()? {
        let votes = Votes::read(&data, options.ties, &options.order)?;
        let result = Pairs {
            participants: votes.participants.len(),
            pairs: table::table(&votes, settings),
            scaling: scaling::scaling(&votes, options, settings),
            consistency: consistency::consistency(&votes),
        };
        groups.push(Group { by, result });
    }
    Ok(Document::new("pairs", groups))
}

/// The error of an option that names a method that does not occur.
pub(crate) fn unknown_method(option: &str, name: &str, known: &[String]) -> StudyError {
    let most = 20;
    let dots = if known.len() > most { ", …" } else { "" };
    let known = known.iter().take(most).cloned().collect::<Vec<_>>().join(", ");
    StudyError::Setting {
        message: format!("{option} names the method {name:?}, which has no rows"),
        help: format!("the methods are {known}{dots}"),
    }
}
