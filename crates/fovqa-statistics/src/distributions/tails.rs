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
    Some(beyond(t, df))
}

/// P(T > t) with `df` degrees of freedom, which must be above 0; 0 or 1 for an infinite t.
pub fn t_upper(t: f64, df: f64) -> f64 {
    let tail = 0.5 * beyond(t, df);
    if t >= 0.0 { tail } else { 1.0 - tail }
}

/// P(|T| ≥ |t|) = I_x(ν/2, 1/2) with x = ν/(ν + t²) (Abramowitz and Stegun 1964, equations 26.5.27 and
/// 26.7.1).
fn beyond(t: f64, df: f64) -> f64 {
    // With r = t/√df, no square of a large number overflows.
    let r = t / libm::sqrt(df);
    let x = 1.0 / (1.0 + r * r);
    let y = if r.abs() > 1e8 { 1.0 } else { r * r / (1.0 + r * r) };
    incomplete_beta(0.5 * df, 0.5, x, y)
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
    Some(t_upper_quantile(0.5 * tail, df)).filter(|t| t.is_finite())
}

/// The t with P(T > t) = `share`, which must be above 0 and at most ½, as `df` must be above 0. Infinite
/// if it is too large for a number.
pub fn t_upper_quantile(share: f64, df: f64) -> f64 {
    let mut low = 0.0;
    let mut high = (-normal_quantile(share)).max(1e-3);
    // The normal quantile is below that of t.
    while t_upper(high, df) > share {
        low = high;
        high *= 2.0;
        if !high.is_finite() {
            return f64::INFINITY;
        }
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if t_upper(middle, df) > share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
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
    fn upper_quantiles_are_those_of_tables() {
        for (share, df, known) in [
            (0.01, 1.0, 31.820_515_953_773_96),
            (0.001, 2.0, 22.327_124_770_119_875),
            (0.025, 10.0, 2.228_138_851_964_938_5),
        ] {
            close(Some(t_upper_quantile(share, df)), known);
        }
    }

    #[test]
    fn one_and_two_degrees_of_freedom_have_closed_forms() {
        for share in [0.5f64, 0.3, 0.01, 1e-4, 1e-8] {
            let cauchy = 1.0 / (std::f64::consts::PI * share).tan();
            let two = (1.0 - 2.0 * share) / (2.0 * share * (1.0 - share)).sqrt();
            for (df, known) in [(1.0, cauchy), (2.0, two)] {
                let found = t_upper_quantile(share, df);
                let near = (found - known).abs() <= 1e-11 * known.max(1e-4);
                assert!(near, "{share}: {found} {known}");
            }
        }
    }

    /// The expansion from the quantile of the normal distribution (Abramowitz and Stegun 1964, equation
    /// 26.7.5). Its next term is below 1e-8 of the value here.
    #[test]
    fn many_degrees_of_freedom_come_near_the_normal_distribution() {
        for share in [0.4, 0.05, 1e-3, 1e-6, 1e-9] {
            let z = -normal_quantile(share);
            let cubed = z * z * z;
            let first = (cubed + z) / 4.0;
            let second = (5.0 * cubed * z * z + 16.0 * cubed + 3.0 * z) / 96.0;
            for df in [5000.0, 5000.5, 123_456.7, 1e6] {
                let known = z + first / df + second / (df * df);
                let found = t_upper_quantile(share, df);
                assert!((found / known - 1.0).abs() < 1e-8, "{share} {df}: {found} {known}");
            }
        }
    }

    #[test]
    fn the_tail_of_a_quantile_is_its_share() {
        for share in [0.49, 0.05, 1e-3, 1e-7] {
            for df in [1.0, 1.5, 3.0, 8.0, 40.0, 999.0, 12_345.6] {
                let tail = t_upper(t_upper_quantile(share, df), df);
                assert!((tail / share - 1.0).abs() < 1e-11, "{share} {df}: {tail}");
            }
        }
        let (above, below) = (t_upper(1.3, 4.5), t_upper(-1.3, 4.5));
        assert!((above + below - 1.0).abs() < 1e-12);
        assert!(t_upper(f64::INFINITY, 3.0).abs() < 1e-300);
        assert!(t_upper(f64::NEG_INFINITY, 3.0) >= 1.0);
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
