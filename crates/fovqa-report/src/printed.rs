//! A number as a paper prints it, and what is to be said of a computed one beside it.
//!
//! What counts are the printed digits: "14.8 %" is any number from 14.75 to 14.85, ties included,
//! since they may be rounded either way; a
//! fraction counts as its hundredths: "3/4" is 0.75. "Up to" and "over" are bounds.

/// What is to be said of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PrintedVerdict {
    /// The computed number gives the printed digits.
    Reproduced,
    /// It gives them, but something that went into it was read off them.
    NotIndependent,
    /// It does not, but is within [`Printed::CLOSE`].
    Close,
    /// It is not.
    NotReproduced,
    /// What it is computed from was not given.
    NotChecked,
}

impl PrintedVerdict {
    /// The verdict in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::NotIndependent => "not independent",
            Self::Close => "close",
            Self::NotReproduced => "not reproduced",
            Self::NotChecked => "not checked",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sense {
    Rounded,
    Truncated,
    Below,
    UpTo,
    Above,
}

/// A number as it is printed.
#[derive(Debug, Clone, PartialEq)]
pub struct Printed {
    text: String,
    /// NaN when the text is no number: nothing gives its digits then.
    value: f64,
    /// What one more in the last digit is.
    step: f64,
    unit: String,
    sense: Sense,
}

impl Printed {
    /// The largest relative error of a computed number that is called close.
    pub const CLOSE: f64 = 1e-3;

    /// A number that was rounded: "1,061,735", "14.8 %", "3/4"; or a bound: "< .01", "> .05",
    /// "up to 50 %", "over 50 %".
    pub fn new(text: &str) -> Self {
        let bounds = [
            ("< ", Sense::Below),
            ("up to ", Sense::UpTo),
            ("> ", Sense::Above),
            ("over ", Sense::Above),
        ];
        let bound =
            bounds.iter().find_map(|(word, sense)| Some((*sense, text.strip_prefix(word)?)));
        let (sense, number) = bound.unwrap_or((Sense::Rounded, text));
        let end = number.find(|c: char| !c.is_ascii_digit() && !"., /".contains(c));
        let (digits, _) = number.split_at(end.unwrap_or(number.len()));
        let digits = digits.trim_end();
        let (value, step) = value_and_step(digits);
        let unit = number[digits.len()..].to_owned();
        Self { text: text.to_owned(), value, step, unit, sense }
    }

    /// A number whose further digits were cut off.
    pub fn truncated(text: &str) -> Self {
        Self { sense: Sense::Truncated, ..Self::new(text) }
    }

    /// A number that is said in words.
    pub fn in_words(words: &str, number: &str) -> Self {
        Self { text: words.to_owned(), ..Self::new(number) }
    }

    /// As it is printed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its value, in its unit. NaN when it is no number.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// What stands behind the digits, with its space: " %", "°".
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// What a number in the same unit is beside it.
    pub fn verdict(&self, computed: f64) -> PrintedVerdict {
        // Less than a number is off by its own computation.
        let slack = 1e-9 * self.value.abs().max(self.step);
        let above = computed - self.value;
        let holds = match self.sense {
            Sense::Rounded => above.abs() <= self.step / 2.0 + slack,
            Sense::Truncated => above >= -slack && above < self.step - slack,
            Sense::Below => computed < self.value,
            Sense::UpTo => computed <= self.value + slack,
            Sense::Above => computed > self.value,
        };
        let close = self.relative_error(computed).is_some_and(|error| error.abs() <= Self::CLOSE);
        match (holds, close) {
            (true, _) => PrintedVerdict::Reproduced,
            (false, true) => PrintedVerdict::Close,
            (false, false) => PrintedVerdict::NotReproduced,
        }
    }

    /// How far a number in the same unit is above it, relative to it. A bound has no such error.
    pub fn relative_error(&self, computed: f64) -> Option<f64> {
        let number = matches!(self.sense, Sense::Rounded | Sense::Truncated);
        number.then(|| computed / self.value - 1.0)
    }
}

fn value_and_step(digits: &str) -> (f64, f64) {
    let number = |text: &str| text.parse().unwrap_or(f64::NAN);
    if let Some((above, below)) = digits.split_once('/') {
        return (number(above) / number(below), 0.01);
    }
    let decimals = digits.split_once('.').map_or(0, |(_, behind)| behind.len());
    let step = (0..decimals).fold(1.0, |step, _| step / 10.0);
    (number(&digits.replace(',', "")), step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn held(printed: &Printed, computed: &[f64]) {
        for computed in computed {
            assert_eq!(
                printed.verdict(*computed),
                PrintedVerdict::Reproduced,
                "{printed:?} {computed}"
            );
        }
    }

    fn refused(printed: &Printed, computed: &[f64]) {
        for computed in computed {
            let verdict = printed.verdict(*computed);
            assert_eq!(verdict, PrintedVerdict::NotReproduced, "{printed:?} {computed}");
        }
    }

    #[test]
    fn reads_numbers_as_they_are_printed() {
        for (text, value, step, unit) in [
            ("1,061,735", 1_061_735.0, 1.0, ""),
            ("14.8 %", 14.8, 0.1, " %"),
            (".637", 0.637, 0.001, ""),
            ("45°", 45.0, 1.0, "°"),
            ("1.83x", 1.83, 0.01, "x"),
            ("3/4", 0.75, 0.01, ""),
            ("up to 50 %", 50.0, 1.0, " %"),
            ("< .01", 0.01, 0.01, ""),
            ("76.8 M", 76.8, 0.1, " M"),
            ("1 arcmin", 1.0, 1.0, " arcmin"),
        ] {
            let printed = Printed::new(text);
            assert!((printed.value - value).abs() < 1e-12 * value, "{printed:?}");
            assert!((printed.step - step).abs() < 1e-12 * step, "{printed:?}");
            assert_eq!((printed.unit.as_str(), printed.text.as_str()), (unit, text));
        }
        assert!(Printed::new("n/a").value.is_nan() && Printed::new("").value.is_nan());
        refused(&Printed::new("n/a"), &[0.0, f64::NAN, f64::INFINITY]);
    }

    #[test]
    fn rounded_digits_take_half_a_step_on_both_sides() {
        held(&Printed::new("14.8 %"), &[14.75, 14.8, 14.85, 14.849]);
        refused(&Printed::new("14.8 %"), &[14.74, 14.86, f64::NAN]);
        held(&Printed::new("3/4"), &[0.7451, 0.7549]);
        refused(&Printed::new("3/4"), &[0.734, 0.76]);
    }

    #[test]
    fn truncated_digits_take_a_step_above() {
        // 2559.999… is 2560 to the computer.
        held(&Printed::truncated("2560"), &[2560.0, 2560.999, 2_559.999_999_999_9]);
        assert_eq!(Printed::truncated("2560").verdict(2559.9), PrintedVerdict::Close);
        refused(&Printed::truncated("761"), &[760.0, 762.0, 761.999_999_999_99]);
    }

    #[test]
    fn bounds_are_bounds() {
        held(&Printed::new("< .01"), &[0.0029]);
        refused(&Printed::new("< .01"), &[0.0128, 0.010_000_1]);
        held(&Printed::new("> .05"), &[0.906]);
        refused(&Printed::new("> .05"), &[0.05, 0.01]);
        held(&Printed::new("up to 50 %"), &[45.0, 50.0]);
        refused(&Printed::new("up to 70 %"), &[73.4]);
        held(&Printed::new("over 50 %"), &[50.1]);
        refused(&Printed::new("over 50 %"), &[50.0]);
        assert_eq!(Printed::new("< .01").relative_error(0.5), None);
    }

    #[test]
    fn close_is_a_thousandth() {
        let printed = Printed::new("1,061,735");
        assert_eq!(printed.verdict(1_061_733.7), PrintedVerdict::Close);
        assert_eq!(printed.verdict(1_061_735.0 * 1.000_99), PrintedVerdict::Close);
        assert_eq!(printed.verdict(1_061_735.0 * 0.998_9), PrintedVerdict::NotReproduced);
        assert_eq!(printed.relative_error(2.0 * 1_061_735.0), Some(1.0));
    }
}
