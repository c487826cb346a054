//! Repeated-measures analysis of variance with one or two factors within participants, and paired t
//! tests.

mod cells;
mod contrasts;
mod effects;
mod posthoc;
mod sphericity;

pub use cells::Cell;
pub use effects::Effect;
pub use posthoc::{LevelMean, PairedTest};
pub use sphericity::{Corrected, Mauchly};

use serde::Serialize;

use crate::input::Data;
use crate::json::{Document, Group};
use crate::{Settings, StudyError};
use cells::Cells;

/// The result of one group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Anova {
    /// The number of participants with a value in each cell.
    pub participants: usize,
    /// Participants who lack a value in a cell, and are left out.
    pub left_out: Vec<String>,
    /// The effects of the factors and of their interaction.
    pub effects: Option<Vec<Effect>>,
    /// Paired t tests of the levels of each factor, averaged over the other factor.
    pub posthoc: Option<Vec<PairedTest>>,
    /// The cells, the last factor fastest.
    pub cells: Vec<Cell>,
    /// The levels of each factor, averaged over the other factor, for figures.
    #[serde(skip)]
    pub levels: Vec<LevelMean>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Computes the analysis of variance for each group. `within` has one or two factors.
///
/// # Errors
///
/// If there are not one or two different factors, a factor has a name that the result uses, a column
/// is missing, a value is no number, or there are too many cells.
pub fn anova(
    data: &Data,
    within: &[String],
    settings: &Settings,
) -> Result<Document<Anova>, StudyError> {
    cells::check_factors(within)?;
    let data = data.without_empty("value")?;
    let mut groups = Vec::new();
    for (by, data) in data.groups()? {
        let cells = Cells::read(&data, within)?;
        groups.push(Group { by, result: of_cells(&cells, settings) });
    }
    Ok(Document::new("anova", groups))
}

fn of_cells(cells: &Cells, settings: &Settings) -> Anova {
    let participants = cells.values.len();
    let reason = (participants < 2).then(|| {
        format!("an analysis of variance needs two participants with all cells, not {participants}")
    });
    Anova {
        participants,
        left_out: cells.left_out.clone(),
        effects: reason.is_none().then(|| effects::effects(cells)),
        posthoc: reason.is_none().then(|| posthoc::posthoc(cells, settings)),
        cells: cells.table(settings.confidence),
        levels: posthoc::levels(cells, settings.confidence),
        reason,
    }
}
