//! The channels of all parts by name.

use std::collections::HashMap;

use ::exr::meta::header::Header;

use super::layers::{joined, part_name};

/// A channel of a part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Channel {
    /// Index of the part.
    pub(crate) part: usize,
    /// Index among the channels of the part.
    pub(crate) index: usize,
    /// Its name, with part and layer in front.
    pub(crate) name: String,
    /// Whether it stands in no layer of its part.
    pub(crate) bare: bool,
}

/// All channels of a file.
#[derive(Debug)]
pub(crate) struct Channels {
    list: Vec<Channel>,
    /// Where a name, in lower case, is in the list.
    places: HashMap<String, usize>,
}

/// Channels of one layer that have the names looked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Match<'a> {
    /// What stands in front of these names, without the dot.
    pub(crate) lead: &'a str,
    /// The channels in the order of the names.
    pub(crate) channels: Vec<&'a Channel>,
}

impl Channels {
    pub(crate) fn of(headers: &[Header]) -> Self {
        let mut list = Vec::new();
        let mut places = HashMap::new();
        for (part, header) in headers.iter().enumerate() {
            let part_name = part_name(header);
            for (index, channel) in header.channels.list.iter().enumerate() {
                let own = channel.name.to_string();
                let name = joined(&part_name, &own);
                places.entry(name.to_ascii_lowercase()).or_insert(list.len());
                list.push(Channel { part, index, name, bare: !own.contains('.') });
            }
        }
        Self { list, places }
    }

    /// All names, in the order of the file.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|channel| channel.name.as_str())
    }

    /// The only channel.
    pub(crate) fn only(&self) -> Option<&Channel> {
        self.list.first().filter(|_| self.list.len() == 1)
    }

    /// The channel `name` of the layer `lead`.
    pub(crate) fn get(&self, lead: &str, name: &str) -> Option<&Channel> {
        let whole = if lead.is_empty() { name.to_owned() } else { format!("{lead}.{name}") };
        self.places.get(&whole.to_ascii_lowercase()).map(|&at| &self.list[at])
    }

    /// The layers that have all of these channels.
    pub(crate) fn matching<'a>(&'a self, names: &'a [String]) -> impl Iterator<Item = Match<'a>> {
        let (first, others) = names.split_first().unwrap_or_else(|| unreachable!("some names"));
        self.list.iter().filter_map(move |channel| {
            let lead = lead(&channel.name, first)?;
            let others = others.iter().map(|name| self.get(lead, name));
            let channels = std::iter::once(Some(channel)).chain(others).collect::<Option<_>>()?;
            Some(Match { lead, channels })
        })
    }
}

/// What stands in front of `name` in `whole`: nothing, or all up to a dot. `None` when it does not
/// end in this name.
fn lead<'a>(whole: &'a str, name: &str) -> Option<&'a str> {
    let at = whole.len().checked_sub(name.len())?;
    let (lead, last) = whole.split_at_checked(at)?;
    if !last.eq_ignore_ascii_case(name) {
        return None;
    }
    if lead.is_empty() { Some(lead) } else { lead.strip_suffix('.') }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_matched_from_a_dot_on_without_regard_to_case() {
        assert_eq!(lead("ViewLayer.Vector.X", "vector.x"), Some("ViewLayer"));
        assert_eq!(lead("vector.X", "Vector.X"), Some(""));
        assert_eq!(lead("MyVector.X", "Vector.X"), None);
        assert_eq!(lead("X", "Vector.X"), None);
        assert_eq!(lead("é.X", "é.X"), Some(""));
        assert_eq!(lead("é", "\u{28}"), None, "a name that ends within a letter");
    }
}
