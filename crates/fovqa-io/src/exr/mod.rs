//! OpenEXR: reads one colour layer of one part in the display window, converted to Rec.709, with
//! its motion and depth.

mod attributes;
mod channels;
mod data_layers;
mod error;
mod guides;
mod layers;
mod luminance_chroma;
mod pixels;
mod views;
mod window;

use std::io::{BufRead, Seek};

use ::exr::block::reader::Reader;
use ::exr::math::Vec2;
use ::exr::meta::MetaData;
use ::exr::meta::header::Header;
use fovqa_frame::{Channels, Chromaticities, Frame, Samples};

use crate::alpha::{AlphaPolicy, require_opaque};
use crate::decoded::{Decoded, DecodedGuides};
use crate::error::ReadErrorKind;
use crate::guides::GuideFile;
use crate::note::Note;
use crate::read_options::ReadOptions;
use error::{damaged, no_parts};
use guides::ColourContext;
use layers::Colour;
use pixels::Request;
use views::Views;
use window::Window;

/// The size of a file's display window.
pub(crate) fn size(mut file: impl BufRead + Seek + Send) -> Result<(usize, usize), ReadErrorKind> {
    attributes::check(&mut file)?;
    let meta = MetaData::read_from_buffered(&mut file, false).map_err(damaged)?;
    let size = meta.headers.first().map(|header| header.shared_attributes.display_window.size);
    let size = size.ok_or_else(no_parts)?;
    Ok((size.width(), size.height()))
}

pub(crate) fn read(
    file: impl BufRead + Seek + Send,
    options: &ReadOptions,
) -> Result<Decoded, ReadErrorKind> {
    let reader = reader(file, options)?;
    let headers = reader.headers();
    let views = Views::of(headers);
    let (layer, layers) = layers::choose(headers, &views, options.layer.as_deref())?;
    let header = &headers[layer.part];
    let window = Window::of(header)?;
    let alpha = layer.alpha.filter(|_| options.alpha == AlphaPolicy::Error);
    let is_gray = matches!(layer.colour, Colour::Gray(_));
    let primaries = primaries(header)?.filter(|_| !is_gray);
    let luminance_weights =
        chromaticities(header).unwrap_or(Chromaticities::REC709).luminance_weights();
    let beside = ColourContext {
        place: GuideFile::Colour,
        layer: layer.full_name(),
        view: layer.view.clone(),
        layers: &layers,
    };
    let found = guides::find(headers, &views, &options.guides, &beside)?;
    let pixel_aspect = header.shared_attributes.pixel_aspect;

    let channels: Vec<usize> = layer.colour.channels().iter().copied().chain(alpha).collect();
    let mut requests = found.requests(headers, &headers[layer.part])?;
    requests.insert(0, Request { part: layer.part, channels, window });
    let mut planes = pixels::read(reader, &requests)?;
    let guide_planes = planes.split_off(1);
    let mut planes = planes.pop().unwrap_or_else(|| unreachable!("planes for each request"));
    if alpha.is_some() {
        // Pixels without data do not belong to the picture: they are opaque black.
        let alpha = planes.pop_as_f32().into_iter().enumerate();
        let alpha = alpha.map(|(i, a)| if window.has_data(i) { a } else { 1.0 });
        require_opaque(alpha, window.display_width)?;
    }
    let mut notes = Vec::new();
    if !window.data_covers_display() {
        notes.push(Note::UncoveredPixels);
    }
    if primaries.is_some() {
        notes.push(Note::ConvertedPrimaries);
    }
    let samples = match (layer.colour, primaries) {
        (Colour::LuminanceChroma(_), primaries) => {
            let weights = luminance_weights.ok_or(ReadErrorKind::Chromaticities)?;
            let values = luminance_chroma::to_rgb(planes.into_f32(), weights);
            Samples::F32(match primaries {
                Some(matrix) => converted(values, &matrix).into(),
                None => values.into(),
            })
        }
        (_, Some(matrix)) => Samples::F32(converted(planes.into_f32(), &matrix).into()),
        (_, None) => planes.into_samples(),
    };
    let colour = if is_gray { Channels::Gray } else { Channels::Rgb };
    let frame = Frame::new(window.display_width, window.display_height, colour, samples)
        .map_err(|e| ReadErrorKind::Damaged { format: "OpenEXR", detail: e.to_string() })?;
    let (guides, guide_notes) = found.guides(&requests[1..], guide_planes)?;
    notes.extend(guide_notes);
    Ok(Decoded { frame, notes, guides, guide_search: found.search, pixel_aspect })
}

/// Reads the motion and depth of a file that may have no colour. Everything that is asked for must
/// exist.
pub(crate) fn read_guides(
    file: impl BufRead + Seek + Send,
    options: &ReadOptions,
) -> Result<DecodedGuides, ReadErrorKind> {
    let reader = reader(file, options)?;
    let headers = reader.headers();
    let views = Views::of(headers);
    let layer = options.layer.as_deref().filter(|&layer| layer != layers::ROOT);
    let layer = layer.unwrap_or_default();
    let view = views.in_name(layer);
    let beside = ColourContext { place: GuideFile::Separate, layer, view, layers: &[] };
    let found = guides::find(headers, &views, &options.guides, &beside)?;
    let missing = found.search.missing_motion().or_else(|| found.search.missing_depth());
    if let Some(missing) = missing {
        return Err(missing);
    }
    let Some(first) = headers.first() else { return Err(no_parts()) };
    let requests = found.requests(headers, first)?;
    let planes = pixels::read(reader, &requests)?;
    let (guides, notes) = found.guides(&requests, planes)?;
    Ok(DecodedGuides { guides, notes, search: found.search })
}

/// Reads the headers. Attributes and sizes are checked first, so that nothing is allocated for a
/// file that declares too much.
fn reader<R: BufRead + Seek + Send>(
    mut file: R,
    options: &ReadOptions,
) -> Result<Reader<R>, ReadErrorKind> {
    attributes::check(&mut file)?;
    let meta = MetaData::read_from_buffered(&mut file, false).map_err(damaged)?;
    for header in &meta.headers {
        if header.deep {
            return Err(ReadErrorKind::Deep);
        }
        if let Some(channel) = header.channels.list.iter().find(|c| c.sampling != Vec2(1, 1)) {
            return Err(ReadErrorKind::Subsampled { channel: channel.name.to_string() });
        }
        let Vec2(w, h) = header.max_block_pixel_size();
        let block = (w as u64)
            .saturating_mul(h as u64)
            .saturating_mul(header.channels.bytes_per_pixel as u64);
        options.check_block(block)?;
        for size in [header.layer_size, header.shared_attributes.display_window.size] {
            options.check_size(size.0 as u64, size.1 as u64)?;
        }
    }
    file.rewind()?;
    ::exr::block::read(file, false).map_err(damaged)
}

/// The primaries that a file declares.
fn chromaticities(header: &Header) -> Option<Chromaticities> {
    let given = header.shared_attributes.chromaticities?;
    let xy = |v: Vec2<f32>| [f64::from(v.0), f64::from(v.1)];
    Some(Chromaticities {
        red: xy(given.red),
        green: xy(given.green),
        blue: xy(given.blue),
        white: xy(given.white),
    })
}

/// The matrix to Rec.709, if the file has other primaries.
fn primaries(header: &Header) -> Result<Option<[[f64; 3]; 3]>, ReadErrorKind> {
    match chromaticities(header) {
        Some(given) if !given.is_rec709() => {
            given.to_rec709().map(Some).ok_or(ReadErrorKind::Chromaticities)
        }
        _ => Ok(None),
    }
}

fn converted(mut values: Vec<f32>, matrix: &[[f64; 3]; 3]) -> Vec<f32> {
    let plane = values.len() / 3;
    let (r, rest) = values.split_at_mut(plane);
    let (g, b) = rest.split_at_mut(plane);
    for ((r, g), b) in r.iter_mut().zip(g).zip(b) {
        let rgb = [f64::from(*r), f64::from(*g), f64::from(*b)];
        let [x, y, z] = matrix.map(|m| m[0] * rgb[0] + m[1] * rgb[1] + m[2] * rgb[2]);
        (*r, *g, *b) = (x as f32, y as f32, z as f32);
    }
    values
}
