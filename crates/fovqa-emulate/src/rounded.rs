//! Ideal sizes of buffers and whole ones.

/// Number of samples along an axis: the ideal size, rounded (`[ideal + 0.5]`), and at least 1.
pub(crate) fn rounded(ideal: f64) -> usize {
    ((ideal + 0.5).floor() as usize).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_sample_is_one() {
        assert_eq!([0.2, 0.5, 1.49, 1.5, 61.54].map(rounded), [1, 1, 1, 2, 62]);
    }
}
