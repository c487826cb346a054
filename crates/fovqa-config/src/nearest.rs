//! Finds the known name that is most similar to an unknown one, for "did you mean".

/// The name in `known` that a misspelled name most likely stands for. `-` and `_` count as the
/// same, and so do upper and lower case.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// The Jaro-Winkler similarity above which a misspelling is likely.
    const LIKELY: f64 = 0.75;
    let plain = |name: &str| name.to_lowercase().replace('_', "-");
    let name = plain(name);
    known
        .into_iter()
        .map(|known| (strsim::jaro_winkler(&name, &plain(known)), known))
        .filter(|(similarity, _)| *similarity > LIKELY)
        // If several names are equally similar, the first one is taken.
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
