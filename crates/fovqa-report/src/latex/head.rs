//! Headings: a line with the name, and a line with unit and better direction.

use super::Head;
use super::cells::wrapped;
use super::escape::escaped;
use super::width::{lines, width};

/// The width in points from which the name of a column is wrapped.
const WIDEST_NAME: f64 = 66.0;

impl Head {
    /// The name for a column of numbers.
    pub(super) fn name_text(&self) -> String {
        if width(&self.name) > WIDEST_NAME {
            wrapped(&self.name, WIDEST_NAME, 'b', "\\raggedleft")
        } else {
            escaped(&self.name)
        }
    }

    /// Unit, power of ten, and an arrow for the better direction.
    pub(super) fn unit_text(&self) -> String {
        let mut said: Vec<String> = Vec::new();
        let power = self.power.map(|power| format!("$10^{{{power}}}$"));
        let unit = Some(escaped(&self.unit)).filter(|unit| !unit.is_empty());
        let unit: Vec<String> = power.into_iter().chain(unit).collect();
        if !unit.is_empty() {
            said.push(format!("({})", unit.join(" ")));
        }
        match self.higher_is_better {
            Some(true) => said.push("$\\uparrow$".to_owned()),
            Some(false) => said.push("$\\downarrow$".to_owned()),
            None => {}
        }
        said.join(" ")
    }

    /// Name, unit and arrow in one line.
    pub(super) fn line(&self) -> String {
        let unit = self.unit_text();
        if unit.is_empty() {
            escaped(&self.name)
        } else {
            format!("{} {unit}", escaped(&self.name))
        }
    }

    /// The width of the name alone in points, as it is wrapped.
    pub(super) fn name_width(&self) -> f64 {
        width(&self.name).min(WIDEST_NAME)
    }

    /// The number of lines of the name.
    pub(super) fn name_lines(&self) -> usize {
        if width(&self.name) > WIDEST_NAME { lines(&self.name, WIDEST_NAME) } else { 1 }
    }

    pub(super) fn unit_width(&self) -> f64 {
        let power = if self.power.is_some() { 20.0 } else { 0.0 };
        let unit = if self.unit.is_empty() && self.power.is_none() {
            0.0
        } else {
            width(&self.unit) + 7.8 + power
        };
        unit + if self.higher_is_better.is_some() { 8.4 } else { 0.0 }
    }

    pub(super) fn line_width(&self) -> f64 {
        width(&self.name) + 3.4 + self.unit_width()
    }
}
