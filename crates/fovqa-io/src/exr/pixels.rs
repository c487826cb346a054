//! Reads selected channels of some parts, block by block, into planes of the display window.

use std::collections::BTreeSet;
use std::io::{Read, Seek};
use std::ops::Range;

use ::exr::block::UncompressedBlock;
use ::exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock};
use ::exr::block::reader::Reader;
use ::exr::compression::Compression;
use ::exr::math::Vec2;
use ::exr::meta::MetaData;
use ::exr::meta::attribute::{ChannelList, SampleType};
use fovqa_frame::{PlaneSamples, Samples};
use half::f16;
use half::vec::HalfBitsVecExt;
use rayon::prelude::*;

use super::error::damaged;
use super::window::Window;
use crate::contain::contained;
use crate::error::ReadErrorKind;

/// Planes of the display window, one after the other.
#[derive(Debug)]
pub(crate) enum Planes {
    Half(Vec<f16>, usize),
    Float(Vec<f32>, usize),
}

impl Planes {
    fn new(half: bool, planes: usize, size: usize) -> Self {
        if half {
            // The memory is zeroed by the system only when it is first used, so a file that
            // declares a large frame but holds no pixels does not cost the memory of that size.
            Planes::Half(vec![0u16; planes * size].reinterpret_into(), size)
        } else {
            Planes::Float(vec![0.0; planes * size], size)
        }
    }

    /// Removes the last plane and returns it.
    pub(crate) fn pop_as_f32(&mut self) -> Vec<f32> {
        match self {
            Planes::Half(values, size) => {
                let last = values.split_off(values.len() - *size);
                last.into_iter().map(f16::to_f32).collect()
            }
            Planes::Float(values, size) => values.split_off(values.len() - *size),
        }
    }

    /// Sets pixels that hold no data to NaN in each plane.
    pub(crate) fn blank(&mut self, uncovered: impl Iterator<Item = Range<usize>>) {
        for range in uncovered {
            match self {
                Planes::Half(values, size) => {
                    for plane in values.chunks_exact_mut(*size) {
                        plane[range.clone()].fill(f16::NAN);
                    }
                }
                Planes::Float(values, size) => {
                    for plane in values.chunks_exact_mut(*size) {
                        plane[range.clone()].fill(f32::NAN);
                    }
                }
            }
        }
    }

    /// The samples of a single plane.
    pub(crate) fn into_plane(self) -> PlaneSamples {
        match self {
            Planes::Half(values, _) => PlaneSamples::F16(values),
            Planes::Float(values, _) => PlaneSamples::F32(values),
        }
    }

    pub(crate) fn into_samples(self) -> Samples {
        match self {
            Planes::Half(values, _) => Samples::F16(values.into()),
            Planes::Float(values, _) => Samples::F32(values.into()),
        }
    }

    pub(crate) fn into_f32(self) -> Vec<f32> {
        match self {
            Planes::Half(values, _) => values.into_iter().map(f16::to_f32).collect(),
            Planes::Float(values, _) => values,
        }
    }

    /// Writes samples in native byte order, starting at position `at`.
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

/// The number of chunks that are decompressed before their samples are copied: a few for each
/// thread, so that all threads have work. With more of them, their memory would no longer fit into
/// the caches, and the allocator would return it to the system after every batch.
const CHUNKS_PER_THREAD: usize = 4;

/// The largest number of these chunks.
const CHUNKS_AT_ONCE: usize = 32;

/// The limit of the memory for these chunks with all their channels, in bytes.
const BYTES_AT_ONCE: usize = 64 << 20;

/// The channels of one part that are read into planes of one type.
#[derive(Debug)]
pub(crate) struct Request {
    pub(crate) part: usize,
    /// Channel indices, each at most once.
    pub(crate) channels: Vec<usize>,
    pub(crate) window: Window,
}

/// A request that is being read.
#[derive(Debug)]
struct Filling<'a> {
    request: &'a Request,
    kinds: Vec<SampleType>,
    planes: Planes,
    /// The number of samples read of each channel.
    read: Vec<usize>,
}

impl<'a> Filling<'a> {
    fn new(request: &'a Request, meta: &MetaData) -> Self {
        let all = &meta.headers[request.part].channels.list;
        let kinds: Vec<SampleType> = request.channels.iter().map(|&c| all[c].sample_type).collect();
        let half = kinds.iter().all(|kind| *kind == SampleType::F16);
        let planes = Planes::new(half, kinds.len(), request.window.display_len());
        let read = vec![0; kinds.len()];
        Self { request, kinds, planes, read }
    }

    /// Copies the requested samples from a block of its part.
    fn take(&mut self, block: &UncompressedBlock, all: &ChannelList) {
        let Request { channels, window, .. } = self.request;
        for line in block.lines(all) {
            let Some(plane) = channels.iter().position(|&c| c == line.location.channel) else {
                continue;
            };
            self.read[plane] += line.location.sample_count;
            let Vec2(x, y) = line.location.position;
            if let Some((at, bytes)) = window.visible(x, y, line.value, self.kinds[plane]) {
                self.planes.put(plane * window.display_len() + at, self.kinds[plane], bytes);
            }
        }
    }

    fn finish(self) -> Result<Planes, ReadErrorKind> {
        let expected = self.request.window.data_len();
        if self.read.iter().any(|&read| read != expected) {
            let detail = "some of its blocks are missing".to_owned();
            return Err(ReadErrorKind::Damaged { format: "OpenEXR", detail });
        }
        Ok(self.planes)
    }
}

/// Reads channels at full resolution, all requests in one pass over the blocks of their parts. The
/// planes of a request are in the order of its channels.
pub(crate) fn read(
    reader: Reader<impl Read + Seek + Send>,
    requests: &[Request],
) -> Result<Vec<Planes>, ReadErrorKind> {
    let meta = reader.meta_data().clone();
    let mut chunks = reader
        .filter_chunks(false, |_, tile, block| {
            tile.level_index == Vec2(0, 0) && requests.iter().any(|r| r.part == block.layer)
        })
        .map_err(damaged)?;
    // The planes are allocated only now: the offset table has been read, so the file is at least
    // that long.
    let mut fillings: Vec<Filling> =
        requests.iter().map(|request| Filling::new(request, &meta)).collect();
    let at_once = chunks_at_once(&meta, requests);
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
            let (part, Vec2(x, y)) = (block.index.layer, block.index.pixel_position);
            if !blocks_seen.insert((part, x, y)) {
                let detail = "one of its blocks appears twice".to_owned();
                return Err(ReadErrorKind::Damaged { format: "OpenEXR", detail });
            }
            for filling in fillings.iter_mut().filter(|filling| filling.request.part == part) {
                filling.take(&block, &meta.headers[part].channels);
            }
        }
    }
    fillings.into_iter().map(Filling::finish).collect()
}

/// The number of chunks to decompress at the same time.
fn chunks_at_once(meta: &MetaData, requests: &[Request]) -> usize {
    let bytes = requests.iter().map(|request| {
        let header = &meta.headers[request.part];
        let Vec2(w, h) = header.max_block_pixel_size();
        w * h * header.channels.bytes_per_pixel
    });
    let chunks = (CHUNKS_PER_THREAD * rayon::current_num_threads()).min(CHUNKS_AT_ONCE);
    (BYTES_AT_ONCE / bytes.max().unwrap_or(0).max(1)).clamp(1, chunks)
}

fn decompress(chunk: Chunk, meta: &MetaData) -> Result<UncompressedBlock, ReadErrorKind> {
    check_dwa_counters(&chunk, meta)?;
    contained(|| UncompressedBlock::decompress_chunk(chunk, meta, false)).map_or_else(
        || {
            let detail = "the decoder failed on it".to_owned();
            Err(ReadErrorKind::Damaged { format: "OpenEXR", detail })
        },
        |block| block.map_err(damaged),
    )
}

/// Refuses a DWA chunk whose counters ask for more than its block can hold: the decoder allocates
/// the memory they ask for, and a failed allocation cannot be caught.
fn check_dwa_counters(chunk: &Chunk, meta: &MetaData) -> Result<(), ReadErrorKind> {
    /// The number of counters without the last one, which names the coder (ImfDwaCompressor,
    /// "DataSizesSingle").
    const COUNTERS: usize = 10;
    /// Bytes for tables and rules, independent of the size of the block.
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
    // The size of this block: the last block and those at the right border may be smaller.
    let block = header
        .get_block_data_indices(&chunk.compressed_block)
        .and_then(|tile| header.get_absolute_block_pixel_coordinates(tile))
        .map_err(damaged)?;
    let Vec2(w, h) = block.size;
    // The cosine transform uses whole 8x8 blocks, with at most 8 bytes per sample.
    let samples = w.next_multiple_of(8) * h.next_multiple_of(8) * header.channels.list.len();
    // A chunk with exactly the size of its pixels is stored uncompressed, without counters.
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
