//! The priors of psignifit 4 (Schütt, Harmeling, Macke and Wichmann 2016), as logarithms without
//! constants.

use std::f64::consts::PI;

use super::super::levels::Span;

/// The exponent of Beta(1, 10), the prior of λ and η.
const BETA_EXPONENT: f64 = 9.0;

/// The prior of m: constant over the levels, and falling to 0 within half a range outside.
pub(super) fn position(span: &Span, m: f64) -> f64 {
    let outside = (span.first - m).max(m - span.last).max(0.0);
    if outside >= 0.5 * span.range {
        return f64::NEG_INFINITY;
    }
    log_half_cosine(2.0 * outside / span.range)
}

/// The prior of w: rising from the least gap to twice that gap, constant up to the range, and falling
/// to three ranges.
pub(super) fn width(span: &Span, w: f64) -> f64 {
    let Span { range, gap, .. } = *span;
    if w < gap || w > 3.0 * range {
        f64::NEG_INFINITY
    } else if w >= range {
        log_half_cosine((w - range) / (2.0 * range))
    } else if w < 2.0 * gap {
        log_half_cosine(1.0 - (w - gap) / gap)
    } else {
        0.0
    }
}

/// The prior Beta(1, 10) of λ and η.
pub(super) fn beta(value: f64) -> f64 {
    BETA_EXPONENT * libm::log1p(-value)
}

/// ln ½(1 + cos πt) = 2 ln cos(πt/2): 0 at t = 0, -∞ at t = 1.
fn log_half_cosine(t: f64) -> f64 {
    let cosine = libm::cos(0.5 * PI * t);
    if t < 1.0 && cosine > 0.0 { 2.0 * libm::log(cosine) } else { f64::NEG_INFINITY }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;

    const SPAN: Span = Span { first: 1.0, last: 5.0, range: 4.0, gap: 1.0 };

    #[test]
    fn the_prior_of_the_position_falls_outside_the_levels() {
        assert_eq!(position(&SPAN, 1.0), 0.0);
        assert!((position(&SPAN, 0.0) - 0.5_f64.ln()).abs() < 1e-14);
        assert_eq!(position(&SPAN, 7.0), f64::NEG_INFINITY);
    }

    #[test]
    fn the_prior_of_the_width_has_a_plateau() {
        assert!((width(&SPAN, 1.5) - 0.5_f64.ln()).abs() < 1e-14);
        assert_eq!((width(&SPAN, 2.0), width(&SPAN, 4.0)), (0.0, 0.0));
        assert!((width(&SPAN, 8.0) - 0.5_f64.ln()).abs() < 1e-14);
        assert_eq!(width(&SPAN, 0.99), f64::NEG_INFINITY);
        assert!((beta(0.5) - 9.0 * 0.5_f64.ln()).abs() < 1e-14);
    }
}
