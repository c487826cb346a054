//! Tails of χ², t and F, and quantiles of t.

use statrs::function::gamma::checked_gamma_ur;

use super::incomplete_beta::incomplete_beta;
use super::normal::normal_quantile;

/// P(χ² ≥ x) with `df` degrees of freedom, which need not be whole. `None` if `df` is not above 0, or
/// an argument is not finite.
pub fn chi_squared_upper(x: f64, df: f64) -> Option<f64> {
    if !(x.is_finite() && df.is_finite() && df > 0.0) {
        return None;
    }
    if x <= 0.0 {
        return Some(1.0);
    }
    let p = checked_gamma_ur(0.5 * df, 0.5 * x).ok()?;
    p.is_finite().then(|| p.clamp(0.0, 1.0))
}

/// P(|T| ≥ |t|) with `df` degrees of freedom. `None` if `df` is not above 0, or an argument is not
/// finite.
pub fn t_two_sided(t: f64, df: f64) -> Option<f64> {
    if !(t.is_finite() && df.is_finite() && df > 0.0) {
        return None;
    }
    // With r = t/√df, no square of a large number overflows.
    let r = t / libm::sqrt(df);
    let x = 1.0 / (1.0 + r * r);
    let y = if r.abs() > 1e8 { 1.0 } else { r * r / (1.0 + r * r) };
    Some(incomplete_beta(0.5 * df, 0.5, x, y))
}

/// P(F ≥ f) with `df` and `df_error` degrees of freedom, which need not be whole. `None` if one of
/// them is not above 0, or an argument is not finite.
pub fn f_upper(f: f64, df: f64, df_error: f64) -> Option<f64> {
    let usable = |n: f64| n.is_finite() && n > 0.0;
    if !(f.is_finite() && usable(df) && usable(df_error)) {
        return None;
    }
    if f <= 0.0 {
        return Some(1.0);
    }
    let ratio = df * f / df_error;
    let (x, y) = (1.0 / (1.0 + ratio), 1.0 / (1.0 + 1.0 / ratio));
    Some(incomplete_beta(0.5 * df_error, 0.5 * df, x, y))
}

/// The t with P(|T| ≤ t) = `confidence`, for intervals. `None` if `df` is not above 0 or `confidence`
/// is not between 0 and 1.
pub fn t_quantile(confidence: f64, df: f64) -> Option<f64> {
    let tail = 1.0 - confidence;
    if !(tail > 0.0 && tail < 1.0 && df.is_finite() && df > 0.0) {
        return None;
    }
    let mut low = 0.0;
    let mut high = normal_quantile(0.5 + 0.5 * confidence).max(1e-3);
    // The normal quantile is below that of t.
    while t_two_sided(high, df)? > tail {
        low = high;
        high *= 2.0;
        if !high.is_finite() {
            return None;
        }
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if t_two_sided(middle, df)? > tail { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Option<f64>, b: f64) {
        let a = a.unwrap();
        assert!((a - b).abs() <= 1e-11 * b.abs(), "{a:e} is not {b:e}");
    }

    #[test]
    fn tails_are_those_of_closed_forms() {
        close(chi_squared_upper(3.0, 2.0), (-1.5_f64).exp());
        close(chi_squared_upper(1.0, 1.0), 0.317_310_507_862_914_1);
        close(t_two_sided(1.0, 1.0), 0.5);
        close(t_two_sided(-2.0, 2.0), 1.0 - 2.0 / 6.0_f64.sqrt());
        close(f_upper(4.0, 1.0, 2.0), 1.0 - 2.0 / 6.0_f64.sqrt());
        close(f_upper(2.0, 2.0, 4.0), 0.25);
        assert_eq!(chi_squared_upper(-1.0, 2.0), Some(1.0));
        assert_eq!(t_two_sided(0.0, 5.0), Some(1.0));
    }

    #[test]
    fn quantiles_are_those_of_r() {
        // R: qt(.975, c(1, 3, 15))
        close(t_quantile(0.95, 1.0), 12.706_204_736_174_7);
        close(t_quantile(0.95, 3.0), 3.182_446_305_283_71);
        close(t_quantile(0.95, 15.0), 2.131_449_545_559_32);
        assert!((t_quantile(0.95, 1e9).unwrap() - 1.959_963_984_540_054).abs() < 1e-8);
    }

    #[test]
    fn undefined_tails_are_none() {
        assert_eq!(chi_squared_upper(1.0, 0.0), None);
        assert_eq!(t_two_sided(f64::INFINITY, 3.0), None);
        assert_eq!(f_upper(f64::NAN, 1.0, 1.0), None);
        assert_eq!((t_quantile(1.0, 3.0), t_quantile(0.95, 0.0)), (None, None));
        assert!(t_two_sided(1e300, 3.0).unwrap() < 1e-300);
    }
}
