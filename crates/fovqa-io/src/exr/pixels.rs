//! Chosen channels of one part, block by block, into planes of the display window.

use std::collections::BTreeSet;
use std::io::{Read, Seek};
use std::ops::Range;

use ::exr::block::UncompressedBlock;
use ::exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock};
use ::exr::block::reader::Reader;
use ::exr::compression::Compression;
use ::exr::math::Vec2;
use ::exr::meta::MetaData;
use ::exr::meta::attribute::SampleType;
use ::exr::meta::header::Header;
use fovqa_frame::Samples;
use half::f16;
use half::vec::HalfBitsVecExt;
use rayon::prelude::*;

use super::damaged;
use crate::contain::contained;
use crate::error::ReadErrorKind;

/// The display window, and where the data window lies in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Window {
    pub(crate) display_width: usize,
    pub(crate) display_height: usize,
    /// Position of the data window's corner relative to the display window's.
    data_at: (i64, i64),
    data_size: (usize, usize),
}

impl Window {
    pub(crate) fn of(header: &Header) -> Result<Self, ReadErrorKind> {
        let display = header.shared_attributes.display_window;
        let data = header.own_attributes.layer_position;
        let size = header.layer_size;
        let window = Self {
            display_width: display.size.0,
            display_height: display.size.1,
            data_at: (
                i64::from(data.0) - i64::from(display.position.0),
                i64::from(data.1) - i64::from(display.position.1),
            ),
            data_size: (size.0, size.1),
        };
        if window.columns().is_empty() || window.rows().is_empty() {
            let text = |w: usize, h: usize, x: i32, y: i32| format!("{w}x{h}{x:+}{y:+}");
            return Err(ReadErrorKind::DisjointWindows {
                data: text(size.0, size.1, data.0, data.1),
                display: text(
                    display.size.0,
                    display.size.1,
                    display.position.0,
                    display.position.1,
                ),
            });
        }
        Ok(window)
    }

    /// Columns of the display window that hold data.
    fn columns(&self) -> Range<usize> {
        overlap(self.data_at.0, self.data_size.0, self.display_width)
    }

    /// Rows of the display window that hold data.
    fn rows(&self) -> Range<usize> {
        overlap(self.data_at.1, self.data_size.1, self.display_height)
    }

    /// Whether pixel `index` of the display window holds data.
    pub(crate) fn has_data(&self, index: usize) -> bool {
        let (x, y) = (index % self.display_width, index / self.display_width);
        self.columns().contains(&x) && self.rows().contains(&y)
    }

    pub(crate) fn data_covers_display(&self) -> bool {
        self.columns() == (0..self.display_width) && self.rows() == (0..self.display_height)
    }
}

fn overlap(at: i64, length: usize, size: usize) -> Range<usize> {
    let from = at.clamp(0, size as i64);
    let to = at.saturating_add(length as i64).clamp(0, size as i64);
    from as usize..to as usize
}

/// Planes of the display window, one after the other.
#[derive(Debug)]
pub(crate) enum Planes {
    Half(Vec<f16>, usize),
    Float(Vec<f32>, usize),
}

impl Planes {
    fn new(half: bool, planes: usize, size: usize) -> Self {
        if half {
            // From zeroed memory, which the system hands out untouched: a file that declares a
            // large frame and holds none must not cost its size.
            Planes::Half(vec![0u16; planes * size].reinterpret_into(), size)
        } else {
            Planes::Float(vec![0.0; planes * size], size)
        }
    }

    /// Takes the last plane off.
    pub(crate) fn pop_as_f32(&mut self) -> Vec<f32> {
        match self {
            Planes::Half(values, size) => {
                let last = values.split_off(values.len() - *size);
                last.into_iter().map(f16::to_f32).collect()
            }
            Planes::Float(values, size) => values.split_off(values.len() - *size),
        }
    }

    pub(crate) fn into_samples(self) -> Samples {
        match self {
            Planes::Half(values, _) => Samples::F16(values),
            Planes::Float(values, _) => Samples::F32(values),
        }
    }

    pub(crate) fn into_f32(self) -> Vec<f32> {
        match self {
            Planes::Half(values, _) => values.into_iter().map(f16::to_f32).collect(),
            Planes::Float(values, _) => values,
        }
    }

    /// Writes samples in native byte order from position `at` on.
    fn put(&mut self, at: usize, kind: SampleType, bytes: &[u8]) {
        let halves =
            || bytes.as_chunks::<2>().0.iter().map(|b| f16::from_bits(u16::from_ne_bytes(*b)));
        let words = || bytes.as_chunks::<4>().0.iter().map(|b| u32::from_ne_bytes(*b));
        match (self, kind) {
            (Planes::Half(out, _), _) => {
                for (out, value) in out[at..].iter_mut().zip(halves()) {
                    *out = value;
                }
            }
            (Planes::Float(out, _), SampleType::F16) => {
                for (out, value) in out[at..].iter_mut().zip(halves()) {
                    *out = value.to_f32();
                }
            }
            (Planes::Float(out, _), SampleType::F32) => {
                for (out, value) in out[at..].iter_mut().zip(words()) {
                    *out = f32::from_bits(value);
                }
            }
            (Planes::Float(out, _), SampleType::U32) => {
                for (out, value) in out[at..].iter_mut().zip(words()) {
                    *out = value as f32;
                }
            }
        }
    }
}

/// Chunks that are decompressed at the same time: enough for many cores …
const CHUNKS_AT_ONCE: usize = 32;

/// … and as long as they, with all their channels, stay small.
const BYTES_AT_ONCE: usize = 64 << 20;

/// Reads `channels` of a part at full resolution.
pub(crate) fn read(
    reader: Reader<impl Read + Seek + Send>,
    part: usize,
    channels: &[usize],
    window: &Window,
) -> Result<Planes, ReadErrorKind> {
    let kinds: Vec<SampleType> =
        channels.iter().map(|&c| reader.headers()[part].channels.list[c].sample_type).collect();
    let size = window.display_width * window.display_height;
    let half = kinds.iter().all(|kind| *kind == SampleType::F16);
    let meta = reader.meta_data().clone();
    let mut chunks = reader
        .filter_chunks(false, |_, tile, block| {
            block.layer == part && tile.level_index == Vec2(0, 0)
        })
        .map_err(damaged)?;
    // Only now: the offset table has been read, so the file is at least that long.
    let mut planes = Planes::new(half, channels.len(), size);
    let Vec2(w, h) = meta.headers[part].max_block_pixel_size();
    let block_bytes = (w * h * meta.headers[part].channels.bytes_per_pixel).max(1);
    let at_once = (BYTES_AT_ONCE / block_bytes).clamp(1, CHUNKS_AT_ONCE);
    let mut samples_read = vec![0usize; channels.len()];
    let mut blocks_seen = BTreeSet::new();
    loop {
        let batch: Vec<Chunk> =
            chunks.by_ref().take(at_once).collect::<Result<_, _>>().map_err(damaged)?;
        if batch.is_empty() {
            break;
        }
        let blocks: Vec<_> = batch.into_par_iter().map(|chunk| decompress(chunk, &meta)).collect();
        for block in blocks {
            let block = block?;
            if !blocks_seen.insert((block.index.pixel_position.0, block.index.pixel_position.1)) {
                let detail = "one of its blocks is there twice".to_owned();
                return Err(ReadErrorKind::Damaged { format: "OpenEXR", detail });
            }
            for line in block.lines(&meta.headers[part].channels) {
                let Some(plane) = channels.iter().position(|&c| c == line.location.channel) else {
                    continue;
                };
                samples_read[plane] += line.location.sample_count;
                let Vec2(x, y) = line.location.position;
                if let Some((at, bytes)) = visible(window, x, y, line.value, kinds[plane]) {
                    planes.put(plane * size + at, kinds[plane], bytes);
                }
            }
        }
    }
    let expected = window.data_size.0 * window.data_size.1;
    if samples_read.iter().any(|&read| read != expected) {
        let detail = "some of its blocks are missing".to_owned();
        return Err(ReadErrorKind::Damaged { format: "OpenEXR", detail });
    }
    Ok(planes)
}

fn decompress(chunk: Chunk, meta: &MetaData) -> Result<UncompressedBlock, ReadErrorKind> {
    check_dwa_counters(&chunk, meta)?;
    contained(|| UncompressedBlock::decompress_chunk(chunk, meta, false)).map_or_else(
        || {
            let detail = "the decoder broke down on it".to_owned();
            Err(ReadErrorKind::Damaged { format: "OpenEXR", detail })
        },
        |block| block.map_err(damaged),
    )
}

/// Refuses a DWA chunk whose counters ask for more than its block can hold: the decoder allocates
/// what they say, and a failed allocation cannot be contained.
fn check_dwa_counters(chunk: &Chunk, meta: &MetaData) -> Result<(), ReadErrorKind> {
    /// All but the last, which names the coder (ImfDwaCompressor, "DataSizesSingle").
    const COUNTERS: usize = 10;
    /// For tables and rules, whatever the size of the block.
    const SLACK: u64 = 1 << 16;
    let Some(header) = meta.headers.get(chunk.layer_index) else { return Ok(()) };
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return Ok(());
    }
    let (CompressedBlock::ScanLine(CompressedScanLineBlock {
        compressed_pixels_le: bytes, ..
    })
    | CompressedBlock::Tile(CompressedTileBlock { compressed_pixels_le: bytes, .. })) =
        &chunk.compressed_block
    else {
        return Ok(());
    };
    // Of this block: the last one, and those at the right border, may be smaller.
    let block = header
        .get_block_data_indices(&chunk.compressed_block)
        .and_then(|tile| header.get_absolute_block_pixel_coordinates(tile))
        .map_err(damaged)?;
    let Vec2(w, h) = block.size;
    // Whole 8x8 blocks of the cosine transform, at most 8 bytes a sample on the way.
    let samples = w.next_multiple_of(8) * h.next_multiple_of(8) * header.channels.list.len();
    // A chunk of exactly the size of its pixels is stored as it is, without counters.
    if bytes.len() == w * h * header.channels.bytes_per_pixel {
        return Ok(());
    }
    let most = samples as u64 * 8 + SLACK;
    let counters = bytes.as_chunks::<8>().0.iter().take(COUNTERS);
    if counters.map(|c| u64::from_le_bytes(*c)).any(|counter| counter > most) {
        let detail = "a block declares more data than it can hold".to_owned();
        return Err(ReadErrorKind::Damaged { format: "OpenEXR", detail });
    }
    Ok(())
}

/// The part of a line inside the display window: where it goes, and its bytes.
fn visible<'a>(
    window: &Window,
    x: usize,
    y: usize,
    bytes: &'a [u8],
    kind: SampleType,
) -> Option<(usize, &'a [u8])> {
    let sample = if kind == SampleType::F16 { 2 } else { 4 };
    let (x, y) = (x as i64 + window.data_at.0, y as i64 + window.data_at.1);
    let columns = overlap(x, bytes.len() / sample, window.display_width);
    if columns.is_empty() || !(0..window.display_height as i64).contains(&y) {
        return None;
    }
    let skip = (columns.start as i64 - x) as usize;
    let bytes = &bytes[skip * sample..(skip + columns.len()) * sample];
    Some((y as usize * window.display_width + columns.start, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_of_windows() {
        assert_eq!(overlap(-3, 10, 5), 0..5);
        assert_eq!(overlap(2, 10, 5), 2..5);
        assert_eq!(overlap(-3, 5, 5), 0..2);
        assert!(overlap(5, 3, 5).is_empty());
        assert!(overlap(-3, 3, 5).is_empty());
    }
}
