//! Brackets of significance between bars.

use fovqa_plot::Bracket;
use fovqa_study::adjust::stars;

/// The most brackets of a figure, so that they do not take more room than its bars.
const MOST_BRACKETS: usize = 10;

/// The test of two bars.
pub(super) struct Compared<'a> {
    pub(super) names: [&'a str; 2],
    pub(super) p_adjusted: Option<f64>,
}

/// The brackets of significant tests between named bars, and a phrase about those left out. The
/// smallest p-values have brackets.
pub(super) fn brackets<'a>(
    bars: &[&str],
    tests: impl Iterator<Item = Compared<'a>>,
) -> (Vec<Bracket>, String) {
    let place = |name: &str| bars.iter().position(|bar| *bar == name);
    let mut found: Vec<(f64, [usize; 2])> = Vec::new();
    for test in tests {
        let ends = place(test.names[0]).zip(place(test.names[1]));
        if let (Some((a, b)), Some(p)) = (ends, test.p_adjusted)
            && !stars(Some(p)).is_empty()
        {
            found.push((p, [a, b]));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let more = found.len().saturating_sub(MOST_BRACKETS);
    let phrase = match more {
        0 => String::new(),
        more => format!("{more} more pairs with p < .05 have no bracket"),
    };
    let bracket = |(p, [a, b]): (f64, [usize; 2])| Bracket {
        ends: [[a, 0], [b, 0]],
        label: stars(Some(p)).to_owned(),
    };
    (found.into_iter().take(MOST_BRACKETS).map(bracket).collect(), phrase)
}
