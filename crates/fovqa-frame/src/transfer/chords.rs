//! A curve as line segments (chords) between exact points, selected by the bits of a value.
//! Computing a power for each of 50 million samples would cost more than all metrics.

/// A curve over positive values from `2^FROM` on, with `2^SEGMENT_BITS` chords per octave.
#[derive(Debug)]
pub(super) struct Chords<const SEGMENT_BITS: u32, const FROM: i32>(Vec<f32>);

impl<const SEGMENT_BITS: u32, const FROM: i32> Chords<SEGMENT_BITS, FROM> {
    /// The number of bits of a value below those that select its chord.
    const FRACTION_BITS: u32 = 23 - SEGMENT_BITS;
    /// Bits of `2^FROM`.
    const FROM_BITS: u32 = ((127 + FROM) as u32) << 23;

    /// The chords of a curve over this number of octaves.
    pub(super) fn new(octaves: u32, curve: impl Fn(f64) -> f64) -> Self {
        let first = Self::FROM_BITS >> Self::FRACTION_BITS;
        let point = |i: u32| f64::from(f32::from_bits((first + i) << Self::FRACTION_BITS));
        Self((0..=octaves << SEGMENT_BITS).map(|i| curve(point(i)) as f32).collect())
    }

    /// The curve at a value within its octaves.
    #[inline]
    pub(super) fn at(&self, value: f32) -> f32 {
        let offset = value.to_bits() - Self::FROM_BITS;
        let index = (offset >> Self::FRACTION_BITS) as usize;
        let fraction = offset & ((1 << Self::FRACTION_BITS) - 1);
        let t = fraction as f32 * (1.0 / (1u32 << Self::FRACTION_BITS) as f32);
        let (from, to) = (self.0[index], self.0[index + 1]);
        from + (to - from) * t
    }
}
