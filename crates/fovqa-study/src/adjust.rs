//! Adjustment of p-values for several tests, and stars.

use fovqa_params::words;

words! {
    /// How p-values of one table are adjusted for the number of tests.
    #[derive(Default)]
    pub enum Adjustment {
        /// Holm's step-down procedure (Holm 1979).
        #[default]
        Holm "holm" "Holm's step-down procedure";
        /// Bonferroni: p-values are multiplied by the number of tests.
        Bonferroni "bonferroni" "p-values times the number of tests";
        /// No adjustment.
        None "none" "no adjustment";
    }
}

/// The adjusted p-values of a table, in the order given. Only the m defined p-values count as tests;
/// an undefined one remains undefined.
///
/// Holm: `max_{j≤i} min(1, (m-j+1) p_(j))`; Bonferroni: `min(1, m p)`.
pub fn adjusted(p: &[Option<f64>], adjustment: Adjustment) -> Vec<Option<f64>> {
    let mut order: Vec<(usize, f64)> =
        p.iter().enumerate().filter_map(|(i, p)| p.map(|p| (i, p))).collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    let tests = order.len();
    let mut out = vec![None; p.len()];
    let mut highest = 0.0_f64;
    for (rank, &(index, p)) in order.iter().enumerate() {
        let value = match adjustment {
            Adjustment::Holm => {
                highest = highest.max(((tests - rank) as f64 * p).min(1.0));
                highest
            }
            Adjustment::Bonferroni => (tests as f64 * p).min(1.0),
            Adjustment::None => p,
        };
        out[index] = Some(value);
    }
    out
}

/// The stars of an adjusted p-value: `*` below .05, `**` below .01, `***` below .001.
pub fn stars(p_adjusted: Option<f64>) -> &'static str {
    match p_adjusted {
        Some(p) if p < 0.001 => "***",
        Some(p) if p < 0.01 => "**",
        Some(p) if p < 0.05 => "*",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holm_is_a_running_maximum_over_the_defined_values() {
        // R: p.adjust(c(.01, .04, .03), "holm") = .03 .06 .06
        let p = [Some(0.01), None, Some(0.04), Some(0.03)];
        let expected = [Some(0.03), None, Some(0.06), Some(0.06)];
        assert_eq!(adjusted(&p, Adjustment::Holm), expected);
        let expected = [Some(0.03), None, Some(0.12), Some(0.09)];
        assert_eq!(adjusted(&p, Adjustment::Bonferroni), expected);
        assert_eq!(adjusted(&p, Adjustment::None), p);
        assert_eq!(adjusted(&[Some(0.9), Some(0.8)], Adjustment::Holm), [Some(1.0), Some(1.0)]);
    }

    #[test]
    fn stars_are_strictly_below() {
        assert_eq!([0.05, 0.01, 0.001, 1e-9].map(|p| stars(Some(p))), ["", "*", "**", "***"]);
        assert_eq!(stars(None), "");
    }
}
