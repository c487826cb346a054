//! Notes as sentences.

/// A note as a sentence: it begins with a capital letter and ends with one full stop.
pub(crate) fn sentence(note: &str) -> String {
    let mut chars = note.chars();
    let first: String = chars.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    format!("{first}{}.", chars.as_str().trim_end_matches('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_have_one_full_stop() {
        assert_eq!(sentence("the curve is cut"), "The curve is cut.");
        assert_eq!(sentence("Done."), "Done.");
        assert_eq!(sentence(""), ".");
    }
}
