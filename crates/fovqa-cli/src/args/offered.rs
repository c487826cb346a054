//! Names that shells offer for an option: those of the registries. The option can accept further values.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, TypedValueParser};
use fovqa_emulate::EmulationSpec;
use fovqa_io::GuidePreset;
use fovqa_methods::Method;
use fovqa_metrics::Metric;
use fovqa_params::Words;
use fovqa_vision::acuity::AcuityModel;
use fovqa_vision::displays;

/// A parser together with the names that shells offer. It accepts and refuses what the parser does.
#[derive(Debug, Clone)]
pub(super) struct Offering<P> {
    parser: P,
    names: fn() -> Vec<PossibleValue>,
}

/// A parser that lets shells offer these names.
pub(super) fn offering<P: TypedValueParser>(
    parser: P,
    names: fn() -> Vec<PossibleValue>,
) -> Offering<P> {
    Offering { parser, names }
}

impl<P: TypedValueParser> TypedValueParser for Offering<P> {
    type Value = P::Value;

    fn parse_ref(
        &self,
        command: &clap::Command,
        option: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<Self::Value, clap::Error> {
        self.parser.parse_ref(command, option, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.names)().into_iter()))
    }
}

/// A name as options write it, with what it means.
fn named(key: &str, about: &str) -> PossibleValue {
    PossibleValue::new(key.replace('_', "-")).help(about.to_owned())
}

/// All metrics.
pub(super) fn metrics() -> Vec<PossibleValue> {
    Metric::ALL.iter().map(|metric| named(metric.info().key, metric.info().label)).collect()
}

/// All metrics as tables of results write them.
pub(super) fn metric_keys() -> Vec<PossibleValue> {
    let name = |metric: &Metric| {
        let info = metric.info();
        PossibleValue::new(info.key).help(info.label)
    };
    Metric::ALL.iter().map(name).collect()
}

/// All display presets.
pub(super) fn display_names() -> Vec<PossibleValue> {
    let name = |display: &fovqa_vision::Display| named(&display.name, &display.geometry_in_words());
    displays().iter().map(name).collect()
}

/// The display presets with a known photometry.
pub(super) fn luminances() -> Vec<PossibleValue> {
    let name = |display: &fovqa_vision::Display| {
        let peak = display.luminance?.peak_cd_m2;
        Some(named(&display.name, &format!("{peak} cd/m²")))
    };
    displays().iter().filter_map(name).collect()
}

/// The foveation methods with curves.
pub(super) fn methods() -> Vec<PossibleValue> {
    Method::all().iter().map(|method| named(method.info().key, method.info().label)).collect()
}

/// The methods that can be emulated.
pub(super) fn emulated_methods() -> Vec<PossibleValue> {
    EmulationSpec::methods().iter().map(|info| named(info.key, info.label)).collect()
}

/// The acuity models.
pub(super) fn acuity_models() -> Vec<PossibleValue> {
    AcuityModel::all().iter().map(|model| named(model.info().key, model.info().label)).collect()
}

/// The sources of motion and depth.
pub(super) fn guides() -> Vec<PossibleValue> {
    let usual = [("auto", "What the file names"), ("none", "Nothing")];
    let usual = usual.map(|(word, about)| named(word, about));
    let renderers = GuidePreset::all().into_iter();
    usual.into_iter().chain(renderers.map(|of| named(of.word(), of.about()))).collect()
}
