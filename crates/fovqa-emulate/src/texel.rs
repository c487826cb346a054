//! Pixels of four values: a buffer that is read for every pixel of the screen is read four values at a
//! time, which is one instruction where three would be several.

/// A pixel of 1 or 3 channels in four values; the values that are left over repeat the last channel.
pub(crate) type Texel = [f32; 4];

/// Puts a pixel into as many values or more.
#[inline(always)]
pub(crate) fn widened<const C: usize, const L: usize>(pixel: [f32; C]) -> [f32; L] {
    std::array::from_fn(|i| pixel[i.min(C - 1)])
}

/// Takes a pixel out of as many values or more.
#[inline(always)]
pub(crate) fn narrowed<const L: usize, const C: usize>(texel: [f32; L]) -> [f32; C] {
    std::array::from_fn(|c| texel[c])
}
