//! What a finished picture is kept as: the signal itself, or 8-bit codes of it. Rows are computed as the
//! signal in either case; those that become codes never leave the cache as anything else.

use multiversion::multiversion;

use rayon::prelude::*;

/// A value of a finished picture.
pub(crate) trait Value: Copy + Default + Send + Sync {
    /// Keeps the row that `fill` computes. `room` is for rows that are kept as something else; what
    /// `fill` finds in it does not matter.
    fn keep_row<const C: usize>(
        out: &mut [[Self; C]],
        room: &mut Vec<[f32; C]>,
        fill: impl FnOnce(&mut [[f32; C]]),
    );

    /// Keeps all pixels of a picture.
    fn keep<const C: usize>(pixels: Vec<[f32; C]>) -> Vec<[Self; C]>;
}

impl Value for f32 {
    fn keep_row<const C: usize>(
        out: &mut [[Self; C]],
        _room: &mut Vec<[f32; C]>,
        fill: impl FnOnce(&mut [[f32; C]]),
    ) {
        fill(out);
    }

    fn keep<const C: usize>(pixels: Vec<[f32; C]>) -> Vec<[Self; C]> {
        pixels
    }
}

impl Value for u8 {
    fn keep_row<const C: usize>(
        out: &mut [[Self; C]],
        room: &mut Vec<[f32; C]>,
        fill: impl FnOnce(&mut [[f32; C]]),
    ) {
        room.resize(out.len(), [0.0; C]);
        fill(room);
        codes8(room.as_flattened(), out.as_flattened_mut());
    }

    fn keep<const C: usize>(pixels: Vec<[f32; C]>) -> Vec<[Self; C]> {
        /// Pixels that one task converts.
        const TASK: usize = 1 << 16;
        let mut kept = vec![[0; C]; pixels.len()];
        kept.par_chunks_mut(TASK).zip(pixels.par_chunks(TASK)).for_each(|(codes, signal)| {
            codes8(signal.as_flattened(), codes.as_flattened_mut());
        });
        kept
    }
}

/// Codes of 8 bits: `[255 clamp(V, 0, 1) + 0.5]`, and 0 for NaN.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn codes8(signal: &[f32], codes: &mut [u8]) {
    for (code, value) in codes.iter_mut().zip(signal) {
        // A cast saturates, and makes 0 of NaN.
        *code = (value * 255.0 + 0.5) as u8;
    }
}
