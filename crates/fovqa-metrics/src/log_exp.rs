//! log2, exp2 and sine in `f32` that vectorise: polynomials without branches, without fused
//! multiply-adds, and without a rounding instruction that the oldest processors lack. Results are
//! bit-identical for every vector width.

/// 1.5 · 2^23. Adding it to a number of moderate size rounds the number to an integer, which is
/// then in the lowest bits.
const ROUND: f32 = 12_582_912.0;

/// The nearest integer to a value from 0 to 2^22, for use as an index.
#[inline(always)]
pub(crate) fn rounded_index(value: f32) -> u32 {
    (value + ROUND).to_bits() & 0x003f_ffff
}

/// log2 of a positive normal number, with an absolute error of at most 4e-7. For 0 and subnormal
/// numbers the result is -126 or less; for negative numbers it has no meaning.
#[inline(always)]
pub(crate) fn log2(value: f32) -> f32 {
    /// The bits of sqrt(1/2): the mantissa runs from there to sqrt(2), so that f is small.
    const SQRT_HALF: u32 = 0x3f35_04f3;
    // Minimax approximation of log2(1 + f) / f, relative.
    const P: [f32; 7] = [
        1.442_699_7,
        -0.721_375_8,
        0.480_466_25,
        -0.358_963_2,
        0.297_250_45,
        -0.272_686_6,
        0.170_658_5,
    ];
    let bits = value.to_bits();
    let exponent = (bits.wrapping_sub(SQRT_HALF) as i32) >> 23;
    let f = f32::from_bits(bits.wrapping_sub((exponent << 23) as u32)) - 1.0;
    let p = P[0] + f * (P[1] + f * (P[2] + f * (P[3] + f * (P[4] + f * (P[5] + f * P[6])))));
    exponent as f32 + f * p
}

/// 2 to a power up to 127, with a relative error of at most 2e-7; 0 for powers of -126 and below.
#[inline(always)]
pub(crate) fn exp2(power: f32) -> f32 {
    const LOWEST: f32 = -126.0;
    // Minimax approximation of 2^f on [-1/2, 1/2], relative.
    const P: [f32; 6] =
        [1.000_000_1, 0.693_146_94, 0.240_221_2, 0.055_507_13, 0.009_675_541, 0.001_327_647_2];
    let kept = if power > LOWEST { power } else { LOWEST };
    let shifted = kept + ROUND;
    let f = kept - (shifted - ROUND);
    let p = P[0] + f * (P[1] + f * (P[2] + f * (P[3] + f * (P[4] + f * P[5]))));
    let scaled = f32::from_bits(p.to_bits().wrapping_add(shifted.to_bits() << 23));
    if power > LOWEST { scaled } else { 0.0 }
}

/// The sine of an angle from 0 to π/2, with a relative error of at most 1.3e-6.
#[inline(always)]
pub(crate) fn sine(radians: f32) -> f32 {
    // Minimax approximation of sin(x) / x over x².
    const P: [f32; 4] = [0.999_999_2, -0.166_656_82, 0.008_313_259, -0.000_185_243_57];
    let u = radians * radians;
    radians * (P[0] + u * (P[1] + u * (P[2] + u * P[3])))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn logarithms_are_near_for_every_magnitude() {
        let mut worst = 0.0f64;
        for i in 0..1_000_000u32 {
            let value = f32::from_bits(0x0080_0000 + i * 2122);
            worst = worst.max((f64::from(log2(value)) - libm::log2(f64::from(value))).abs());
        }
        assert!(worst < 8e-6, "{worst:e}: the step of an f32 at 126");
        let near_one = (0..100_000)
            .map(|i| 0.5 + i as f32 * 1.5e-5)
            .map(|value| (f64::from(log2(value)) - libm::log2(f64::from(value))).abs());
        assert!(near_one.fold(0.0, f64::max) < 5e-7);
        assert_eq!(log2(1.0), 0.0);
        assert!(log2(0.0) < -125.9 && log2(f32::from_bits(1)) < -125.9);
    }

    #[test]
    fn powers_are_near_and_end_at_nothing() {
        let mut worst = 0.0f64;
        for i in 1..=1_000_000 {
            let power = -126.0 + i as f32 * 2.53e-4;
            let wanted = libm::exp2(f64::from(power));
            worst = worst.max((f64::from(exp2(power)) / wanted - 1.0).abs());
        }
        assert!(worst < 3e-7, "{worst:e}");
        assert_eq!(exp2(-126.0), 0.0);
        assert_eq!(exp2(-126.5), 0.0);
        assert_eq!(exp2(-1e30), 0.0);
        assert_eq!(exp2(f32::NEG_INFINITY), 0.0);
    }

    #[test]
    fn sines_are_near_in_relation() {
        let mut worst = 0.0f64;
        for i in 1..=100_000 {
            let angle = i as f32 * (std::f32::consts::FRAC_PI_2 / 100_000.0);
            let wanted = libm::sin(f64::from(angle));
            worst = worst.max((f64::from(sine(angle)) / wanted - 1.0).abs());
        }
        assert!(worst < 1.4e-6, "{worst:e}");
    }

    #[test]
    fn whole_numbers_are_the_nearest() {
        for (value, whole) in [(0.0, 0), (0.49, 0), (0.51, 1), (29.9, 30), (30.0, 30)] {
            assert_eq!(rounded_index(value), whole, "{value}");
        }
    }
}
