//! Converts planes of Y', Cb and Cr to R'G'B' (Rec. ITU-R BT.601-7, BT.709-6 and BT.2020-2,
//! non-constant luminance).
//!
//! With `n` bits and limited range, `y = (Y - 16·2ⁿ⁻⁸) / (219·2ⁿ⁻⁸)` and
//! `c = (C - 128·2ⁿ⁻⁸) / (224·2ⁿ⁻⁸)`; with full range, `y = Y / (2ⁿ - 1)` and
//! `c = (C - 2ⁿ⁻¹) / (2ⁿ - 1)`. Then
//!
//! ```text
//! R = y + 2 (1 - Kr) cr
//! B = y + 2 (1 - Kb) cb
//! G = (y - Kr R - Kb B) / (1 - Kr - Kb)
//! ```
//!
//! The results are clamped to 0 to 1. Where Cb and Cr have fewer samples than pixels, they are
//! interpolated linearly between the two samples next to a pixel; samples at an edge are repeated.

use fovqa_frame::{Channels, Frame, FrameError, Samples};
use multiversion::multiversion;
use rayon::prelude::*;

use super::colour::{Chroma, Sampling};
use super::header::Header;
use super::options::{CodeRange, ColourMatrix, Y4mOptions};

/// A video without a declared matrix is high definition from this number of lines on.
const HIGH_DEFINITION: usize = 720;

/// The number of rows that one thread converts at a time.
const ROWS: usize = 16;

/// A code that is too large for the bits of the video.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct BadCode {
    pub(super) plane: &'static str,
    pub(super) x: usize,
    pub(super) y: usize,
    pub(super) code: u16,
}

/// The conversion from codes to R'G'B'.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Conversion {
    /// The code of black, and the number of codes from black to white. Values are divided by that
    /// number instead of multiplied by its inverse, so that white is exactly 1, and full-range gray
    /// equals a PNG of the same codes.
    black: f32,
    white: f32,
    /// The code of neutral chroma.
    neutral: f32,
    /// The contributions of Cr to R and G, and of Cb to G and B, per code.
    red: f32,
    green: [f32; 2],
    blue: f32,
}

impl Conversion {
    pub(super) fn new(header: &Header, options: Y4mOptions) -> Self {
        let default =
            if header.height < HIGH_DEFINITION { ColourMatrix::Bt601 } else { ColourMatrix::Bt709 };
        let (kr, kb) = match options.matrix.unwrap_or(default) {
            ColourMatrix::Bt601 => (0.299, 0.114),
            ColourMatrix::Bt709 => (0.2126, 0.0722),
            ColourMatrix::Bt2020 => (0.2627, 0.0593),
        };
        let scale = f64::from(1 << (header.colour.bits - 8));
        let greatest = f64::from(header.colour.greatest());
        let (black, white, chroma) =
            match options.range.or(header.range).unwrap_or(CodeRange::Limited) {
                CodeRange::Limited => (16.0 * scale, 219.0 * scale, 224.0 * scale),
                CodeRange::Full => (0.0, greatest, greatest),
            };
        let (of_red, of_blue, kg) = (2.0 * (1.0 - kr), 2.0 * (1.0 - kb), 1.0 - kr - kb);
        let a_code = |value: f64| (value / chroma) as f32;
        Self {
            black: black as f32,
            white: white as f32,
            neutral: (128.0 * scale) as f32,
            red: a_code(of_red),
            green: [a_code(-kr * of_red / kg), a_code(-kb * of_blue / kg)],
            blue: a_code(of_blue),
        }
    }

    /// The frame of the given planes.
    pub(super) fn frame(self, header: &Header, bytes: &[u8]) -> Result<Frame, BadCode> {
        if header.colour.sample_bytes() == 1 {
            Ok(self.of_codes(header, bytes))
        } else {
            let words = bytes.as_chunks().0.iter().map(|word| u16::from_le_bytes(*word));
            let words: Vec<u16> = words.collect();
            check_codes(header, &words)?;
            Ok(self.of_codes(header, &words))
        }
    }

    fn of_codes<T: Copy + Sync + Into<f32>>(self, header: &Header, codes: &[T]) -> Frame {
        let (width, height) = (header.width, header.height);
        let [luma, chroma] = header.samples();
        let (y, rest) = codes.split_at(luma);
        let frame = match header.colour.chroma.zip(header.chroma_size()) {
            None => {
                let black = |code: &T| self.luma((*code).into()).clamp(0.0, 1.0);
                let gray: Vec<f32> = y.par_iter().with_min_len(ROWS * width).map(black).collect();
                Frame::new(width, height, Channels::Gray, Samples::F32(gray.into()))
            }
            Some((sampling, (chroma_width, _))) => {
                let [cb, cr] = [&rest[..chroma], &rest[chroma..]].map(|codes| Plane {
                    codes,
                    width: chroma_width,
                    sampling,
                });
                let mut rgb = vec![0.0; 3 * luma];
                let (red, rest) = rgb.split_at_mut(luma);
                let (green, blue) = rest.split_at_mut(luma);
                let chunk = ROWS * width;
                let chunks = red.par_chunks_mut(chunk).zip(green.par_chunks_mut(chunk));
                let chunks = chunks.zip(blue.par_chunks_mut(chunk)).enumerate();
                chunks.for_each(|(index, ((red, green), blue))| {
                    let mut rows = Rows::new(width, chroma_width);
                    let row = red.chunks_exact_mut(width).zip(green.chunks_exact_mut(width));
                    for (at, ((red, green), blue)) in
                        row.zip(blue.chunks_exact_mut(width)).enumerate()
                    {
                        let at = index * ROWS + at;
                        cb.row(at, &mut rows.samples, &mut rows.cb);
                        cr.row(at, &mut rows.samples, &mut rows.cr);
                        copy(&y[at * width..][..width], &mut rows.y);
                        rgb_row(self, [&rows.y, &rows.cb, &rows.cr], [red, green, blue]);
                    }
                });
                Frame::new(width, height, Channels::Rgb, Samples::F32(rgb.into()))
            }
        };
        let sized = |error: FrameError| unreachable!("a sample for each pixel: {error}");
        frame.unwrap_or_else(sized).encoded()
    }

    fn luma(self, code: f32) -> f32 {
        (code - self.black) / self.white
    }
}

/// Converts a row of codes, one per pixel, to R'G'B'.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn rgb_row(conversion: Conversion, [y, cb, cr]: [&[f32]; 3], [red, green, blue]: [&mut [f32]; 3]) {
    let Conversion { black, white, neutral, red: r, green: [g_cr, g_cb], blue: b } = conversion;
    let pixels = red.iter_mut().zip(green).zip(blue).zip(y).zip(cb.iter().zip(cr));
    for ((((red, green), blue), y), (cb, cr)) in pixels {
        let (y, cb, cr) = ((y - black) / white, cb - neutral, cr - neutral);
        *red = (y + r * cr).clamp(0.0, 1.0);
        *green = (y + g_cr * cr + g_cb * cb).clamp(0.0, 1.0);
        *blue = (y + b * cb).clamp(0.0, 1.0);
    }
}

/// Buffers of one thread.
struct Rows {
    /// A row of chroma samples, before upsampling.
    samples: Vec<f32>,
    y: Vec<f32>,
    cb: Vec<f32>,
    cr: Vec<f32>,
}

impl Rows {
    fn new(width: usize, chroma_width: usize) -> Self {
        let row = vec![0.0; width];
        Self { samples: vec![0.0; chroma_width], y: row.clone(), cb: row.clone(), cr: row }
    }
}

/// A plane of chroma.
#[derive(Clone, Copy)]
struct Plane<'a, T> {
    codes: &'a [T],
    width: usize,
    sampling: Chroma,
}

impl<T: Copy + Into<f32>> Plane<'_, T> {
    /// Writes the codes at the pixels of a row. Weights are quarters and codes have at most 12
    /// bits, so nothing is rounded.
    fn row(self, y: usize, samples: &mut [f32], pixels: &mut [f32]) {
        match self.sampling.down {
            Sampling::Each => copy(self.samples(y), samples),
            Sampling::HalfFirst if y.is_multiple_of(2) => copy(self.samples(y / 2), samples),
            Sampling::HalfFirst => self.between(y / 2, y / 2 + 1, 0.5, samples),
            Sampling::HalfCentred if y.is_multiple_of(2) => {
                self.between(y / 2, (y / 2).saturating_sub(1), 0.75, samples);
            }
            Sampling::HalfCentred => self.between(y / 2, y / 2 + 1, 0.75, samples),
        }
        match self.sampling.across {
            Sampling::Each => pixels.copy_from_slice(samples),
            Sampling::HalfFirst => {
                spread(samples, pixels, |_, here, next| [here, 0.5 * (here + next)]);
            }
            Sampling::HalfCentred => spread(samples, pixels, |before, here, next| {
                [0.25 * before + 0.75 * here, 0.75 * here + 0.25 * next]
            }),
        }
    }

    fn samples(&self, row: usize) -> &[T] {
        &self.codes[row * self.width..][..self.width]
    }

    /// Interpolates between a row, with the weight `share`, and a neighbouring row. At the edge the
    /// row is its own neighbour.
    fn between(&self, row: usize, next: usize, share: f32, samples: &mut [f32]) {
        let last = self.codes.len() / self.width - 1;
        let (here, next) = (self.samples(row), self.samples(next.min(last)));
        for ((sample, here), next) in samples.iter_mut().zip(here).zip(next) {
            let (here, next): (f32, f32) = ((*here).into(), (*next).into());
            *sample = share * here + (1.0 - share) * next;
        }
    }
}

fn copy<T: Copy + Into<f32>>(codes: &[T], samples: &mut [f32]) {
    for (sample, code) in samples.iter_mut().zip(codes) {
        *sample = (*code).into();
    }
}

/// Two pixels for each sample, from the samples before and after it, which are repeated at the
/// edges.
fn spread(samples: &[f32], pixels: &mut [f32], two: impl Fn(f32, f32, f32) -> [f32; 2]) {
    let at = |index: usize| samples[index.min(samples.len() - 1)];
    let pair = |index: usize| two(at(index.saturating_sub(1)), at(index), at(index + 1));
    let (pairs, odd) = pixels.as_chunks_mut();
    let last = samples.len() - 1;
    if let Some(pixel) = pairs.first_mut() {
        *pixel = pair(0);
    }
    // The inner pixels are computed without indexing, because this loop dominates the time.
    for (pixel, around) in pairs.iter_mut().skip(1).zip(samples.windows(3)) {
        *pixel = two(around[0], around[1], around[2]);
    }
    if let Some(pixel) = pairs.get_mut(last).filter(|_| last > 0) {
        *pixel = pair(last);
    }
    if let [pixel] = odd {
        *pixel = pair(last)[0];
    }
}

/// Refuses codes that are too large for the bits of the video.
fn check_codes(header: &Header, codes: &[u16]) -> Result<(), BadCode> {
    let greatest = header.colour.greatest();
    // A fold instead of `any`: the loop vectorises only without an early exit.
    if codes.iter().fold(0, |greatest, code| greatest.max(*code)) <= greatest {
        return Ok(());
    }
    let at = codes.iter().position(|code| *code > greatest).unwrap_or(0);
    let [luma, chroma] = header.samples();
    let (plane, start, width) = if at < luma {
        ("Y'", 0, header.width)
    } else {
        let width = header.chroma_size().map_or(1, |(width, _)| width);
        let first = at < luma + chroma;
        if first { ("Cb", luma, width) } else { ("Cr", luma + chroma, width) }
    };
    let (x, y) = ((at - start) % width, (at - start) / width);
    Err(BadCode { plane, x, y, code: codes[at] })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(line: &str) -> Header {
        Header::parse(format!("YUV4MPEG2 {line}").as_bytes(), 1).unwrap()
    }

    fn frame(line: &str, bytes: &[u8]) -> Frame {
        let header = header(line);
        assert_eq!(bytes.len(), header.frame_bytes());
        Conversion::new(&header, Y4mOptions::default()).frame(&header, bytes).unwrap()
    }

    /// Full-range gray equals a PNG of the same codes, to the last bit.
    #[test]
    fn gray_of_full_range_is_its_codes() {
        let codes: Vec<u8> = (0..=255).collect();
        let gray = frame("W16 H16 Cmono XCOLORRANGE=FULL", &codes);
        assert!(gray.is_encoded());
        for code in 0..=255u8 {
            let (x, y) = (usize::from(code) % 16, usize::from(code) / 16);
            let as_png = f32::from(code) / 255.0;
            assert_eq!(gray.sample(0, x, y).to_bits(), as_png.to_bits());
        }
        let limited = frame("W3 H1 Cmono", &[15, 16, 235]);
        let values = [0, 1, 2].map(|x| limited.sample(0, x, 0));
        assert!(values.iter().zip([0.0, 0.0, 1.0]).all(|(a, b)| a.to_bits() == f32::to_bits(b)));
    }

    #[test]
    fn white_is_one() {
        for (bits, tag) in [(8, "444"), (10, "444p10"), (12, "444p12")] {
            for (range, white) in [("LIMITED", 235 << (bits - 8)), ("FULL", (1 << bits) - 1)] {
                let codes: [u16; 3] = [white, 1 << (bits - 1), 1 << (bits - 1)];
                let bytes = codes.iter().flat_map(|code| code.to_le_bytes());
                let bytes: Vec<u8> = bytes.step_by(if bits == 8 { 2 } else { 1 }).collect();
                let white = frame(&format!("W1 H1 C{tag} XCOLORRANGE={range}"), &bytes);
                let rgb = [0, 1, 2].map(|channel| white.sample(channel, 0, 0).to_bits());
                assert_eq!(rgb, [f32::to_bits(1.0); 3], "{bits} bits, {range}");
            }
        }
    }

    /// Cr is 0 or 224 codes from neutral. The expected values at five pixels of three samples are
    /// calculated by hand.
    #[test]
    fn chroma_lies_where_the_tag_says() {
        let bytes = |tag: &str| {
            let row = [126u8; 5].into_iter().chain([128; 3]).chain([16, 128, 240]);
            frame(&format!("W5 H1 C{tag}"), &row.collect::<Vec<u8>>())
        };
        let red = |tag: &str| [0, 1, 2, 3, 4].map(|x| bytes(tag).sample(0, x, 0));
        let neutral = 110.0 / 219.0;
        let at = |share: f32| (neutral + 1.402 * share).clamp(0.0, 1.0);
        for (tag, shares) in [
            ("420jpeg", [-0.5, -0.375, -0.125, 0.125, 0.375]),
            ("420mpeg2", [-0.5, -0.25, 0.0, 0.25, 0.5]),
            ("422", [-0.5, -0.25, 0.0, 0.25, 0.5]),
        ] {
            for (x, (found, share)) in red(tag).into_iter().zip(shares).enumerate() {
                assert!(
                    (found - at(share)).abs() < 1e-6,
                    "{tag} at {x}: {found}, not {}",
                    at(share)
                );
            }
        }
    }

    #[test]
    fn codes_beyond_the_bits_are_found() {
        let header = header("W3 H2 C420p10");
        let mut codes = [512u16; 6 + 2 * 2];
        codes[9] = 1024;
        let bytes: Vec<u8> = codes.iter().flat_map(|code| code.to_le_bytes()).collect();
        let conversion = Conversion::new(&header, Y4mOptions::default());
        let error = conversion.frame(&header, &bytes).unwrap_err();
        assert_eq!(error, BadCode { plane: "Cr", x: 1, y: 0, code: 1024 });
    }
}
