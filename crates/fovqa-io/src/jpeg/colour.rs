//! Converts components to gray or RGB.
//!
//! The frame header does not say which colours three or four components are. JFIF's and Adobe's
//! markers say it, or else the identifiers of the components. The rules are those of libjpeg.

use multiversion::multiversion;

use super::application::Application;
use super::error::Result;
use super::error::not_read;
use super::frame_header::FrameHeader;
use super::kind::JpegKind;

/// The meaning of the components.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Colours {
    Gray,
    Rgb,
    /// Luma and two colour differences (ITU-R BT.601, full range, as in JFIF).
    YCbCr,
    /// Inks, stored inverted as Adobe's programs do: 255 means no ink.
    Cmyk,
    /// Inks of which the first three are stored as luma and colour differences.
    Ycck,
}

impl Colours {
    /// The colours of a frame, by its header and the markers in front of it.
    ///
    /// # Errors
    /// When Adobe's marker has a transform that does not exist.
    pub(super) fn of(frame: &FrameHeader, application: &Application) -> Result<Self> {
        let components = frame.components.len();
        let unknown = |transform| not_read(JpegKind::ColourTransform { transform, components });
        let ids: Vec<u8> = frame.components.iter().map(|c| c.id).collect();
        match (components, application.adobe_transform) {
            (1, _) => Ok(Self::Gray),
            (3, _) if application.jfif => Ok(Self::YCbCr),
            (3, Some(0)) => Ok(Self::Rgb),
            (3, None) if ids == *b"RGB" => Ok(Self::Rgb),
            (3, None | Some(1)) => Ok(Self::YCbCr),
            (4, Some(0) | None) => Ok(Self::Cmyk),
            (4, Some(2)) => Ok(Self::Ycck),
            (_, transform) => Err(unknown(transform.unwrap_or_default())),
        }
    }

    /// Converts a row of components to interleaved RGB. Gray needs no conversion.
    pub(super) fn convert(self, row: &[Vec<u8>], out: &mut [u8]) {
        match (self, row) {
            (Self::Rgb, [r, g, b]) => interleave(r, g, b, out),
            (Self::YCbCr, [y, cb, cr]) => from_ycbcr(y, cb, cr, out),
            (Self::Cmyk, [c, m, y, k]) => {
                interleave(c, m, y, out);
                darken(k, out);
            }
            (Self::Ycck, [y, cb, cr, k]) => {
                from_ycbcr(y, cb, cr, out);
                // The converted values are inverted inks.
                for ink in out.iter_mut() {
                    *ink = 255 - *ink;
                }
                darken(k, out);
            }
            _ => {}
        }
    }
}

fn interleave(r: &[u8], g: &[u8], b: &[u8], out: &mut [u8]) {
    for (((out, r), g), b) in out.as_chunks_mut::<3>().0.iter_mut().zip(r).zip(g).zip(b) {
        *out = [*r, *g, *b];
    }
}

/// Multiplies the colours by the black ink.
fn darken(black: &[u8], out: &mut [u8]) {
    for (pixel, k) in out.as_chunks_mut::<3>().0.iter_mut().zip(black) {
        *pixel = pixel.map(|ink| ((u32::from(ink) * u32::from(*k) + 127) / 255) as u8);
    }
}

/// JFIF's conversion with 16 fractional bits.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn from_ycbcr(y: &[u8], cb: &[u8], cr: &[u8], out: &mut [u8]) {
    const HALF: i32 = 1 << 15;
    const fn fixed(value: f64) -> i32 {
        (value * 65536.0 + 0.5) as i32
    }
    for (((out, y), cb), cr) in out.as_chunks_mut::<3>().0.iter_mut().zip(y).zip(cb).zip(cr) {
        let (y, cb, cr) = (i32::from(*y), i32::from(*cb) - 128, i32::from(*cr) - 128);
        let red = y + ((fixed(1.402) * cr + HALF) >> 16);
        let green = y + ((HALF - fixed(0.344_14) * cb - fixed(0.714_14) * cr) >> 16);
        let blue = y + ((fixed(1.772) * cb + HALF) >> 16);
        *out = [red, green, blue].map(|v| v.clamp(0, 255) as u8);
    }
}
