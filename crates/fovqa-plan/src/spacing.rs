//! Values that are spread over a range.

/// The `step`-th of so many values from one end of a range to the other, both included: with equal
/// differences or, if `log` is set and both ends are above 0, with equal ratios.
pub fn spaced([from, to]: [f64; 2], step: usize, steps: usize, log: bool) -> f64 {
    let last = steps.saturating_sub(1);
    if step == 0 {
        return from;
    }
    if step >= last {
        return to;
    }
    let share = step as f64 / last as f64;
    if log {
        // libm has the same bits on every machine.
        libm::exp(libm::log(from) + share * (libm::log(to) - libm::log(from)))
    } else {
        from + share * (to - from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_belong_to_the_values() {
        let even: Vec<f64> = (0..3).map(|step| spaced([0.2, 0.8], step, 3, false)).collect();
        assert!(even[0].to_bits() == 0.2f64.to_bits() && even[2].to_bits() == 0.8f64.to_bits());
        assert!((even[1] - 0.5).abs() < 1e-12);
        let ratios = spaced([0.2, 0.8], 1, 3, true);
        assert!((ratios - 0.4).abs() < 1e-12);
    }
}
