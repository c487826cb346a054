//! Natural order, in which `frame9` comes before `frame10`.

use std::cmp::Ordering;

/// Compares two names; runs of digits are compared by their value.
pub(crate) fn natural_cmp(a: &str, b: &str) -> Ordering {
    let (mut left, mut right) = (a, b);
    loop {
        let (digits_l, digits_r) = (leading_digits(left), leading_digits(right));
        let order = if digits_l > 0 && digits_r > 0 {
            let number = |s: &str, n: usize| s[..n].trim_start_matches('0').to_owned();
            let (l, r) = (number(left, digits_l), number(right, digits_r));
            (left, right) = (&left[digits_l..], &right[digits_r..]);
            l.len().cmp(&r.len()).then(l.cmp(&r))
        } else {
            let (mut l, mut r) = (left.chars(), right.chars());
            let order = match (l.next(), r.next()) {
                // Names that differ only in leading zeros still need a defined order.
                (None, None) => return a.cmp(b),
                (l, r) => l.cmp(&r),
            };
            (left, right) = (l.as_str(), r.as_str());
            order
        };
        if order != Ordering::Equal {
            return order;
        }
    }
}

fn leading_digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_as_numbers() {
        let mut names = vec!["f10", "f9", "f009", "g1", "f10b2", "f10b10", "f"];
        names.sort_by(|a, b| natural_cmp(a, b));
        assert_eq!(names, ["f", "f009", "f9", "f10", "f10b2", "f10b10", "g1"]);
        assert_eq!(
            natural_cmp("99999999999999999999998", "99999999999999999999999"),
            Ordering::Less
        );
    }
}
