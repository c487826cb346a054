//! Pixels of four values: a buffer that is read for every pixel of the screen is read four values at a
//! time, which is one instruction where three would be several.

/// A pixel of 1 or 3 channels in four values. Of gray all four are the same; the fourth value of a colour
/// has no meaning.
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

/// Writes pixels one after the other. Each is written whole, as four values in one instruction, and what
/// that is too much the next pixel overwrites.
#[inline(always)]
pub(crate) fn write_all<const C: usize>(
    out: &mut [[f32; C]],
    mut texel: impl FnMut(usize) -> Texel,
) {
    let pixels = out.len();
    let values = out.as_flattened_mut();
    for i in 0..pixels {
        let (at, texel) = (i * C, texel(i));
        match values.get_mut(at..at + 4) {
            Some(four) => four.copy_from_slice(&texel),
            None => values[at..].iter_mut().zip(texel).for_each(|(out, value)| *out = value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_keep_their_own_values() {
        let texel = |i: usize| [i as f32, 0.25, 0.5, f32::NAN];
        let mut colours = [[9.0; 3]; 5];
        write_all(&mut colours, texel);
        assert_eq!(colours, [0.0, 1.0, 2.0, 3.0, 4.0].map(|i| [i, 0.25, 0.5]));
        let mut grays = [[9.0; 1]; 6];
        write_all(&mut grays, |i| [i as f32; 4]);
        assert_eq!(grays, [[0.0], [1.0], [2.0], [3.0], [4.0], [5.0]]);
    }
}
