//! A table of a page, with what each number means and with the full values that it is sorted by.

use askama::Template;

/// A table that scrolls in a box of its own.
#[derive(Debug, Clone, PartialEq, Default, Template)]
#[template(path = "table.html")]
pub(crate) struct HtmlTable {
    /// Names the box.
    pub(crate) caption: String,
    /// Whether the box is lower than the table.
    pub(crate) is_long: bool,
    /// The heading of the first column, which names the rows.
    pub(crate) corner: Heading,
    /// The headings over neighbouring columns; empty for none.
    pub(crate) groups: Vec<GroupHeading>,
    /// The headings of the other columns.
    pub(crate) columns: Vec<HtmlColumn>,
    /// Rows are sorted within their section.
    pub(crate) sections: Vec<HtmlSection>,
    /// What the numbers mean: names, each with its explanation.
    pub(crate) explained: Vec<Heading>,
}

/// A heading, or a name with its explanation.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Heading {
    pub(crate) text: String,
    /// What the numbers below it mean; empty if that is plain.
    pub(crate) about: String,
}

/// A heading over neighbouring columns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GroupHeading {
    pub(crate) heading: Heading,
    /// Number of columns.
    pub(crate) span: usize,
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HtmlColumn {
    pub(crate) heading: Heading,
    /// Whether it has names instead of numbers.
    pub(crate) is_text: bool,
}

/// Rows that belong together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HtmlSection {
    /// The line above the rows; `None` for none.
    pub(crate) title: Option<Heading>,
    pub(crate) rows: Vec<HtmlRow>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HtmlRow {
    pub(crate) heading: Heading,
    /// Whether the row sums up the others. It keeps its place when they are sorted.
    pub(crate) is_average: bool,
    pub(crate) cells: Vec<HtmlCell>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HtmlCell {
    pub(crate) shown: String,
    /// The number with full precision, `inf`, or an empty text if it is missing; `None` for a name.
    pub(crate) value: Option<String>,
    /// The standard deviation with full precision; empty for none.
    pub(crate) spread: String,
    pub(crate) emphasis: Emphasis,
    /// Whether a group of columns begins here.
    pub(crate) begins_group: bool,
}

/// How a number stands out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Emphasis {
    None,
    Bold,
    Underlined,
}

impl Heading {
    /// A heading that explains itself.
    pub(crate) fn plain(text: impl Into<String>) -> Self {
        Self { text: text.into(), about: String::new() }
    }
}

/// A number as cells hold it, which is what programs read again to the last bit.
pub(crate) fn full(value: Option<f64>) -> String {
    value.map(|value| format!("{value:?}")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_what_they_are_sorted_by() {
        let cell = |shown: &str, value: Option<f64>| HtmlCell {
            shown: shown.to_owned(),
            value: Some(full(value)),
            spread: String::new(),
            emphasis: Emphasis::None,
            begins_group: false,
        };
        let spread = HtmlCell { spread: full(Some(0.25)), ..cell("0.10 ± 0.25", Some(0.1)) };
        let name = HtmlCell { value: None, ..cell("a<b", None) };
        let heading = Heading { text: "PSNR".to_owned(), about: "Of \"pixels\".".to_owned() };
        let row = HtmlRow {
            heading: Heading::plain("m"),
            is_average: true,
            cells: vec![spread, cell("inf", Some(f64::INFINITY)), cell("–", None), name],
        };
        let table = HtmlTable {
            columns: vec![HtmlColumn { heading, is_text: false }],
            sections: vec![HtmlSection { title: None, rows: vec![row] }],
            ..HtmlTable::default()
        };
        let text = table.render().unwrap();
        for wanted in [
            "<tr class=\"average\"><th scope=\"row\">m</th>\
             <td data-value=\"0.1\" title=\"0.1 ± 0.25\">0.10 ± 0.25</td>\
             <td data-value=\"inf\" title=\"inf\">inf</td><td data-value=\"\">–</td>\
             <td class=\"text\">a&#60;b</td></tr>",
            "<th scope=\"col\" data-column=\"1\" aria-sort=\"none\">\
             <button type=\"button\" title=\"Of &#34;pixels&#34;.\">PSNR</button></th>",
        ] {
            assert!(text.contains(wanted), "{wanted}\n{text}");
        }
    }
}
