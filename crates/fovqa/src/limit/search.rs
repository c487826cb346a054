//! The search for the value of a key at which a rule begins to fail, among values that were measured.

/// What was measured at a value of the key.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measured<T> {
    /// The value of the key.
    pub(super) at: f64,
    /// The value that the rule judges.
    pub(super) value: f64,
    /// Whether the rule holds.
    pub(super) holds: bool,
    /// What else is known about it.
    pub(super) of: T,
}

/// Which values of the key save more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Saves {
    /// Lower ones, as of a budget.
    Low,
    /// Higher ones, as of σ.
    High,
}

/// Where the rule begins to fail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Place {
    /// Between these indices of what was measured: at the first it holds, at the second it fails.
    Between(usize, usize),
    /// It holds up to the end that saves most.
    Always,
    /// It holds nowhere.
    Never,
}

/// Share of the range of values by which a metric may go the wrong way and still count as monotone. The
/// sizes of buffers are whole numbers, so that it is never quite so.
const SLACK: f64 = 0.01;

/// The values that were measured for one rule in one comparison, in ascending order of the key.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Search<T> {
    pub(super) measured: Vec<Measured<T>>,
    /// Which values save more, if that is known before anything is measured.
    known: Option<Saves>,
}

impl<T> Search<T> {
    pub(super) fn new(known: Option<Saves>) -> Self {
        Self { measured: Vec::new(), known }
    }

    pub(super) fn add(&mut self, measured: Measured<T>) {
        let place = self.measured.partition_point(|other| other.at < measured.at);
        self.measured.insert(place, measured);
    }

    /// Which values save more: those at the end at which the rule fails.
    pub(super) fn saves(&self) -> Saves {
        let ends = self.measured.first().zip(self.measured.last());
        let guess = match ends {
            Some((first, last)) if first.holds && !last.holds => Saves::High,
            _ => Saves::Low,
        };
        self.known.unwrap_or(guess)
    }

    /// Where the rule begins to fail, coming from the end that saves least.
    pub(super) fn place(&self) -> Place {
        let count = self.measured.len();
        let index = |nth: usize| match self.saves() {
            Saves::High => nth,
            Saves::Low => count - 1 - nth,
        };
        let holds = |nth: &usize| self.measured[index(*nth)].holds;
        let Some(first) = (0..count).find(holds) else { return Place::Never };
        match (first..count).find(|nth| !holds(nth)) {
            Some(failing) => Place::Between(index(failing - 1), index(failing)),
            None => Place::Always,
        }
    }

    /// The next value to measure: the middle of the place, in ratios if both ends are above 0. `None` if
    /// the place is known to within `tolerance`, a share of the value at which the rule holds.
    pub(super) fn next(&self, tolerance: f64) -> Option<f64> {
        let Place::Between(holds, fails) = self.place() else { return None };
        let (holds, fails) = (self.measured[holds].at, self.measured[fails].at);
        if (holds - fails).abs() <= tolerance * holds.abs() {
            return None;
        }
        let middle = if holds > 0.0 && fails > 0.0 {
            (holds * fails).sqrt()
        } else {
            holds / 2.0 + fails / 2.0
        };
        // Two neighbouring numbers have nothing between them.
        let between = holds.min(fails) < middle && middle < holds.max(fails);
        between.then_some(middle)
    }

    /// Whether the rule changes once only, and the value never goes the wrong way by more than a
    /// hundredth of its range.
    pub(super) fn is_monotone(&self) -> bool {
        let changes = self.measured.windows(2).filter(|pair| pair[0].holds != pair[1].holds);
        let values: Vec<f64> =
            self.measured.iter().map(|of| of.value).filter(|value| value.is_finite()).collect();
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (Some(first), Some(last)) = (values.first(), values.last()) else { return true };
        let sign = if last < first { -1.0 } else { 1.0 };
        // The furthest that was reached so far, in the direction of the whole.
        let mut furthest = f64::NEG_INFINITY;
        let turns = values.iter().any(|value| {
            let value = sign * value;
            furthest = furthest.max(value);
            furthest - value > SLACK * (high - low)
        });
        changes.count() <= 1 && !turns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn searched(known: Option<Saves>, value: fn(f64) -> f64, least: f64, at: &[f64]) -> Search<()> {
        let mut search = Search::new(known);
        for &at in at {
            let value = value(at);
            search.add(Measured { at, value, holds: value >= least, of: () });
        }
        search
    }

    /// Measures until the place is known, and returns the value at which the rule holds.
    fn found(mut search: Search<()>, value: fn(f64) -> f64, least: f64) -> f64 {
        while let Some(at) = search.next(1e-4) {
            let value = value(at);
            search.add(Measured { at, value, holds: value >= least, of: () });
        }
        let Place::Between(holds, _) = search.place() else { panic!("there is a place") };
        search.measured[holds].at
    }

    #[test]
    fn the_smallest_budget_is_found() {
        let value = |budget: f64| 30.0 + 10.0 * budget.log10();
        let search = searched(Some(Saves::Low), value, 20.0, &[1.0, 0.01, 0.3]);
        assert!(search.is_monotone());
        let found = found(search, value, 20.0);
        assert!((0.1..0.1001).contains(&found), "{found}");
    }

    #[test]
    fn the_largest_parameter_is_found() {
        let value = |sigma: f64| 40.0 - sigma;
        let search = searched(None, value, 37.0, &[1.0, 8.0]);
        assert_eq!(search.saves(), Saves::High);
        let found = found(search, value, 37.0);
        assert!((2.9997..=3.0).contains(&found), "{found}");
    }

    #[test]
    fn of_several_places_the_one_next_to_the_safe_end_is_found() {
        // It fails from 0.4 to 0.6 and below 0.2.
        let value = |at: f64| if (0.4..0.6).contains(&at) || at < 0.2 { 0.0 } else { 1.0 };
        let at: Vec<f64> = (1..=10).map(|i| f64::from(i) / 10.0).collect();
        let search = searched(Some(Saves::Low), value, 0.5, &at);
        assert!(!search.is_monotone());
        let found = found(search, value, 0.5);
        assert!((0.6..0.6001).contains(&found), "{found}");
    }

    #[test]
    fn always_and_never() {
        let all = searched(Some(Saves::Low), |_| 1.0, 0.5, &[0.1, 1.0]);
        assert_eq!((all.place(), all.next(1e-3)), (Place::Always, None));
        let none = searched(Some(Saves::Low), |_| 0.0, 0.5, &[0.1, 1.0]);
        assert_eq!((none.place(), none.next(1e-3)), (Place::Never, None));
    }

    #[test]
    fn a_value_that_turns_is_not_monotone_even_if_the_rule_changes_once() {
        let turns = |at: f64| if at > 0.5 { 2.0 - at } else { at };
        let search = searched(Some(Saves::Low), turns, 0.2, &[0.1, 0.3, 0.5, 0.7, 0.9, 1.0]);
        assert!(!search.is_monotone());
        let ripple = |at: f64| at + 0.001 * (at * 40.0).sin();
        let search = searched(Some(Saves::Low), ripple, 0.2, &[0.1, 0.3, 0.5, 0.7, 0.9, 1.0]);
        assert!(search.is_monotone());
    }
}
