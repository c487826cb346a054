//! Prepares names and titles for drawing: removes characters that text cannot contain, and breaks
//! lines.

use crate::canvas::text::{advance_em, width_px};

/// The number of characters of a name that are considered. This is far more than is ever drawn, and
/// limits the time for extremely long names.
const LONGEST: usize = 2000;

/// Characters after which a line may break.
const BREAKS_AFTER: [char; 5] = [' ', '-', '_', '/', ','];

/// A name on one line: without control characters, with single spaces, and without characters that
/// XML forbids or that change the direction of the following text.
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

/// Whether a character overrides the direction of the text after it.
fn turns_direction(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Breaks a cleaned text into lines of at most `limit_px`: between words if possible, otherwise
/// within a word. Text that does not fit into `most_lines` is cut and ends in "…". An empty text
/// has no lines.
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
    if let Some((before, within)) = text.split_once(" (")
        && lines.len() == 2
    {
        // What is in parentheses stands alone rather than the last word of it.
        let parts = [before.to_owned(), format!("({within}")];
        if parts.iter().all(|part| fits(part, size_px, limit_px)) {
            return parts.to_vec();
        }
    }
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

/// Whether [`wrap`] can break a text into lines of this width without breaking a word.
pub(crate) fn keeps_words(text: &str, size_px: f64, limit_px: f64) -> bool {
    let text = clean(text);
    text.split_inclusive(BREAKS_AFTER).all(|word| fits(word.trim_end(), size_px, limit_px))
}

/// The width of the widest line in pixels.
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
    fn parentheses_stay_together() {
        let wrapped = |px: f64| wrap("PSNR in dB (higher is better)", 12.0, px, 3);
        assert_eq!(wrapped(400.0), ["PSNR in dB (higher is better)"]);
        assert_eq!(wrapped(130.0), ["PSNR in dB", "(higher is better)"]);
        assert_eq!(wrapped(90.0), ["PSNR in dB", "(higher is", "better)"]);
    }

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
    fn long_text_ends_in_dots() {
        let lines = wrap(&"word ".repeat(10_000), 12.0, 80.0, 3);
        assert_eq!(lines.len(), 3);
        assert!(lines[2].ends_with('…') && widest_px(&lines, 12.0) <= 80.0);
        // A limit narrower than a letter does not cause an endless loop.
        assert_eq!(wrap("ab", 12.0, 1.0, 5), ["a", "b"]);
    }
}
