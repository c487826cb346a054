//! The parameters of an [`EmulationSpec`]: which ones can be set, and which ones apply.

use fovqa_params::{ParamInfo, ParamValue};

use crate::filters::FilterChoice;
use crate::sandbox_params::ENHANCE;
use crate::spec::EmulationSpec;
use crate::temporal::TaaParams;

impl EmulationSpec {
    /// All parameters that can be set by name, whether they apply or not: the method's own, `filter.X`
    /// of its filters, `taa.X` of the temporal filter, `enhance.X` of enhancement.
    pub fn settable(&self) -> Vec<(String, &'static ParamInfo)> {
        let groups = [
            ("", self.info().params),
            ("filter.", self.method.filters().params),
            ("taa.", TaaParams::INFO),
            ("enhance.", ENHANCE),
        ];
        let named = |(group, infos): (&'static str, &'static [ParamInfo])| {
            infos.iter().map(move |info| (format!("{group}{}", info.name), info))
        };
        groups.into_iter().flat_map(named).collect()
    }

    /// The parameters that apply, by their names, with the values they have: the method's own, those of
    /// its filters that are on, of the temporal filter and of enhancement where they are on. A parameter
    /// that a budget solves has the value it had before.
    pub fn parameters(&self) -> Vec<(String, ParamValue)> {
        let filtered = self.filters != FilterChoice::None;
        let mut lists = vec![("", self.info().params)];
        lists.extend(filtered.then_some(("filter.", self.method.filters().params)));
        lists.extend(self.temporal.then_some(("taa.", TaaParams::INFO)));
        lists.extend(self.enhance.map(|_| ("enhance.", ENHANCE)));
        let named = lists.into_iter().flat_map(|(group, infos)| {
            infos.iter().map(move |info| (format!("{group}{}", info.name), info.default_value()))
        });
        named
            .map(|(name, default)| {
                let value = self.set_by_name().get(&name).cloned().or_else(|| self.followed(&name));
                let value = value.unwrap_or(default);
                (name, value)
            })
            .collect()
    }

    /// Parameters of enhancement that follow those of coarse pixel shading.
    fn followed(&self, name: &str) -> Option<ParamValue> {
        match name {
            "enhance.foveal_deg" => Some(ParamValue::Number(self.enhancement.foveal_deg)),
            "enhance.transition_deg" => Some(ParamValue::Number(self.enhancement.transition_deg)),
            _ => None,
        }
    }
}
