//! Finds the channels of the picture.
//!
//! A layer is a group of channels of one part that share the prefix before their last dot. It is
//! colour if it has R, G and B, or Y with RY and BY, or Y alone (without X, which would make it a
//! vector). Blender writes `ViewLayer.Combined.R`, Unreal and Mitsuba write `R` beside `albedo.R`,
//! others name the part. Data layers are not colour (see `data_layers.rs`).

use ::exr::meta::header::Header;

use super::data_layers::{Data, DataLayers};
use super::views::Views;
use crate::error::{ReadErrorKind, listed};

/// The name by which users ask for the channels without a prefix.
pub(super) const ROOT: &str = "root";

/// The channel indices of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Colour {
    /// R, G and B.
    Rgb([usize; 3]),
    /// Y, RY and BY.
    LuminanceChroma([usize; 3]),
    /// Y alone.
    Gray(usize),
}

impl Colour {
    pub(crate) fn channels(&self) -> &[usize] {
        match self {
            Colour::Rgb(channels) | Colour::LuminanceChroma(channels) => channels,
            Colour::Gray(channel) => std::slice::from_ref(channel),
        }
    }
}

/// A colour layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Layer {
    name: String,
    prefix: String,
    /// Index of the part.
    pub(crate) part: usize,
    pub(crate) colour: Colour,
    /// Channel index of A.
    pub(crate) alpha: Option<usize>,
    /// The view it belongs to, in lower case.
    pub(crate) view: Option<String>,
}

impl Layer {
    /// Part and prefix as one name; empty for channels that have neither.
    pub(crate) fn full_name(&self) -> &str {
        if self.name == ROOT { "" } else { &self.name }
    }
}

/// A layer that has the channels of a picture, and the reasons why it may not be one.
struct Candidate {
    layer: Layer,
    data: Option<Data>,
    /// Channels of an encoding that is not supported.
    odd: Option<String>,
}

/// The colour layer that was asked for, or else the only one, with the full names of all colour
/// layers.
pub(crate) fn choose(
    headers: &[Header],
    views: &Views,
    wanted: Option<&str>,
) -> Result<(Layer, Vec<String>), ReadErrorKind> {
    let data = DataLayers::of(headers);
    let candidates: Vec<Candidate> = headers
        .iter()
        .enumerate()
        .flat_map(|(part, header)| candidates(part, header, views, &data))
        .collect();
    let pictures: Vec<&Candidate> = candidates.iter().filter(|c| c.data.is_none()).collect();
    let names = pictures.iter().map(|c| c.layer.full_name().to_owned()).collect();
    let listed = || listed(pictures.iter().map(|c| c.layer.name.clone()));
    let chosen = match (wanted, pictures.as_slice()) {
        (Some(wanted), _) => match named(&candidates, &pictures, headers, wanted) {
            Some(found) => found,
            None if pictures.is_empty() => return Err(no_colour(headers)),
            None => {
                let (wanted, layers) = (wanted.to_owned(), listed());
                return Err(ReadErrorKind::NoSuchLayer { wanted, layers });
            }
        },
        (None, [only]) => only,
        (None, []) => return Err(no_colour(headers)),
        (None, _) => return Err(ReadErrorKind::SeveralLayers { layers: listed() }),
    };
    let layer = chosen.layer.clone();
    if chosen.data == Some(Data::Cryptomatte) {
        return Err(ReadErrorKind::Cryptomatte { layer: layer.name });
    }
    if let Some(channels) = &chosen.odd {
        let channels = channels.clone();
        return Err(ReadErrorKind::OtherEncoding { layer: layer.name, channels });
    }
    Ok((layer, names))
}

/// The layer of a name: the layer with this full name, or else the only picture with this name
/// within its part, this part or this view.
fn named<'a>(
    candidates: &'a [Candidate],
    pictures: &[&'a Candidate],
    headers: &[Header],
    wanted: &str,
) -> Option<&'a Candidate> {
    let only = |fits: &dyn Fn(&Layer) -> bool| {
        let mut fitting = pictures.iter().filter(|c| fits(&c.layer));
        fitting.next().filter(|_| fitting.next().is_none()).copied()
    };
    let is_view = |view: &String| view.eq_ignore_ascii_case(wanted);
    // The channels without a prefix may be a picture beside those of many layers, for example a
    // reference.
    let plain = || pictures.first().filter(|c| pictures.len() == 1 && c.layer.name == ROOT);
    candidates
        .iter()
        .find(|c| c.layer.name == wanted)
        .or_else(|| only(&|layer| layer.prefix == wanted))
        .or_else(|| only(&|layer| part_name(&headers[layer.part]) == wanted))
        .or_else(|| only(&|layer| layer.view.as_ref().is_some_and(is_view)))
        .or_else(|| plain().copied())
}

fn no_colour(headers: &[Header]) -> ReadErrorKind {
    let channels = headers.iter().flat_map(|h| h.channels.list.iter());
    ReadErrorKind::NoColour { channels: listed(channels.map(|c| c.name.to_string())) }
}

/// The layers of a part that have the channels of a picture.
fn candidates(part: usize, header: &Header, views: &Views, data: &DataLayers) -> Vec<Candidate> {
    let names: Vec<String> = header.channels.list.iter().map(|c| c.name.to_string()).collect();
    let split = names.iter().enumerate().map(|(index, name)| {
        let (prefix, channel) = name.rsplit_once('.').unwrap_or(("", name));
        (prefix, channel, index)
    });
    let mut split: Vec<(&str, &str, usize)> = split.collect();
    // Channels are in alphabetical order, which may not keep those of a layer together.
    split.sort_by_key(|(prefix, ..)| *prefix);
    let part_name = part_name(header);
    let layers = split.chunk_by(|(a, ..), (b, ..)| a == b);
    let pictures = layers.filter_map(|channels| {
        let prefix = channels[0].0;
        let find = |names: &[&str]| {
            let is_named =
                |channel: &str| names.iter().any(|name| channel.eq_ignore_ascii_case(name));
            channels.iter().find(|(_, channel, _)| is_named(channel)).map(|(.., index)| *index)
        };
        let (colour, odd) = colour(&find)?;
        let full = joined(&part_name, prefix);
        let view = views.of_layer(header, prefix, &full);
        let data = data.data(&views.without(&full));
        let name = layer_name(&part_name, prefix);
        let alpha = find(&["A", "alpha"]);
        let layer = Layer { name, prefix: prefix.to_owned(), part, colour, alpha, view };
        Some(Candidate { layer, data, odd })
    });
    pictures.collect()
}

/// Chroma channels beside a luminance Y, in encodings that are not supported.
const OTHER_CHROMA: [[&str; 2]; 5] =
    [["U", "V"], ["Cb", "Cr"], ["Pb", "Pr"], ["Co", "Cg"], ["I", "Q"]];

/// The colour channels among those of a layer, and channels of an encoding that is not supported.
fn colour(find: &dyn Fn(&[&str]) -> Option<usize>) -> Option<(Colour, Option<String>)> {
    let rgb = [["R", "red"], ["G", "green"], ["B", "blue"]].map(|names| find(&names));
    if let [Some(r), Some(g), Some(b)] = rgb {
        return Some((Colour::Rgb([r, g, b]), None));
    }
    if rgb != [None; 3] || find(&["X"]).is_some() {
        return None;
    }
    let luminance = find(&["Y"])?;
    match [find(&["RY"]), find(&["BY"])] {
        [Some(ry), Some(by)] => Some((Colour::LuminanceChroma([luminance, ry, by]), None)),
        [Some(_), None] => Some((Colour::Gray(luminance), Some("Y and RY without BY".to_owned()))),
        [None, Some(_)] => Some((Colour::Gray(luminance), Some("Y and BY without RY".to_owned()))),
        [None, None] => {
            let odd = OTHER_CHROMA.into_iter().find(|[a, b]| find(&[a]).and(find(&[b])).is_some());
            Some((Colour::Gray(luminance), odd.map(|[a, b]| format!("Y, {a} and {b}"))))
        }
    }
}

fn layer_name(part: &str, prefix: &str) -> String {
    match joined(part, prefix) {
        name if name.is_empty() => ROOT.to_owned(),
        name => name,
    }
}

/// Puts the name of a part in front of a layer's or channel's name, unless that name begins with it
/// already.
pub(super) fn joined(part: &str, name: &str) -> String {
    let rest = name.strip_prefix(part);
    let repeated = rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    match (part, name) {
        (part, "") => part.to_owned(),
        ("", name) => name.to_owned(),
        (_, name) if repeated => name.to_owned(),
        (part, name) => format!("{part}.{name}"),
    }
}

/// The name of a part; empty if it has none.
pub(super) fn part_name(header: &Header) -> String {
    let name = header.own_attributes.layer_name.as_ref().map(ToString::to_string);
    name.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_repeat_the_part() {
        assert_eq!(layer_name("", ""), "root");
        assert_eq!(layer_name("beauty", ""), "beauty");
        assert_eq!(layer_name("", "ViewLayer.Combined"), "ViewLayer.Combined");
        assert_eq!(layer_name("ViewLayer", "ViewLayer.Combined"), "ViewLayer.Combined");
        assert_eq!(layer_name("left", "albedo"), "left.albedo");
    }
}
