//! What figures do not show as expected, in words: axes without any value between their ends, and
//! characters that the font lacks.

use std::collections::BTreeSet;

use fovqa_plot::Unseen;

/// States which charts of a figure show none of their values; `None` if each shows some.
pub(crate) fn unseen_in_words(unseen: &[Unseen]) -> Option<String> {
    let first = unseen.first()?;
    let axis = |name: &str, ends: [Option<f64>; 2]| match ends {
        [Some(min), Some(max)] => Some(format!("{name} from {min} to {max}")),
        [Some(min), None] => Some(format!("{name} from {min}")),
        [None, Some(max)] => Some(format!("{name} up to {max}")),
        [None, None] => None,
    };
    let axes = [axis("x", first.x_ends), axis("y", first.y_ends)];
    let axes = axes.into_iter().flatten().collect::<Vec<_>>().join(", ");
    let values = |name: &str, range: Option<(f64, f64)>| {
        let (low, high) = range?;
        Some(format!("{name} {} to {}", short(low), short(high)))
    };
    let values = [values("x", first.x), values("y", first.y)];
    let values = values.into_iter().flatten().collect::<Vec<_>>().join(" and ");
    let what = match (&first.panel, unseen.len()) {
        (None, 1) => "the figure is empty".to_owned(),
        (Some(panel), 1) => format!("the panel \"{panel}\" is empty"),
        (_, count) => format!("{count} panels are empty"),
    };
    Some(format!("{what}: no value is within its axes ({axes}); the values are at {values}"))
}

/// A number with four digits.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// States which characters the font of figures lacks, and in which figures; `None` if it has all.
pub(crate) fn missing_in_words<'a>(
    figures: impl Iterator<Item = (&'a str, &'a BTreeSet<char>)>,
) -> Option<String> {
    const SHOWN: usize = 3;
    const CHARACTERS: usize = 12;
    let mut characters: BTreeSet<char> = BTreeSet::new();
    let mut names: Vec<&str> = Vec::new();
    for (name, missing) in figures.filter(|(_, missing)| !missing.is_empty()) {
        characters.extend(missing);
        names.push(name);
    }
    let quoted: Vec<String> =
        characters.iter().take(CHARACTERS).map(|character| format!("\"{character}\"")).collect();
    let more = characters.len().saturating_sub(CHARACTERS);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let (shown, others) = names.split_at(names.len().min(SHOWN));
    let others =
        if others.is_empty() { String::new() } else { format!(" and {} more", others.len()) };
    (!names.is_empty()).then(|| {
        format!(
            "the font of figures has no {}{more}: PDF and PNG show boxes for them, in {}{others}; \
             use other names, or the SVG, which leaves them to the fonts of the viewer",
            quoted.join(", "),
            shown.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_axes_are_named_with_their_ends() {
        let unseen = Unseen {
            panel: None,
            x_ends: [Some(80.0), Some(90.0)],
            y_ends: [None, None],
            x: Some((2.5, 57.5)),
            y: Some((30.123_456, 36.0)),
        };
        let said = "the figure is empty: no value is within its axes (x from 80 to 90); \
                    the values are at x 2.5 to 57.5 and y 30.12 to 36";
        assert_eq!(unseen_in_words(std::slice::from_ref(&unseen)).as_deref(), Some(said));
        let panel = Unseen { panel: Some("Level 1".to_owned()), ..unseen };
        let two = unseen_in_words(&[panel.clone(), panel]).unwrap();
        assert!(two.starts_with("2 panels are empty"), "{two}");
        assert_eq!(unseen_in_words(&[]), None);
    }

    #[test]
    fn missing_characters_are_named_once() {
        let set = |text: &str| text.chars().collect::<BTreeSet<char>>();
        let sets = [("a", set("漢字")), ("b", set("")), ("c", set("漢"))];
        let said = missing_in_words(sets.iter().map(|(name, set)| (*name, set))).unwrap();
        assert!(said.contains("no \"字\", \"漢\": ") && said.contains("in a, c;"), "{said}");
        assert_eq!(missing_in_words(sets[1..2].iter().map(|(name, set)| (*name, set))), None);
    }
}
