//! Names and titles made fit to draw: cleaned of what no text holds, and broken into lines.

use crate::canvas::text::{advance_em, width_px};

/// Characters of a name that are looked at: far beyond what is ever drawn, so that a runaway
/// name costs no time.
const LONGEST: usize = 2000;

/// Where a line may break, beside spaces: after these.
const BREAKS_AFTER: [char; 5] = [' ', '-', '_', '/', ','];

/// A name on one line: control characters dropped, white space single, nothing that XML forbids
/// or that turns the direction of what follows.
pub(crate) fn clean(text: &str) -> String {
    let spaced: String = text
        .chars()
        .take(LONGEST)
        .map(|c| if c.is_whitespace() { ' ' } else { c })
        .filter(|c| {
            !c.is_control() && !turns_direction(*c) && !matches!(c, '\u{fffe}' | '\u{ffff}')
        })
        .collect();
    spaced.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Whether a character overrides the direction of writing beyond itself.
fn turns_direction(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A cleaned text broken into lines of at most `width_px`: between words where it can, within a
/// word where it must. What `most_lines` cannot hold ends in "…". No lines for an empty text.
pub(crate) fn wrap(text: &str, size_px: f64, limit_px: f64, most_lines: usize) -> Vec<String> {
    let text = clean(text);
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split_inclusive(BREAKS_AFTER) {
        if fits(&format!("{line}{}", word.trim_end()), size_px, limit_px) {
            line.push_str(word);
            continue;
        }
        push_line(&mut lines, &mut line);
        for c in word.chars() {
            let zero_width = advance_em(c) <= 0.0;
            if !line.is_empty() && !zero_width && !fits(&format!("{line}{c}"), size_px, limit_px) {
                push_line(&mut lines, &mut line);
            }
            line.push(c);
        }
        if lines.len() > most_lines {
            break;
        }
    }
    push_line(&mut lines, &mut line);
    if lines.len() > most_lines {
        lines.truncate(most_lines);
        if let Some(last) = lines.last_mut() {
            while !last.is_empty() && !fits(&format!("{last}…"), size_px, limit_px) {
                last.pop();
            }
            last.push('…');
        }
    }
    lines
}

/// Whether [`wrap`] can break a text into lines of a width without breaking a word.
pub(crate) fn keeps_words(text: &str, size_px: f64, limit_px: f64) -> bool {
    let text = clean(text);
    text.split_inclusive(BREAKS_AFTER).all(|word| fits(word.trim_end(), size_px, limit_px))
}

/// The widest of some lines, in pixels.
pub(crate) fn widest_px(lines: &[String], size_px: f64) -> f64 {
    lines.iter().map(|line| width_px(line, size_px)).fold(0.0, f64::max)
}

fn fits(text: &str, size_px: f64, limit_px: f64) -> bool {
    width_px(text, size_px) <= limit_px
}

fn push_line(lines: &mut Vec<String>, line: &mut String) {
    let text = line.trim();
    if !text.is_empty() {
        lines.push(text.to_owned());
    }
    line.clear();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cleans() {
        assert_eq!(clean(" a\tb\r\n\u{0}c\u{7f}\u{202e} \u{fffe}d "), "a b c d");
        assert_eq!(clean("注視 レンダ עברית"), "注視 レンダ עברית");
    }

    #[test]
    fn breaks_between_words_then_within() {
        let width = width_px("wide words", 12.0) + 0.1;
        assert_eq!(wrap("wide words wide words", 12.0, width, 3), ["wide words", "wide words"]);
        let lines = wrap("incomprehensibilities", 12.0, width, 9);
        assert_eq!(lines.concat(), "incomprehensibilities");
        assert!(lines.len() > 1 && widest_px(&lines, 12.0) <= width);
        assert!(wrap(" \n", 12.0, width, 3).is_empty());
    }

    #[test]
    fn ends_in_dots_what_is_too_long() {
        let lines = wrap(&"word ".repeat(10_000), 12.0, 80.0, 3);
        assert_eq!(lines.len(), 3);
        assert!(lines[2].ends_with('…') && widest_px(&lines, 12.0) <= 80.0);
        // Narrower than a letter: still no endless loop.
        assert_eq!(wrap("ab", 12.0, 1.0, 5), ["a", "b"]);
    }
}
