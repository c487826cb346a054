//! The votes of a table.

use std::collections::HashMap;

use crate::StudyError;
use crate::input::{Column, Data, Levels};
use crate::options::Ties;

/// The largest number of methods: every method is compared with every other one.
const MOST_METHODS: usize = 200;

/// What a participant chose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The method `a`.
    A,
    /// The method `b`.
    B,
    /// Neither.
    Tie,
}

/// Equal votes of a participant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vote {
    /// The row in the table.
    pub row: usize,
    /// The participant.
    pub participant: usize,
    /// The judge: a participant and a scene.
    pub judge: usize,
    /// One method.
    pub a: usize,
    /// The other method.
    pub b: usize,
    /// What was chosen.
    pub outcome: Outcome,
    /// The number of votes.
    pub count: f64,
}

impl Vote {
    /// The votes that method `a` and method `b` win. Half of a tie's votes are for each side; with
    /// [`Ties::Drop`], they are for none.
    pub fn won(&self, ties: Ties) -> [f64; 2] {
        match (self.outcome, ties) {
            (Outcome::A, _) => [self.count, 0.0],
            (Outcome::B, _) => [0.0, self.count],
            (Outcome::Tie, Ties::Half) => [0.5 * self.count; 2],
            (Outcome::Tie, _) => [0.0; 2],
        }
    }
}

/// A judge: a participant who saw a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JudgeName {
    /// The participant.
    pub participant: String,
    /// The scene, if the table has scenes.
    pub scene: Option<String>,
}

/// All votes of a group.
#[derive(Debug, Clone)]
pub struct Votes {
    /// The methods, in their order.
    pub methods: Levels,
    /// The participants, by first appearance.
    pub participants: Levels,
    /// The judges, by first appearance.
    pub judges: Vec<JudgeName>,
    /// How ties count.
    pub ties: Ties,
    /// The votes, in the order of the rows.
    pub votes: Vec<Vote>,
}

/// The methods of pairwise comparisons, by first appearance.
///
/// # Errors
///
/// If a column is missing, a cell is empty, or there are too many methods.
pub(crate) fn methods(data: &Data) -> Result<Levels, StudyError> {
    let [a, b] = [data.column("method_a")?, data.column("method_b")?];
    data.levels("method_a")?;
    data.levels("method_b")?;
    let methods = Levels::of_columns(a, b, data.rows());
    if methods.len() > MOST_METHODS {
        return Err(StudyError::Setting {
            message: format!(
                "{}: {} methods are too many; pairwise comparisons can have {MOST_METHODS}",
                data.table().file(),
                methods.len()
            ),
            help: "select rows with --where or --by, or check the columns of the methods"
                .to_owned(),
        });
    }
    Ok(methods)
}

impl Votes {
    /// Reads the votes of a group. `order` has the first methods.
    ///
    /// # Errors
    ///
    /// If a column is missing, a cell is empty, an answer is unknown, or a tie is an error.
    pub fn read(data: &Data, ties: Ties, order: &[String]) -> Result<Self, StudyError> {
        let methods = methods(data)?.in_order(order);
        let participants = data.levels("participant")?;
        let participant = data.column("participant")?;
        let scene = data.optional("scene")?;
        let count = data.optional("n")?;
        let reader = Reader {
            data,
            a: data.column("method_a")?,
            b: data.column("method_b")?,
            answer: data.column("answer")?,
            ties,
        };
        let mut judges = Vec::new();
        let mut known: HashMap<(u32, u32), usize> = HashMap::new();
        let mut votes = Vec::with_capacity(data.rows().len());
        for &row in data.rows() {
            let outcome = reader.outcome(row)?;
            let key = (participant.code(row), scene.map_or(0, |scene| scene.code(row)));
            let judge = *known.entry(key).or_insert(judges.len());
            if judge == judges.len() {
                judges.push(JudgeName {
                    participant: participant.text(row).to_owned(),
                    scene: scene.map(|scene| scene.text(row).to_owned()),
                });
            }
            votes.push(Vote {
                row,
                participant: participants.of_row(participant, row),
                judge,
                a: methods.of_row(reader.a, row),
                b: methods.of_row(reader.b, row),
                outcome,
                count: count.map_or(Ok(1), |count| data.count(count, row))? as f64,
            });
        }
        Ok(Self { methods, participants, judges, ties, votes })
    }

    /// Votes won per participant: cells `winner · methods + loser`, and their votes.
    pub(super) fn by_participant(&self) -> Vec<Vec<(usize, f64)>> {
        let t = self.methods.len();
        let mut cells: Vec<HashMap<usize, f64>> = vec![HashMap::new(); self.participants.len()];
        for vote in &self.votes {
            let [a, b] = vote.won(self.ties);
            for (cell, won) in [(vote.a * t + vote.b, a), (vote.b * t + vote.a, b)] {
                if won > 0.0 {
                    *cells[vote.participant].entry(cell).or_default() += won;
                }
            }
        }
        let sorted = |cells: HashMap<usize, f64>| {
            let mut cells: Vec<(usize, f64)> = cells.into_iter().collect();
            cells.sort_by_key(|(cell, _)| *cell);
            cells
        };
        cells.into_iter().map(sorted).collect()
    }
}

/// Votes won of some participants: `winner · methods + loser`.
pub(super) fn wins<'p>(
    by_participant: &'p [Vec<(usize, f64)>],
    participants: impl IntoIterator<Item = &'p usize>,
    methods: usize,
) -> Vec<f64> {
    let mut wins = vec![0.0; methods * methods];
    for &participant in participants {
        for &(cell, votes) in &by_participant[participant] {
            wins[cell] += votes;
        }
    }
    wins
}

/// Reads answers.
struct Reader<'d> {
    data: &'d Data<'d>,
    a: &'d Column,
    b: &'d Column,
    answer: &'d Column,
    ties: Ties,
}

impl Reader<'_> {
    fn outcome(&self, row: usize) -> Result<Outcome, StudyError> {
        let [a, b] = [self.a.text(row), self.b.text(row)];
        if a == b {
            let help = "compare two different methods, or remove the row";
            return Err(self.data.wrong_cell(self.b, row, "another method than method_a", help));
        }
        let outcome = self.named(row, a, b)?;
        if outcome == Outcome::Tie && self.ties == Ties::Error {
            let help = "choose how ties count: --ties drop or --ties half";
            let wanted = "a decision, which --ties error asks for";
            return Err(self.data.wrong_cell(self.answer, row, wanted, help));
        }
        Ok(outcome)
    }

    fn named(&self, row: usize, a: &str, b: &str) -> Result<Outcome, StudyError> {
        let answer = self.answer.text(row);
        let by_letter = match answer {
            "a" => Some(Outcome::A),
            "b" => Some(Outcome::B),
            "tie" => Some(Outcome::Tie),
            _ => None,
        };
        let by_name = match answer {
            _ if answer == a => Some(Outcome::A),
            _ if answer == b => Some(Outcome::B),
            _ => None,
        };
        match (by_letter, by_name) {
            (Some(letter), Some(name)) if letter != name => {
                let wanted = "clear, because it is also the name of a method";
                let help = "rename the methods that are called a, b or tie";
                Err(self.data.wrong_cell(self.answer, row, wanted, help))
            }
            (Some(outcome), _) | (None, Some(outcome)) => Ok(outcome),
            (None, None) => {
                let wanted = format!("an answer: a, b, {a}, {b} or tie");
                let help = "correct the answer, or remove the row";
                Err(self.data.wrong_cell(self.answer, row, &wanted, help))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Selection, Table};

    fn read(csv: &str, ties: Ties) -> Result<Votes, StudyError> {
        let table = Table::read("v.csv", csv.as_bytes()).unwrap();
        let selection = Selection::default();
        Votes::read(&Data::new(&table, &selection).unwrap(), ties, &[])
    }

    #[test]
    fn answers_are_letters_names_or_ties() {
        let csv = "participant,method_a,method_b,answer,n\nP1,X,Y,a,2\nP1,Y,X,X,1\nP2,X,Y,tie,1\n";
        let votes = read(csv, Ties::Half).unwrap();
        assert_eq!(votes.methods.names(), ["X", "Y"]);
        let outcomes: Vec<_> = votes.votes.iter().map(|vote| vote.outcome).collect();
        assert_eq!(outcomes, [Outcome::A, Outcome::B, Outcome::Tie]);
        let by = votes.by_participant();
        assert_eq!(by, [vec![(1, 3.0)], vec![(1, 0.5), (2, 0.5)]]);
        assert_eq!(wins(&by, &[1, 1], 2), [0.0, 1.0, 1.0, 0.0]);
        let error = read(csv, Ties::Error).unwrap_err();
        assert!(error.to_string().contains("line 4") && error.help().contains("--ties half"));
    }

    #[test]
    fn unclear_answers_are_errors() {
        let error = |row: &str| {
            let csv = format!("participant,method_a,method_b,answer\n{row}\n");
            read(&csv, Ties::Drop).unwrap_err().to_string()
        };
        assert!(error("P1,X,Y,Z").contains("an answer: a, b, X, Y or tie"));
        assert!(error("P1,X,Y,").contains("column \"answer\""));
        assert!(error("P1,X,X,a").contains("another method"));
        assert!(error("P1,b,a,a").contains("name of a method"));
        assert!(error(",X,Y,a").contains("participant"));
    }
}
