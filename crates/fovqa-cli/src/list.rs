//! `fovqa list`: lists the available names.

use std::fmt::Write as _;

use fovqa_emulate::{EmulationSpec, FilterChoice};
use fovqa_methods::Method;
use fovqa_metrics::{Better, Metric, MetricKind};
use fovqa_params::{ParamInfo, Words};
use fovqa_report::{Text, TextTable};
use fovqa_vision::acuity::AcuityModel;
use fovqa_vision::displays;

use crate::args::Listed;
use crate::exit::Exit;
use crate::output;

pub(crate) fn run(what: Listed) -> Exit {
    let text = match what {
        Listed::Metrics => metrics().into(),
        Listed::Methods => methods().into(),
        Listed::Displays => display_presets(),
    };
    output::text(&text)
}

fn metrics() -> String {
    let mut text = String::new();
    for metric in Metric::ALL {
        let info = metric.info();
        let unit = if info.unit.is_empty() { String::new() } else { format!(", {}", info.unit) };
        let better = match info.better {
            Better::Higher => "higher is better",
            Better::Lower => "lower is better",
            Better::Neither => "neither higher nor lower is better",
        };
        let default = match (Metric::DEFAULT.contains(&metric), info.kind) {
            (false, _) => "",
            (true, MetricKind::Temporal) => ", by default for sequences",
            (true, _) => ", by default",
        };
        let bands = match (info.per_band, info.kind) {
            (false, _) => "",
            (true, MetricKind::Profile) => ", per band",
            (true, _) => ", also per band",
        };
        let view = if info.needs.view { ", needs a view" } else { "" };
        let _ = writeln!(text, "{} ({}{unit})", info.key, info.label);
        let _ = writeln!(text, "    {}", info.about);
        let light = if info.needs.luminance { ", needs the display's photometry" } else { "" };
        let _ = writeln!(text, "    {better}{bands}{view}{light}{default}");
        for map in info.maps() {
            let _ = writeln!(text, "    --maps: {}", map.about);
        }
        let _ = writeln!(text, "    source: {}", info.source);
        parameters(&mut text, &format!("{}.", info.key), info.params);
    }
    ended(text)
}

fn methods() -> String {
    let mut text = String::from("Foveation methods, `--method NAME`\n\n");
    let of_curves = Method::all().map(|method| method.key());
    for method in Method::all() {
        let info = method.info();
        entry(&mut text, info.key, info.label, info.about, info.source);
        parameters(&mut text, "", info.params);
    }
    text.push_str("Further methods of `fovqa foveate`, `--method NAME`\n\n");
    for info in EmulationSpec::methods().into_iter().filter(|info| !of_curves.contains(&info.key)) {
        entry(&mut text, info.key, info.label, info.about, info.source);
        parameters(&mut text, "", info.params);
    }
    text.push_str(&around_methods());
    text.push_str("Acuity models, `--acuity NAME`\n\n");
    for model in AcuityModel::all() {
        let info = model.info();
        entry(&mut text, info.key, info.label, info.about, info.source);
        parameters(&mut text, "", info.params);
    }
    ended(text)
}

/// What `fovqa foveate` can do beside the methods: filters and enhancement, with their parameters.
fn around_methods() -> String {
    let mut text = String::from("Filters and enhancement of `fovqa foveate`\n\n");
    let specs = EmulationSpec::methods().into_iter().map(|info| EmulationSpec::new(info.key));
    let specs: Vec<EmulationSpec> = specs.filter_map(Result::ok).collect();
    let group = |spec: &EmulationSpec, group: &str| -> Vec<(String, &'static ParamInfo)> {
        let settable = spec.settable().into_iter();
        settable.filter(|(name, _)| name.starts_with(group)).collect()
    };
    for spec in &specs {
        let filter = group(spec, "filter.");
        if !filter.is_empty() {
            let method = spec.key().replace('_', "-");
            let has = |choice: &FilterChoice| spec.clone().set_filters(*choice).is_ok();
            let choices = FilterChoice::all().into_iter().filter(has);
            let words: Vec<&str> = choices.map(FilterChoice::word).collect();
            let _ = writeln!(text, "{method} --filter {}", words.join("|"));
            named_parameters(&mut text, &filter);
        }
    }
    for (option, prefix, about) in [
        ("--temporal", "taa.", "the temporal filter, after any method"),
        ("--enhance F_MAX", "enhance.", "contrast enhancement of the periphery, after any method"),
    ] {
        let _ = writeln!(text, "{option}\n    {about}");
        named_parameters(
            &mut text,
            &specs.first().map(|spec| group(spec, prefix)).unwrap_or_default(),
        );
    }
    text
}

fn entry(text: &mut String, key: &str, label: &str, about: &str, source: &str) {
    let _ = writeln!(text, "{} ({label})", key.replace('_', "-"));
    let _ = writeln!(text, "    {about}");
    let _ = writeln!(text, "    source: {source}");
}

fn parameters(text: &mut String, owner: &str, params: &'static [ParamInfo]) {
    let named = |param: &'static ParamInfo| (format!("{owner}{}", param.name), param);
    named_parameters(text, &params.iter().map(named).collect::<Vec<_>>());
}

fn named_parameters(text: &mut String, params: &[(String, &'static ParamInfo)]) {
    for (name, param) in params {
        let ParamInfo { default, about, values, .. } = param;
        let _ = writeln!(text, "      --set {name}={default}  {about}; {values}");
    }
    text.push('\n');
}

fn ended(mut text: String) -> String {
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn display_presets() -> Text {
    let mut table =
        TextTable::new(["display", "pixels", "field or size", "px/°", "cd/m²", "source"]);
    for display in displays() {
        let [w, h] = display.resolution;
        table.add_row([
            display.name.replace('_', "-"),
            format!("{w}x{h}"),
            display.geometry_in_words(),
            format!("{:.2}", display.central_pixels_per_degree()),
            display.luminance.map(|l| l.peak_cd_m2.to_string()).unwrap_or_default(),
            display.source.clone(),
        ]);
    }
    let mut text = Text::default();
    text.push_table(table.with_text_in(&[1, 2, 5]));
    text
}
