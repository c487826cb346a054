//! "Did you mean": the name nearest to one that is not there.

/// What to say of a name that is not there: the nearest there is, and all of them.
pub(crate) fn no_such(kind: &str, name: &str, known: &[String]) -> String {
    /// Jaro-Winkler similarity above which a slip is likelier than another intent.
    const LIKELY: f64 = 0.75;
    let name = name.to_lowercase().replace('_', "-");
    let similarity = |other: &String| strsim::jaro_winkler(&name, other);
    let nearest = known
        .iter()
        .max_by(|a, b| similarity(a).total_cmp(&similarity(b)))
        .filter(|nearest| similarity(nearest) > LIKELY);
    let guess = nearest.map(|n| format!(" (did you mean {n}?)")).unwrap_or_default();
    format!("there is no such {kind}{guess}; there are {}", known.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_understood_and_other_words_are_not() {
        let known = ["mse", "psnr", "ms-ssim"].map(str::to_owned);
        assert!(no_such("metric", "pnsr", &known).contains("did you mean psnr?"));
        assert!(no_such("metric", "MS_SIM", &known).contains("did you mean ms-ssim?"));
        assert!(!no_such("metric", "flip", &known).contains("did you mean"));
    }
}
