//! Layers with R, G and B that do not hold colour: Cryptomatte IDs, and the motion and depth of
//! known renderers.

use ::exr::meta::attribute::AttributeValue;
use ::exr::meta::header::Header;

use crate::guides::GuidePreset;

/// The content of a layer that is not colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Data {
    /// IDs of objects and their coverage of a pixel. Such a layer is never read as a picture.
    Cryptomatte,
    /// Motion or depth, recognised by the name that a known renderer writes. It is read as a
    /// picture only if the user names it.
    Guide,
}

/// The names by which the data layers of a file are recognised.
#[derive(Debug)]
pub(crate) struct DataLayers {
    /// Names of Cryptomatte layers, without the two digits of the level.
    cryptomattes: Vec<String>,
    /// Names of layers with motion or depth.
    guides: Vec<String>,
}

impl DataLayers {
    /// Reads the attributes `cryptomatte/<id>/name` (Cryptomatte specification 1.2, section
    /// "Metadata").
    pub(crate) fn of(headers: &[Header]) -> Self {
        let attributes = headers.iter().flat_map(|header| {
            header.own_attributes.other.iter().chain(&header.shared_attributes.other)
        });
        let cryptomattes = attributes.filter_map(|(key, value)| {
            let key = key.to_string();
            let id = key.strip_prefix("cryptomatte/")?.strip_suffix("/name")?;
            match value {
                AttributeValue::Text(name) if !id.is_empty() => Some(name.to_string()),
                _ => None,
            }
        });
        let mut cryptomattes: Vec<String> = cryptomattes.filter(|name| !name.is_empty()).collect();
        // Each part of a file repeats these attributes.
        cryptomattes.sort_unstable();
        cryptomattes.dedup();
        Self { cryptomattes, guides: GuidePreset::layers() }
    }

    /// The content of a layer if it is not colour. `name` has no view in it.
    pub(crate) fn data(&self, name: &str) -> Option<Data> {
        let last = name.rsplit('.').next().unwrap_or_default();
        if self.is_cryptomatte(name) || is_usual(last) {
            Some(Data::Cryptomatte)
        } else if self.guides.iter().any(|guide| guide.eq_ignore_ascii_case(last)) {
            Some(Data::Guide)
        } else {
            None
        }
    }

    /// Whether a layer belongs to Cryptomatte. Such layers are `<name>00`, `<name>01` and so on; a
    /// preview may be called `<name>`.
    fn is_cryptomatte(&self, layer: &str) -> bool {
        let level = level_of(layer);
        self.cryptomattes.iter().any(|name| {
            level == Some(name)
                || layer == name
                // The name may have a layer or part in front, or the prefix that Unreal writes.
                || level.is_some_and(|level| level.ends_with(name.as_str()))
                || layer.strip_suffix(name.as_str()).is_some_and(|rest| rest.ends_with('.'))
        })
    }
}

/// A layer name without the two digits of a Cryptomatte level at its end.
fn level_of(layer: &str) -> Option<&str> {
    let at = layer.len().checked_sub(2)?;
    let (name, digits) = layer.split_at_checked(at)?;
    digits.bytes().all(|digit| digit.is_ascii_digit()).then_some(name)
}

/// Whether a layer has a usual name of a Cryptomatte level, for files that have lost their
/// attributes: `CryptoObject00`, `crypto_material01`, `uCryptoAsset02`, `Cryptomatte00`.
fn is_usual(last: &str) -> bool {
    let Some(name) = level_of(last).map(str::to_ascii_lowercase) else { return false };
    let name = name.strip_prefix('u').unwrap_or(&name);
    let kind = name.strip_prefix("crypto");
    kind.is_some_and(|kind| kind.bytes().all(|byte| byte.is_ascii_alphabetic() || byte == b'_'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cryptomattes_are_known_by_the_header_or_by_their_usual_names() {
        let names = ["ViewLayer.Things", "ActorHitProxyMask"].map(str::to_owned).to_vec();
        let layers = DataLayers { cryptomattes: names, guides: GuidePreset::layers() };
        for layer in [
            "ViewLayer.Things00",
            "ViewLayer.Things12",
            "ViewLayer.Things",
            "part.ViewLayer.Things01",
            "FinalImageActorHitProxyMask00",
            "ViewLayer.CryptoObject00",
            "crypto_material01",
            "uCryptoAsset02",
            "cryptomatte00",
        ] {
            assert_eq!(layers.data(layer), Some(Data::Cryptomatte), "{layer}");
        }
        for layer in ["mvec", "a.FinalImageMovieRenderQueue_MotionVectors", "dd"] {
            assert_eq!(layers.data(layer), Some(Data::Guide), "{layer}");
        }
        for layer in ["", "00", "ViewLayer.Combined", "take00", "encrypted00", "cryptomatte", "é0"]
        {
            assert_eq!(layers.data(layer), None, "{layer}");
        }
    }
}
