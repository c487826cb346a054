//! Numbers in columns whose decimal points are aligned.
//!
//! Columns are aligned to the right. What is missing after a number (decimals, a power of ten, a
//! standard deviation) is filled with `\phantom`, so that all points of a column stand below each
//! other. Bold digits are wider than others: `\fovqabest` prints the bold decimals into the space
//! of normal ones.

use super::width::width;

/// A number, with the marks of the best values.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Number {
    /// The value, such as `-24.70`, `3.39e-3`, `inf` or `–`.
    pub(crate) value: String,
    /// The standard deviation, written in the same way; empty for none.
    pub(crate) spread: String,
    pub(crate) is_best: bool,
    pub(crate) is_second: bool,
}

/// The command that prints the best value of a column.
pub(super) const BEST: &str =
    "\\providecommand{\\fovqabest}[2]{\\textbf{#1}\\rlap{\\textbf{#2}}\\phantom{#2}}\n";

/// The parts of a number.
struct Parts<'a> {
    whole: &'a str,
    /// The decimals, without the point.
    decimals: &'a str,
    /// The power of ten; empty for none.
    power: &'a str,
}

impl<'a> Parts<'a> {
    fn of(number: &'a str) -> Self {
        let (digits, power) = number.split_once('e').unwrap_or((number, ""));
        let (whole, decimals) = digits.split_once('.').unwrap_or((digits, ""));
        Self { whole, decimals, power }
    }
}

/// What the numbers of a column have at most.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Fill {
    decimals: usize,
    power: usize,
    has_spread: bool,
    spread_whole: usize,
    spread_decimals: usize,
    spread_power: usize,
}

impl Fill {
    pub(super) fn of<'a>(numbers: impl Iterator<Item = &'a Number>) -> Self {
        let mut fill = Self::default();
        for number in numbers {
            let value = Parts::of(&number.value);
            fill.decimals = fill.decimals.max(value.decimals.len());
            fill.power = fill.power.max(value.power.len());
            if !number.spread.is_empty() {
                let spread = Parts::of(&number.spread);
                fill.has_spread = true;
                fill.spread_whole = fill.spread_whole.max(spread.whole.len());
                fill.spread_decimals = fill.spread_decimals.max(spread.decimals.len());
                fill.spread_power = fill.spread_power.max(spread.power.len());
            }
        }
        fill
    }

    /// The width of a number in points.
    pub(super) fn width(&self, number: &Number) -> f64 {
        let point = if self.decimals > 0 { 2.78 } else { 0.0 };
        let digits = |count: usize| 5.0 * count as f64;
        let power = |length: usize| if length > 0 { 20.0 + 0.8 * digits(length) } else { 0.0 };
        let whole = width(Parts::of(&number.value).whole).max(10.0);
        let value = 1.15 * whole + point + 1.15 * digits(self.decimals) + power(self.power);
        let spread = if self.has_spread {
            let digits = digits(self.spread_whole + self.spread_decimals);
            6.5 + 0.85 * (7.8 + 2.8 + digits) + power(self.spread_power)
        } else {
            0.0
        };
        value + spread
    }

    /// The LaTeX text of a number.
    pub(super) fn text(&self, number: &Number) -> String {
        let parts = Parts::of(&number.value);
        let point = if parts.decimals.is_empty() { "" } else { "." };
        let mut text = marked(number, &parts, point);
        let mut missing = String::new();
        if parts.decimals.is_empty() && self.decimals > 0 {
            missing.push('.');
        }
        missing.push_str(&"0".repeat(self.decimals - parts.decimals.len()));
        let power = power(parts.power, self.power);
        if parts.power.is_empty() {
            missing.push_str(&power);
        } else {
            fill(&mut text, &mut missing);
            text.push_str(&power);
        }
        if self.has_spread {
            if number.spread.is_empty() {
                missing.push_str(&self.spread(&"0".repeat(self.spread_whole)));
            } else {
                fill(&mut text, &mut missing);
                text.push_str(&self.spread(&number.spread));
            }
        }
        fill(&mut text, &mut missing);
        text
    }

    fn spread(&self, spread: &str) -> String {
        let parts = Parts::of(spread);
        let mut text = String::from("\\kern.65em{\\scriptsize$\\pm$");
        fill(&mut text, &mut "0".repeat(self.spread_whole.saturating_sub(parts.whole.len())));
        text.push_str(&sign(parts.whole));
        let point = if self.spread_decimals > 0 { "." } else { "" };
        let mut missing = String::new();
        if parts.decimals.is_empty() {
            missing.push_str(point);
        } else {
            text.push('.');
            text.push_str(parts.decimals);
        }
        missing.push_str(&"0".repeat(self.spread_decimals - parts.decimals.len()));
        let power = power(parts.power, self.spread_power);
        if parts.power.is_empty() {
            missing.push_str(&power);
            fill(&mut text, &mut missing);
        } else {
            fill(&mut text, &mut missing);
            text.push_str(&power);
        }
        text.push('}');
        text
    }
}

/// Adds the space of missing digits.
fn fill(text: &mut String, missing: &mut String) {
    if !missing.is_empty() {
        text.extend(["\\phantom{", missing, "}"]);
        missing.clear();
    }
}

/// A power of ten; if there is none, as wide as one of so many characters.
fn power(power: &str, longest: usize) -> String {
    if longest == 0 {
        return String::new();
    }
    let missing = longest - power.len();
    let space =
        if missing > 0 { format!("\\phantom{{{}}}", "0".repeat(missing)) } else { String::new() };
    format!("$\\,\\cdot 10^{{{power}{space}}}$")
}

/// The number without its decimals, with a minus sign in place of a hyphen.
fn sign(whole: &str) -> String {
    match whole {
        "inf" => "$\\infty$".to_owned(),
        "-inf" => "$-\\infty$".to_owned(),
        "–" => "--".to_owned(),
        whole => match whole.strip_prefix('-') {
            Some(digits) => format!("$-${}", grouped(digits)),
            None => grouped(whole),
        },
    }
}

/// Digits with the thin spaces between thousands that LaTeX has.
fn grouped(digits: &str) -> String {
    digits.replace('\u{202f}', "\\,")
}

/// The value as it is marked.
fn marked(number: &Number, parts: &Parts<'_>, point: &str) -> String {
    let whole = sign(parts.whole);
    let decimals = parts.decimals;
    if number.is_best {
        // Mathematics needs its own command for bold.
        let bold = if whole.contains('$') { "\\boldmath" } else { "" };
        if decimals.is_empty() {
            return format!("\\textbf{{{bold}{whole}}}");
        }
        return format!("\\fovqabest{{{bold}{whole}}}{{{point}{decimals}}}");
    }
    let plain = format!("{whole}{point}{decimals}");
    if number.is_second { format!("\\underline{{{plain}}}") } else { plain }
}

/// The power of ten by which all these values can be divided, so that each has at least one digit
/// before the point and none has more than three; `None` if there is no such power.
pub(crate) fn scaled(values: impl Iterator<Item = f64>) -> Option<i32> {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for value in values.map(f64::abs).filter(|value| *value > 0.0 && value.is_finite()) {
        (least, most) = (least.min(value), most.max(value));
    }
    // The digits are those that are printed, so that 9.999e-4 counts as 1.00e-3.
    let power: i32 = format!("{least:.2e}").split_once('e')?.1.parse().ok()?;
    (most < 999.0 * power_of_ten(power)).then_some(power)
}

/// A power of ten, the same on all machines.
pub(crate) fn power_of_ten(power: i32) -> f64 {
    format!("1e{power}").parse().unwrap_or(1.0)
}
