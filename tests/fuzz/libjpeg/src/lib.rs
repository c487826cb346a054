//! What libjpeg makes of a file.

use std::ffi::{CStr, c_char, c_int, c_uint, c_ulong};

#[repr(C)]
struct Raw {
    width: c_uint,
    height: c_uint,
    channels: c_uint,
    samples: *mut u8,
    failed: c_int,
    warnings: c_int,
    first_code: c_int,
    message: [c_char; 200],
}

unsafe extern "C" {
    fn fovqa_fuzz_decode(
        bytes: *const u8,
        length: usize,
        most_samples: c_ulong,
        in_floats: c_int,
        result: *mut Raw,
    );
    fn free(memory: *mut u8);
}

/// A decoded file, or what libjpeg says of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decoded {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// 1 (gray) or 3 (RGB).
    pub channels: usize,
    /// Interleaved samples.
    pub samples: Vec<u8>,
    /// What libjpeg found wrong, while it went on.
    pub warning: Option<String>,
}

/// How libjpeg transforms coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Transform {
    /// Its default: whole numbers, which overflow where no image has such coefficients.
    Whole,
    /// Floats, a little different.
    Float,
}

/// Decodes a file of at most `most_samples` samples.
///
/// # Errors
/// In libjpeg's words.
pub fn decode(bytes: &[u8], most_samples: usize, transform: Transform) -> Result<Decoded, String> {
    // SAFETY: zeros are valid for all of its fields.
    let mut raw: Raw = unsafe { std::mem::zeroed() };
    // SAFETY: reads `length` bytes, fills the result in.
    unsafe {
        let in_floats = c_int::from(transform == Transform::Float);
        let most = most_samples as c_ulong;
        fovqa_fuzz_decode(bytes.as_ptr(), bytes.len(), most, in_floats, &raw mut raw);
    }
    let (width, height) = (raw.width as usize, raw.height as usize);
    let channels = raw.channels as usize;
    let mut samples = Vec::new();
    if !raw.samples.is_null() {
        let count = width * height * channels;
        // SAFETY: allocated with that size, and freed once.
        unsafe {
            samples.extend_from_slice(std::slice::from_raw_parts(raw.samples, count));
            free(raw.samples);
        }
    }
    // SAFETY: zeros stand behind the message.
    let message = unsafe { CStr::from_ptr(raw.message.as_ptr()) }.to_string_lossy().into_owned();
    if raw.failed != 0 {
        return Err(message);
    }
    let (samples, channels) = if channels == 4 { (without_inks(&samples), 3) } else { (samples, channels) };
    let warning = (raw.warnings > 0).then_some(message);
    Ok(Decoded { width, height, channels, samples, warning })
}

/// Inks as Adobe's programs store them, as RGB: what libjpeg's `djpeg` does.
fn without_inks(samples: &[u8]) -> Vec<u8> {
    let pixels = samples.chunks_exact(4);
    pixels
        .flat_map(|inks| {
            [0, 1, 2].map(|c| (f64::from(inks[c]) * f64::from(inks[3]) / 255.0 + 0.5) as u8)
        })
        .collect()
}
