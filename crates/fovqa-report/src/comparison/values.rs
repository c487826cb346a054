//! The values that a table shows: by scene (or eccentricity band), measure and method.

use super::marks::{Mark, marks};
use super::measure::{Digits, Measure};

/// The values of a table, before a layout arranges them in rows and columns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Values {
    /// What the items are.
    pub(super) items_are: Items,
    pub(super) items: Vec<Item>,
    pub(super) measures: Vec<Measure>,
    pub(super) methods: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Items {
    Scenes,
    Bands,
}

impl Items {
    /// The heading of a column with the names of the items.
    pub(super) fn heading(self) -> &'static str {
        match self {
            Self::Scenes => "scene",
            Self::Bands => "eccentricity",
        }
    }
}

/// A scene or a band, or an average over them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Item {
    /// Its name as a row or column.
    pub(super) label: String,
    /// Its name above the rows of all methods.
    pub(super) title: String,
    /// Its name in CSV, which programs look up.
    pub(super) name: String,
    /// The eye, in a scene with two.
    pub(super) eye: Option<ItemEye>,
    /// Whether it sums up the others.
    pub(super) is_average: bool,
    /// The cells, by measure and then by method.
    pub(super) cells: Vec<Vec<Cell>>,
}

impl Item {
    /// An item with the same name everywhere.
    pub(super) fn new(name: String, cells: Vec<Vec<Cell>>) -> Self {
        let (label, title) = (name.clone(), name.clone());
        Self { label, title, name, eye: None, is_average: false, cells }
    }

    /// Whether the values belong to a scene as a whole, as averages need them.
    pub(super) fn is_of_whole_scene(&self) -> bool {
        matches!(self.eye, None | Some(ItemEye::Both))
    }
}

/// What the values of a scene with two eyes belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ItemEye {
    Left,
    Right,
    /// Both together.
    Both,
}

impl ItemEye {
    pub(super) const ALL: [Self; 3] = [Self::Left, Self::Right, Self::Both];

    /// Its name in results.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Both => "both",
        }
    }

    /// Its name for people.
    pub(super) fn in_words(self) -> &'static str {
        match self {
            Self::Left => "left eye",
            Self::Right => "right eye",
            Self::Both => "both eyes",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cell {
    pub(super) value: Option<f64>,
    /// The standard deviation, if it is shown.
    pub(super) spread: Option<f64>,
    pub(super) mark: Mark,
    /// The index of the measure.
    pub(super) measure: usize,
    pub(super) digits: Digits,
}

impl Cell {
    /// The value as text for people, such as `24.70` or `24.70 ± 0.12`.
    pub(super) fn shown(&self) -> String {
        let value = self.digits.shown(self.value);
        match self.spread {
            None => value,
            Some(spread) => format!("{value} ± {}", self.digits.shown(Some(spread))),
        }
    }
}

/// A value with its standard deviation.
pub(super) type Scored = (Option<f64>, Option<f64>);

/// The cells of all methods for one measure, with the best ones marked.
pub(super) fn marked(index: usize, measure: &Measure, scored: &[Scored]) -> Vec<Cell> {
    let values: Vec<Option<f64>> = scored.iter().map(|(value, _)| *value).collect();
    let marks = marks(measure, &values).into_iter();
    let cell = |(&(value, spread), mark): (&Scored, Mark)| Cell {
        value,
        spread: spread.filter(|_| value.is_some_and(f64::is_finite)),
        mark,
        measure: index,
        digits: measure.digits,
    };
    scored.iter().zip(marks).map(cell).collect()
}

/// The arithmetic mean; `None` if there are no values. It is infinite if any value is, so that a
/// perfect result in one scene does not lower the average.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The standard deviation of a sample (divided by n - 1); `None` for fewer than two values, or if
/// one is infinite.
pub(super) fn deviation(values: &[f64]) -> Option<f64> {
    let centre = mean(values).filter(|mean| values.len() > 1 && mean.is_finite())?;
    let squares: f64 = values.iter().map(|value| (value - centre) * (value - centre)).sum();
    Some((squares / (values.len() - 1) as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_those_of_a_sample() {
        let found = deviation(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]).unwrap();
        assert!((found - (32.0f64 / 7.0).sqrt()).abs() < 1e-12);
        assert_eq!(deviation(&[3.0]), None);
        assert_eq!(deviation(&[]), None);
        assert_eq!(deviation(&[3.0, f64::INFINITY]), None);
    }
}
