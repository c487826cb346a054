//! Tables over all codes of 8 or 16 bits, and the range of encoded floats.

/// The number of 8-bit codes. A table of this length needs no check of an 8-bit index.
pub(crate) const CODES_8: usize = 1 << 8;
/// The number of 16-bit codes.
pub(crate) const CODES_16: usize = 1 << 16;

/// A table of `value` for all codes from 0 on.
#[allow(clippy::unnecessary_box_returns, reason = "a quarter of a megabyte is no stack frame")]
pub(crate) fn table<const N: usize>(value: impl Fn(usize) -> f32) -> Box<[f32; N]> {
    let values: Box<[f32]> = (0..N).map(value).collect();
    values.try_into().unwrap_or_else(|_| unreachable!("N values make a table of N"))
}

/// An encoded float, clamped to `[0, 1]`.
#[inline]
#[allow(clippy::manual_clamp, reason = "clamp would let NaN through; here it becomes 0")]
pub(crate) fn within_unit(value: f32) -> f32 {
    value.max(0.0).min(1.0)
}
