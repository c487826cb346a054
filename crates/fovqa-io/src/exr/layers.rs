//! Which channels are the picture.
//!
//! A layer is what channels share in front of their last dot, within one part. It is colour when
//! it has R, G and B, or Y alone (without X, which would make it a vector). Blender writes
//! `ViewLayer.Combined.R`, Unreal and Mitsuba `R` beside `albedo.R`, others name the part.

use ::exr::meta::header::Header;

use crate::error::{ReadErrorKind, listed};

/// The name under which the channels without a prefix are asked for.
pub(super) const ROOT: &str = "root";

/// A colour layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Layer {
    name: String,
    prefix: String,
    /// Index of the part.
    pub(crate) part: usize,
    /// Channel indices of R, G, B, or of Y alone.
    pub(crate) colour: Vec<usize>,
    /// Channel index of A.
    pub(crate) alpha: Option<usize>,
}

impl Layer {
    /// Part and prefix as one name, empty for channels that have neither.
    pub(crate) fn full_name(&self) -> &str {
        if self.name == ROOT { "" } else { &self.name }
    }
}

/// The colour layer asked for, or the only one.
pub(crate) fn choose(headers: &[Header], wanted: Option<&str>) -> Result<Layer, ReadErrorKind> {
    let mut layers: Vec<Layer> =
        headers.iter().enumerate().flat_map(|(part, header)| colour_layers(part, header)).collect();
    if layers.is_empty() {
        let channels = headers.iter().flat_map(|h| h.channels.list.iter());
        let channels = listed(channels.map(|c| c.name.to_string()));
        return Err(ReadErrorKind::NoColour { channels });
    }
    let names = listed(layers.iter().map(|l| l.name.clone()));
    if let Some(wanted) = wanted {
        let whole = layers.iter().position(|l| l.name == wanted);
        let by_prefix = || {
            let mut matching = (0..layers.len()).filter(|&i| layers[i].prefix == wanted);
            matching.next().filter(|_| matching.next().is_none())
        };
        // The plain picture beside others of many layers: a reference, say.
        let plain = || (layers.len() == 1 && layers[0].name == ROOT).then_some(0);
        return match whole.or_else(by_prefix).or_else(plain) {
            Some(index) => Ok(layers.swap_remove(index)),
            None => Err(ReadErrorKind::NoSuchLayer { wanted: wanted.to_owned(), layers: names }),
        };
    }
    if layers.len() > 1 {
        return Err(ReadErrorKind::SeveralLayers { layers: names });
    }
    Ok(layers.swap_remove(0))
}

fn colour_layers(part: usize, header: &Header) -> Vec<Layer> {
    let names: Vec<String> = header.channels.list.iter().map(|c| c.name.to_string()).collect();
    let split: Vec<(&str, &str)> =
        names.iter().map(|name| name.rsplit_once('.').unwrap_or(("", name))).collect();
    let mut prefixes: Vec<&str> = split.iter().map(|s| s.0).collect();
    // Channels stand in alphabetical order, which need not keep a layer's together.
    prefixes.sort_unstable();
    prefixes.dedup();
    let part_name = part_name(header);
    let find = |prefix: &str, names: [&str; 2]| {
        split.iter().position(|(p, channel)| {
            *p == prefix && names.iter().any(|name| channel.eq_ignore_ascii_case(name))
        })
    };
    prefixes
        .into_iter()
        .filter_map(|prefix| {
            let rgb = [["R", "red"], ["G", "green"], ["B", "blue"]].map(|name| find(prefix, name));
            let colour = if let [Some(r), Some(g), Some(b)] = rgb {
                vec![r, g, b]
            } else if rgb == [None; 3] && find(prefix, ["X", "X"]).is_none() {
                vec![find(prefix, ["Y", "Y"])?]
            } else {
                return None;
            };
            Some(Layer {
                name: layer_name(&part_name, prefix),
                prefix: prefix.to_owned(),
                part,
                colour,
                alpha: find(prefix, ["A", "alpha"]),
            })
        })
        .collect()
}

fn layer_name(part: &str, prefix: &str) -> String {
    match joined(part, prefix) {
        name if name.is_empty() => ROOT.to_owned(),
        name => name,
    }
}

/// The name of a part in front of a layer's or a channel's, which may begin with it already.
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

/// The name of a part, empty where it has none.
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
