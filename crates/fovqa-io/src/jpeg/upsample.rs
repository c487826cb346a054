//! Upsamples components to the resolution of the image.
//!
//! Where a component has half the resolution, its samples lie between those of the image, and the
//! nearer sample has three times the weight of the farther one. Other ratios repeat samples. This
//! is libjpeg's default ("fancy upsampling"), with its rounding.

use multiversion::multiversion;

/// The samples of a component.
#[derive(Debug)]
pub(super) struct Plane {
    pub(super) samples: Vec<u8>,
    /// Samples from one row to the next.
    pub(super) stride: usize,
    /// The number of valid samples across and down; the others pad the blocks.
    pub(super) size: (usize, usize),
}

impl Plane {
    fn row(&self, y: usize) -> &[u8] {
        &self.samples[y * self.stride..][..self.size.0]
    }
}

/// The upsampling of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Interpolation {
    /// Interpolation across.
    Half,
    /// Interpolation down.
    HalfDown,
    /// Interpolation in both directions.
    HalfBoth,
    /// Repetition of samples, by these factors across and down.
    Repeat(usize, usize),
}

/// Reads rows of one component at the image's resolution.
#[derive(Debug)]
pub(super) struct Upsampled<'a> {
    plane: &'a Plane,
    interpolation: Interpolation,
}

impl<'a> Upsampled<'a> {
    /// Upsamples a component whose resolution is the image's divided by whole `factors`, across and
    /// down.
    pub(super) fn new(plane: &'a Plane, factors: (usize, usize)) -> Self {
        /// Interpolation across needs more samples than this.
        const NARROW: usize = 2;
        let interpolation = match factors {
            (2, 1) if plane.size.0 > NARROW => Interpolation::Half,
            (2, 2) if plane.size.0 > NARROW => Interpolation::HalfBoth,
            (1, 2) => Interpolation::HalfDown,
            (across, down) => Interpolation::Repeat(across, down),
        };
        Self { plane, interpolation }
    }

    /// Writes row `y` of the image to `out`, which is as wide as the image.
    pub(super) fn row(&self, y: usize, sums: &mut Vec<u16>, out: &mut [u8]) {
        match self.interpolation {
            Interpolation::Repeat(1, down) => {
                out.copy_from_slice(&self.plane.row(y / down)[..out.len()]);
            }
            Interpolation::Repeat(across, down) => repeat(self.plane.row(y / down), across, out),
            Interpolation::Half => half(self.plane.row(y), out),
            Interpolation::HalfDown => {
                let (near, far) = self.rows(y);
                // Rows are rounded up and down in turn, so that the mean does not change.
                half_down(near, far, if y.is_multiple_of(2) { 1 } else { 2 }, out);
            }
            Interpolation::HalfBoth => {
                let (near, far) = self.rows(y);
                sums.clear();
                sums.extend(near.iter().zip(far).map(|(n, f)| 3 * u16::from(*n) + u16::from(*f)));
                half_both(sums, out);
            }
        }
    }

    /// The nearer and the farther row of a component with half the number of rows.
    fn rows(&self, y: usize) -> (&[u8], &[u8]) {
        let near = y / 2;
        let far = if y.is_multiple_of(2) { near.saturating_sub(1) } else { near + 1 };
        (self.plane.row(near), self.plane.row(far.min(self.plane.size.1 - 1)))
    }
}

fn repeat(samples: &[u8], times: usize, out: &mut [u8]) {
    for (out, sample) in out.chunks_mut(times).zip(samples) {
        out.fill(*sample);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn half_down(near: &[u8], far: &[u8], rounding: u16, out: &mut [u8]) {
    for ((out, near), far) in out.iter_mut().zip(near).zip(far) {
        *out = ((3 * u16::from(*near) + u16::from(*far) + rounding) >> 2) as u8;
    }
}

/// Interpolates across. `out` may be one sample shorter than twice the samples.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn half(samples: &[u8], out: &mut [u8]) {
    let last = samples.len() - 1;
    let value = |i: usize| u16::from(samples[i]);
    out[0] = samples[0];
    out[1] = ((3 * value(0) + value(1) + 2) >> 2) as u8;
    let (inner, end) = out[2..].split_at_mut(2 * (last - 1));
    for (pair, near) in inner.as_chunks_mut::<2>().0.iter_mut().zip(samples.windows(3)) {
        let [left, near, right] = [near[0], near[1], near[2]].map(u16::from);
        *pair = [((3 * near + left + 1) >> 2) as u8, ((3 * near + right + 2) >> 2) as u8];
    }
    end[0] = ((3 * value(last) + value(last - 1) + 1) >> 2) as u8;
    if let Some(out) = end.get_mut(1) {
        *out = samples[last];
    }
}

/// Interpolates across over the sums of four, in sixteenths.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn half_both(sums: &[u16], out: &mut [u8]) {
    let last = sums.len() - 1;
    out[0] = ((4 * sums[0] + 8) >> 4) as u8;
    out[1] = ((3 * sums[0] + sums[1] + 7) >> 4) as u8;
    let (inner, end) = out[2..].split_at_mut(2 * (last - 1));
    for (pair, near) in inner.as_chunks_mut::<2>().0.iter_mut().zip(sums.windows(3)) {
        let [left, near, right] = [near[0], near[1], near[2]];
        *pair = [((3 * near + left + 8) >> 4) as u8, ((3 * near + right + 7) >> 4) as u8];
    }
    end[0] = ((3 * sums[last] + sums[last - 1] + 8) >> 4) as u8;
    if let Some(out) = end.get_mut(1) {
        *out = ((4 * sums[last] + 7) >> 4) as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(plane: &Plane, factors: (usize, usize), size: (usize, usize)) -> Vec<Vec<u8>> {
        let upsampled = Upsampled::new(plane, factors);
        let row = |y| {
            let mut out = vec![0; size.0];
            upsampled.row(y, &mut Vec::new(), &mut out);
            out
        };
        (0..size.1).map(row).collect()
    }

    /// The expected values are calculated by hand. The fourth column and the third row are padding
    /// of a block.
    fn plane() -> Plane {
        let samples = vec![0, 40, 80, 255, 100, 140, 180, 255, 255, 255, 255, 255];
        Plane { samples, stride: 4, size: (3, 2) }
    }

    #[test]
    fn half_the_resolution_is_interpolated() {
        let across = [[0, 10, 30, 50, 70, 80], [100, 110, 130, 150, 170, 180]];
        assert_eq!(rows(&plane(), (2, 1), (6, 2)), across);
        assert_eq!(rows(&plane(), (2, 1), (5, 2))[1], across[1][..5]);
        let down = rows(&plane(), (1, 2), (3, 4));
        assert_eq!(down, [[0, 40, 80], [25, 65, 105], [75, 115, 155], [100, 140, 180]]);
        let both = rows(&plane(), (2, 2), (6, 3));
        assert_eq!(both[0], across[0]);
        assert_eq!(both[1], [25, 35, 55, 75, 95, 105]);
        assert_eq!(both[2], [75, 85, 105, 125, 145, 155]);
    }

    #[test]
    fn other_ratios_repeat() {
        assert_eq!(rows(&plane(), (3, 1), (8, 1))[0], [0, 0, 0, 40, 40, 40, 80, 80]);
        assert_eq!(rows(&plane(), (1, 4), (3, 8))[5], [100, 140, 180]);
        let narrow = Plane { size: (2, 2), ..plane() };
        assert_eq!(rows(&narrow, (2, 2), (4, 4))[2], [100, 100, 140, 140]);
    }
}
