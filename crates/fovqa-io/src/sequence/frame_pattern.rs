//! File names with a placeholder for the frame number: `gt.%04d.exr`, `gt.####.exr`, `gt.@@@@.exr`,
//! `gt.$F4.exr`.
//!
//! `*` and `?` stand for text that changes besides the number: `f%04d_t*.png`.

use std::collections::BTreeMap;

use fovqa_frame::source::{Doubt, Numbering};

/// A file name with a placeholder for one number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FramePattern {
    before: String,
    /// The minimum number of digits.
    width: usize,
    after: String,
}

/// The error for a name that has a `%` or a `#` but no valid placeholder.
pub(crate) const NOT_ONE_FIELD: &str = "it needs one field such as %d, %04d, #### or $F4";

impl FramePattern {
    /// The pattern that a file name contains; `None` if it has no placeholder.
    ///
    /// # Errors
    /// When a `%` is not a valid placeholder, or there is more than one.
    pub fn parse(name: &str) -> Option<Result<Self, &'static str>> {
        let found = if name.contains('%') {
            printf(name)
        } else if let Some(at) = name.find("$F") {
            let rest = &name[at + 2..];
            let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
            let width = if digits == 0 { Some(1) } else { width(&rest[..digits]) };
            width.map(|width| (at, width, at + 2 + digits)).filter(|_| !rest.contains("$F"))
        } else if name.contains('#') {
            padded(name, '#')
        } else if name.contains("@@") {
            padded(name, '@')
        } else {
            return None;
        };
        let pattern = found.map(|(start, width, end)| {
            let (before, after) = (name[..start].to_owned(), name[end..].to_owned());
            Self { before, width, after }
        });
        Some(pattern.ok_or(NOT_ONE_FIELD))
    }

    /// The number in a file name that matches the pattern; `None` if it does not match.
    pub fn number(&self, name: &str) -> Option<i64> {
        self.open(name).map(|(number, _)| number)
    }

    /// The number in a matching name, and whether its minus sign directly follows a letter or
    /// digit, where it may be a separator.
    fn open(&self, name: &str) -> Option<(i64, bool)> {
        let bytes = name.as_bytes();
        let mut found: Option<(i64, bool)> = None;
        let mut at = 0;
        while at < bytes.len() {
            let length = bytes[at..].iter().take_while(|b| b.is_ascii_digit()).count();
            let (start, end) = (at, at + length);
            at += length.max(1);
            if length == 0 || !fits(&self.after, &name[end..]) {
                continue;
            }
            let digits = &name[start..end];
            let plain = || {
                let fits = fits(&self.before, &name[..start]) && self.is_wide(digits, false);
                fits.then(|| digits.parse().ok()).flatten().map(|number| (number, false))
            };
            let number = match name[..start].strip_suffix('-') {
                // If the pattern itself ends with the minus sign, it is a separator.
                Some(before) if !self.before.ends_with('-') || plain().is_none() => {
                    let glued = before.ends_with(|c: char| c.is_alphanumeric() || c == '-');
                    let open = self.before.ends_with(['*', '?']);
                    let negative = fits(&self.before, before) && self.is_wide(digits, true);
                    if negative && !(open && glued) {
                        let value = name[start - 1..end].parse().ok();
                        value.filter(|number| *number < 0).map(|number| (number, glued))
                    } else {
                        plain()
                    }
                }
                _ => plain(),
            };
            match (number, found) {
                // Two numbers in the name match, so it is not clear which one is meant.
                (Some(_), Some(_)) => return None,
                (Some(number), None) => found = Some(number),
                (None, _) => {}
            }
        }
        found
    }

    /// Whether the number of digits is possible for the placeholder: at least its width, and more
    /// only without leading zeros. The minus sign may count as a digit or not: `%04d` writes -002,
    /// Blender writes -0002.
    fn is_wide(&self, digits: &str, negative: bool) -> bool {
        let plain = |width: usize| {
            digits.len() == width || (digits.len() > width && !digits.starts_with('0'))
        };
        plain(self.width) || (negative && self.width > 1 && digits.len() == self.width - 1)
    }

    /// The names that match, by their index, with their numbers.
    pub(crate) fn select(&self, names: &[&str]) -> (Vec<(usize, i64)>, Numbering) {
        let open = names.iter().enumerate().filter_map(|(i, name)| Some((i, self.open(name)?)));
        let open: Vec<(usize, (i64, bool))> = open.collect();
        // As for names without a pattern, a minus sign after a letter is a sign only if there are
        // names without it.
        let unsigned = open.iter().any(|(_, (number, _))| *number >= 0);
        let sure = open.into_iter().filter(|(_, (_, glued))| unsigned || !glued);
        let sure: Vec<(usize, i64)> = sure.map(|(index, (number, _))| (index, number)).collect();
        let mut seen = BTreeMap::new();
        let twice = sure.iter().find_map(|(index, number)| {
            let other = seen.insert(*number, *index)?;
            let [a, b] = [other, *index].map(|index| names[index].to_owned());
            Some(Numbering::Doubtful(Doubt::Twice(*number, a, b)))
        });
        (sure, twice.unwrap_or(Numbering::ByName))
    }
}

/// Start, width and end of the only printf placeholder.
fn printf(name: &str) -> Option<(usize, usize, usize)> {
    let start = name.find('%')?;
    let rest = &name[start + 1..];
    let end = rest.find('d')?;
    let wide = match &rest[..end] {
        "" => 1,
        digits => width(digits.strip_prefix('0')?)?,
    };
    (!rest[end..].contains('%')).then_some((start, wide, start + 1 + end + 1))
}

/// Start, width and end of the only run of a character.
fn padded(name: &str, sign: char) -> Option<(usize, usize, usize)> {
    let start = name.find(sign)?;
    let width = name[start..].chars().take_while(|c| *c == sign).count();
    let end = start + width;
    (width < MOST_DIGITS && !name[end..].contains(sign)).then_some((start, width, end))
}

/// No number has more digits.
const MOST_DIGITS: usize = 20;

fn width(digits: &str) -> Option<usize> {
    digits.parse().ok().filter(|width| *width < MOST_DIGITS).map(|width: usize| width.max(1))
}

/// Whether a text matches a part of a pattern, in which `*` stands for any characters and `?` for
/// one.
fn fits(pattern: &str, text: &str) -> bool {
    if !pattern.contains(['*', '?']) {
        return pattern == text;
    }
    let (pattern, text): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), text.chars().collect());
    // The position of the last star, and the end of the text that it matches. If the rest does not
    // match, the star matches one character more.
    let (mut p, mut t, mut star) = (0, 0, None);
    while t < text.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, t));
                p += 1;
            }
            Some(c) if *c == '?' || *c == text[t] => (p, t) = (p + 1, t + 1),
            _ => match star {
                Some((at, reached)) => {
                    star = Some((at, reached + 1));
                    (p, t) = (at + 1, reached + 1);
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(pattern: &str, name: &str) -> Option<i64> {
        FramePattern::parse(pattern).unwrap().unwrap().number(name)
    }

    #[test]
    fn all_notations_are_alike() {
        for pattern in ["f.%04d.exr", "f.####.exr", "f.@@@@.exr", "f.$F4.exr"] {
            assert_eq!(number(pattern, "f.0017.exr"), Some(17), "{pattern}");
            assert_eq!(number(pattern, "f.12345.exr"), Some(12345), "{pattern}");
            for other in ["f.017.exr", "f.00017.exr", "g.0017.exr", "f.0017.png", "f.001x.exr"] {
                assert_eq!(number(pattern, other), None, "{pattern} {other}");
            }
        }
        for pattern in ["f%d.png", "f#.png", "f$F.png"] {
            assert_eq!(number(pattern, "f9.png"), Some(9), "{pattern}");
            assert_eq!(number(pattern, "f10.png"), Some(10), "{pattern}");
            assert_eq!(number(pattern, "f010.png"), None, "{pattern}");
        }
        // A single @ is an ordinary character of a name, and so is a # beside a printf placeholder.
        assert_eq!(FramePattern::parse("a@b.png"), None);
        assert_eq!(number("#1_%03d.png", "#1_007.png"), Some(7));
    }

    #[test]
    fn negative_numbers_fit() {
        for name in ["f.-0002.exr", "f.-002.exr"] {
            assert_eq!(number("f.%04d.exr", name), Some(-2), "{name}");
        }
        assert_eq!(number("f.%d.exr", "f.-2.exr"), Some(-2));
        assert_eq!(number("f.%04d.exr", "f.-0000.exr"), None, "no program writes it");
        assert_eq!(number("f-%04d.exr", "f-0002.exr"), Some(2), "the pattern has the minus sign");
        assert_eq!(number("f-%04d.exr", "f--0002.exr"), Some(-2));
        let pattern = FramePattern::parse("f%04d").unwrap().unwrap();
        assert_eq!(pattern.select(&["f-0001", "f-0002"]).0, []);
        assert_eq!(pattern.select(&["f-0001", "f0002", "g1"]).0, [(0, -1), (1, 2)]);
    }

    #[test]
    fn wildcards_stand_for_what_changes_besides() {
        assert_eq!(number("f%04d_t*.png", "f0002_t0033.png"), Some(2));
        assert_eq!(number("f*_t%04d.png", "f0002_t0033.png"), Some(33));
        assert_eq!(number("*%04d.png", "f0002_t0033.png"), Some(33));
        assert_eq!(number("*%04d*", "f0002_t0033.png"), None, "either could be meant");
        assert_eq!(number("f%d_?.png", "f2_b.png"), Some(2));
        assert_eq!(number("*%04d.png", "f.-0002.png"), Some(-2));
        assert_eq!(number("*%04d.png", "f-0002.png"), Some(2));
        let pattern = FramePattern::parse("f%d_*").unwrap().unwrap();
        let twice = Doubt::Twice(1, "f1_a".into(), "f1_b".into());
        assert_eq!(pattern.select(&["f1_a", "f1_b"]).1, Numbering::Doubtful(twice));
        assert!(fits("a*b*c", "axbxbxc") && !fits("a*b*c", "axbxbx") && fits("*", ""));
    }

    #[test]
    fn one_field_it_must_be() {
        for bad in ["x%s", "x%d%d", "100%", "%4d", "##_##", "$Fx$F", "%099d", "x%"] {
            assert!(matches!(FramePattern::parse(bad), Some(Err(_))), "{bad}");
        }
        assert_eq!(FramePattern::parse("f0001.png"), None);
    }
}
