//! "Did you mean": the name nearest to one that is not there.

/// The name of `known` that a slip is likely to have meant; `-` and `_`, upper and lower case are
/// alike.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Jaro-Winkler similarity above which a slip is likelier than another intent.
    const LIKELY: f64 = 0.75;
    let plain = |name: &str| name.to_lowercase().replace('_', "-");
    let name = plain(name);
    known
        .into_iter()
        .map(|known| (strsim::jaro_winkler(&name, &plain(known)), known))
        .filter(|(similarity, _)| *similarity > LIKELY)
        // The first of the most similar ones, so that the answer does not depend on ties.
        .reduce(|best, other| if other.0 > best.0 { other } else { best })
        .map(|(_, known)| known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_understood_and_other_words_are_not() {
        let known = ["mse", "psnr", "ms-ssim"];
        assert_eq!(nearest("pnsr", known), Some("psnr"));
        assert_eq!(nearest("MS_SIM", known), Some("ms-ssim"));
        assert_eq!(nearest("flip", known), None);
    }
}
