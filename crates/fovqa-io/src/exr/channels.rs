//! The channels of all parts of a file, found by name.

use std::collections::{BTreeSet, HashMap};

use ::exr::meta::header::Header;

use super::layers::{joined, part_name};
use super::views::Views;

/// A channel of a part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Channel {
    /// Index of the part.
    pub(crate) part: usize,
    /// Index among the channels of the part.
    pub(crate) index: usize,
    /// Its full name, with part and layer in front.
    pub(crate) name: String,
    /// Its full name without the view.
    plain: String,
    /// Its name within the part, without the view.
    pub(crate) own: String,
    /// The view it belongs to, in lower case.
    pub(crate) view: Option<String>,
    /// Whether it belongs to no layer of its part.
    pub(crate) bare: bool,
}

/// The form of a channel's name that is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum NameForm {
    /// The full name as it is in the file.
    Name,
    /// The full name without the view; only channels of the same view are compared.
    Plain,
}

/// All channels of a file.
#[derive(Debug)]
pub(crate) struct Channels {
    list: Vec<Channel>,
    /// The index in the list for each name in lower case. For [`NameForm::Plain`] the view is part of the
    /// key.
    places: HashMap<(NameForm, Option<String>, String), usize>,
}

/// The channels of one layer that have the names looked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Match<'a> {
    /// The prefix in front of these names, without the last dot.
    pub(crate) lead: &'a str,
    /// The form of the names that matches.
    pub(crate) by: NameForm,
    /// The channels in the order of the names.
    pub(crate) channels: Vec<&'a Channel>,
}

impl Match<'_> {
    /// The view of the channels.
    pub(crate) fn view(&self) -> Option<&str> {
        self.channels[0].view.as_deref()
    }
}

impl Channels {
    pub(crate) fn of(headers: &[Header], views: &Views) -> Self {
        let mut list = Vec::new();
        let mut places = HashMap::new();
        for (part, header) in headers.iter().enumerate() {
            let part_name = part_name(header);
            for (index, channel) in header.channels.list.iter().enumerate() {
                let own = channel.name.to_string();
                let (prefix, last) = own.rsplit_once('.').unwrap_or(("", &own));
                let name = joined(&part_name, &own);
                let layer = joined(&part_name, prefix);
                let view = views.of_layer(header, prefix, &layer);
                let layer = views.without(&layer);
                let plain =
                    if layer.is_empty() { last.to_owned() } else { format!("{layer}.{last}") };
                let keys = [
                    (NameForm::Name, None, name.to_ascii_lowercase()),
                    (NameForm::Plain, view.clone(), plain.to_ascii_lowercase()),
                ];
                for key in keys {
                    places.entry(key).or_insert(list.len());
                }
                let prefix = views.without(prefix);
                let bare = prefix.is_empty();
                let own = if bare { last.to_owned() } else { format!("{prefix}.{last}") };
                list.push(Channel { part, index, name, plain, own, view, bare });
            }
        }
        Self { list, places }
    }

    /// All names, in the order of the file.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|channel| channel.name.as_str())
    }

    /// The views that channels belong to.
    pub(crate) fn views(&self) -> BTreeSet<&str> {
        self.list.iter().filter_map(|channel| channel.view.as_deref()).collect()
    }

    /// The only channel, if there is exactly one.
    pub(crate) fn only(&self) -> Option<&Channel> {
        self.list.first().filter(|_| self.list.len() == 1)
    }

    /// The channel `name` in the layer of a match.
    pub(crate) fn beside(&self, found: &Match<'_>, name: &str) -> Option<&Channel> {
        self.get(found.by, found.channels[0].view.as_ref(), found.lead, name)
    }

    /// The channel `name` of the layer `lead`, by the given form of its name. The view counts only
    /// for [`NameForm::Plain`].
    fn get(&self, by: NameForm, view: Option<&String>, lead: &str, name: &str) -> Option<&Channel> {
        let whole = if lead.is_empty() { name.to_owned() } else { format!("{lead}.{name}") };
        let view = view.filter(|_| by == NameForm::Plain).cloned();
        self.places.get(&(by, view, whole.to_ascii_lowercase())).map(|&at| &self.list[at])
    }

    /// The layers that have all of these channels. Names are compared as they are in the file;
    /// where they do not match, they are compared without the views.
    pub(crate) fn matching<'a>(&'a self, names: &'a [String]) -> impl Iterator<Item = Match<'a>> {
        let (first, others) = names.split_first().unwrap_or_else(|| unreachable!("some names"));
        self.list.iter().filter_map(move |channel| {
            let by = |by, name| {
                let lead = lead(name, first)?;
                let of = |name: &String| self.get(by, channel.view.as_ref(), lead, name);
                let all = std::iter::once(Some(channel)).chain(others.iter().map(of));
                Some(Match { lead, by, channels: all.collect::<Option<_>>()? })
            };
            by(NameForm::Name, &channel.name).or_else(|| by(NameForm::Plain, &channel.plain))
        })
    }
}

/// The part of `whole` in front of `name`: nothing, or everything up to a dot. `None` if `whole`
/// does not end in `name`.
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
