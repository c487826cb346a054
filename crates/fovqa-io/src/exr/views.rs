//! Finds the view (eye or camera) of a channel.
//!
//! There are three conventions, tried in this order: the `view` attribute of a part; in a part with
//! a `multiView` attribute, the name component before the channel's own, where channels without a
//! layer belong to the first view (OpenEXR, "Storing Multi-View Images in OpenEXR Files"); or else
//! a component of the name that is a view's name, or ends in `-` and a view's name, as Blender
//! names its parts (`ViewLayer.Combined-right`). `left` and `right` are known as views in every
//! file.

use ::exr::meta::header::Header;

/// The names that OpenEXR reserves for the two eyes.
const EYES: [&str; 2] = ["left", "right"];

/// The names of the views of a file.
#[derive(Debug)]
pub(crate) struct Views {
    names: Vec<String>,
}

impl Views {
    pub(crate) fn of(headers: &[Header]) -> Self {
        let mut names = EYES.map(str::to_owned).to_vec();
        for own in headers.iter().map(|header| &header.own_attributes) {
            let listed = own.multi_view_names.iter().flatten();
            for name in own.view_name.iter().chain(listed).map(ToString::to_string) {
                let known = |known: &String| known.eq_ignore_ascii_case(&name);
                if !name.is_empty() && !names.iter().any(known) {
                    names.push(name);
                }
            }
        }
        Self { names }
    }

    /// The view of a channel or layer of a part, in lower case. `prefix` is the text in front of
    /// the channel's own name; `full` is the prefix with the name of the part in front.
    pub(crate) fn of_layer(&self, header: &Header, prefix: &str, full: &str) -> Option<String> {
        let own = &header.own_attributes;
        let part = own.view_name.as_ref().map(ToString::to_string);
        if let Some(view) = part.filter(|view| !view.is_empty()) {
            return Some(view.to_ascii_lowercase());
        }
        let listed = own.multi_view_names.iter().flatten().next();
        if let Some(first) = listed.filter(|_| prefix.is_empty()) {
            return Some(first.to_string().to_ascii_lowercase());
        }
        self.in_name(full)
    }

    /// The view that a name contains, in lower case.
    pub(crate) fn in_name(&self, name: &str) -> Option<String> {
        let told = |part: &str| self.names.iter().find(|view| split(part, view).is_some());
        name.rsplit('.').find_map(told).map(|view| view.to_ascii_lowercase())
    }

    /// A name without its view: `ViewLayer.Vector.right.X` and `ViewLayer.Vector-right.X` become
    /// `ViewLayer.Vector.X`.
    pub(crate) fn without(&self, name: &str) -> String {
        let rest = |part| self.names.iter().find_map(|view| split(part, view)).unwrap_or(part);
        let parts: Vec<&str> = name.split('.').map(rest).filter(|part| !part.is_empty()).collect();
        parts.join(".")
    }
}

/// The rest of a name component without the name of a view; `None` if the component does not
/// contain this view.
fn split<'a>(component: &'a str, view: &str) -> Option<&'a str> {
    let at = component.len().checked_sub(view.len())?;
    let (rest, last) = component.split_at_checked(at)?;
    if !last.eq_ignore_ascii_case(view) {
        return None;
    }
    if rest.is_empty() { Some(rest) } else { rest.strip_suffix('-') }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_is_a_component_or_follows_a_hyphen() {
        let views = Views { names: vec!["left".into(), "right".into(), "cam2".into()] };
        let told = |name: &str| (views.in_name(name), views.without(name));
        for (name, view, without) in [
            (
                "ViewLayer.Combined-right.ViewLayer.Combined",
                "right",
                "ViewLayer.Combined.ViewLayer.Combined",
            ),
            ("ViewLayer.Vector.left.X", "left", "ViewLayer.Vector.X"),
            ("RIGHT", "right", ""),
            ("Cam2.Z", "cam2", "Z"),
        ] {
            assert_eq!(told(name), (Some(view.to_owned()), without.to_owned()));
        }
        for name in ["bright", "ViewLayer.Combined", "light_left.R", "é.copyright", ""] {
            assert_eq!(told(name), (None, name.to_owned()));
        }
    }
}
