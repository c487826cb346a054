//! The direction of a pixel from the gaze, as a share of a whole turn, fast and the same everywhere.

/// atan(z) / 2π = z P(z²) for z in [0, 1], within 1.6e-9: interpolated at Chebyshev nodes.
const P: [f32; 9] = [
    0.159_154_94,
    -0.053_051_176,
    0.031_818_053,
    -0.022_596_497,
    0.016_899_662,
    -0.011_867_953,
    0.006_706_411,
    -0.002_503_706,
    0.000_440_267_7,
];

/// atan2(dy, dx) / 2π in [0, 1], within 1e-7; 0 at the gaze itself. 1 is reached by rounding alone, and
/// is the same direction as 0.
#[inline(always)]
pub(crate) fn turn(dx: f32, dy: f32) -> f32 {
    let (ax, ay) = (dx.abs(), dy.abs());
    let (less, more) = if ax < ay { (ax, ay) } else { (ay, ax) };
    let z = less / more.max(f32::MIN_POSITIVE);
    let x = z * z;
    let mut p = P[8];
    for c in P[..8].iter().rev() {
        p = p * x + c;
    }
    let eighth = z * p;
    let quarter = if ax < ay { 0.25 - eighth } else { eighth };
    let half = if dx < 0.0 { 0.5 - quarter } else { quarter };
    if dy < 0.0 { 1.0 - half } else { half }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_atan2_all_around() {
        for i in 0..100_000 {
            let angle = f64::from(i) / 100_000.0 * std::f64::consts::TAU;
            let (dx, dy) = ((angle.cos() * 700.0) as f32, (angle.sin() * 700.0) as f32);
            let exact = libm::atan2(f64::from(dy), f64::from(dx)) / std::f64::consts::TAU;
            let exact = if exact < 0.0 { exact + 1.0 } else { exact };
            let found = f64::from(turn(dx, dy));
            assert!((found - exact).abs() < 1.2e-7, "{dx}, {dy}: {found} for {exact}");
        }
        for (dx, dy, found) in [
            (0.0, 0.0, 0.0),
            (1.0, 0.0, 0.0),
            (0.0, 1.0, 0.25),
            (-1.0, 0.0, 0.5),
            (0.0, -1.0, 0.75),
        ] {
            assert!((turn(dx, dy) - found).abs() < 1e-7, "{dx}, {dy}");
        }
    }
}
