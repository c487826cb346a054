//! `fovqa curves`.

use std::path::PathBuf;

use clap::{ArgGroup, Args, ValueEnum};
use fovqa_config::resolution as parse_resolution;
use fovqa_methods::curves::{CurveBudget, CurveRange, CurveSetting, CurveSource, CurveSpec};
use fovqa_methods::{BudgetSamples, Method};
use fovqa_params::{ParamValue, Words};
use fovqa_vision::acuity::AcuityModel;
use fovqa_vision::{EccentricityKind, Tangential, ViewSpec};

use super::lock::LockArgs;
use super::no_such::no_such;
use super::offered::{self, offering};
use super::values::{finite, literal, numbers, words};
use super::view::{FAR, ViewSpecArgs, near};
use crate::diagnostic;

pub(crate) const EXAMPLES: &str = "\
Examples:
  fovqa curves --method kfr --set sigma=1.8 --resolution 2560x1440 --fov-vertical 110
  fovqa curves --method rmfr --direction 90 --budget 0.15 --display vive-pro-eye
  fovqa curves --acuity piecewise --set cap_cpd=9
  fovqa curves configs/curves/acuity.toml        figures and tables, in reports/acuity

A single method or acuity model is printed as CSV: eccentricity_deg,radial_cpd,tangential_cpd.
A row whose rate is undefined (KFR, LaFR within a pixel of the gaze) is left out. The rows of RMFR
and DEAMP end at the border of the frame. docs/curves.md shows every key of a curve file, and
`fovqa schema curves` prints its JSON Schema.

Exit codes: 0 done; 2 the command line or the file is wrong; 3 the output cannot be written; 70 a
bug in fovqa; 130 interrupted.";

/// How curves are printed.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum CurvesFormat {
    /// One row per eccentricity.
    Csv,
}

/// Options that a curve file replaces.
const IN_FILE: [&str; 17] = [
    "set",
    "budget",
    "budget_of",
    "resolution",
    "fov_vertical",
    "fov_horizontal",
    "fov_diagonal",
    "frustum",
    "display",
    "distance_m",
    "pixel_pitch_mm",
    "gaze",
    "direction",
    "tangential",
    "eccentricity",
    "step",
    "to",
];

#[derive(Debug, Args)]
#[command(group = ArgGroup::new("what").required(true).args(["curves", "method", "acuity"]))]
pub(crate) struct CurvesArgs {
    /// Curve files; the figures and tables of each are written to a separate folder
    #[arg(value_name = "CURVES.toml", conflicts_with_all = IN_FILE)]
    pub(crate) curves: Vec<PathBuf>,
    /// A foveation method; `fovqa list methods` shows them
    #[arg(long, value_name = "NAME", value_parser = offering(method, offered::methods), hide_possible_values = true)]
    method: Option<Method>,
    /// An acuity model: piecewise, linear-mar, geisler-perry
    #[arg(long, value_name = "NAME", value_parser = offering(acuity, offered::acuity_models), hide_possible_values = true)]
    acuity: Option<AcuityModel>,
    /// A parameter of the method or model, such as sigma=1.8
    #[arg(long = "set", value_name = "PARAM=VALUE", value_parser = assignment)]
    set: Vec<(String, ParamValue)>,
    /// Set the method's free parameter so that the samples are this share of the frame's pixels,
    /// such as 0.15
    #[arg(long, value_name = "SHARE", value_parser = finite, requires = "method")]
    budget: Option<f64>,
    /// Which samples the budget counts
    #[arg(long, value_name = "WHICH", default_value = BudgetSamples::default().word(), value_parser = words::<BudgetSamples>(), requires = "budget")]
    budget_of: BudgetSamples,
    /// Size of the frame [default: that of --display]
    #[arg(long, value_name = "WxH", value_parser = resolution)]
    resolution: Option<[usize; 2]>,
    #[command(flatten)]
    view: ViewSpecArgs,
    /// Gaze in pixels from the top-left corner [default: the principal point]
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = "View", value_parser = gaze)]
    gaze: Option<[f64; 2]>,
    /// Direction of the curve from the gaze, degrees from +x towards +y (0: right, 90: down)
    #[arg(long, value_name = "DEG", default_value = "0", value_parser = finite, allow_negative_numbers = true)]
    direction: f64,
    /// How a degree across the curve is defined
    #[arg(long, value_name = "KIND", default_value = Tangential::default().word(), value_parser = words::<Tangential>())]
    tangential: Tangential,
    /// How eccentricity is measured
    #[arg(long, value_name = "KIND", default_value = EccentricityKind::Planar.word(), value_parser = words::<EccentricityKind>())]
    eccentricity: EccentricityKind,
    /// Step between eccentricities, degrees
    #[arg(long, value_name = "DEG", default_value = "0.25", value_parser = step)]
    step: f64,
    /// Last eccentricity, degrees, for methods whose curves do not end at the border of the frame
    #[arg(long, value_name = "DEG", default_value = "60", value_parser = to)]
    to: f64,
    /// How a curve is printed
    #[arg(long, value_name = "FORMAT", default_value = "csv")]
    format: CurvesFormat,
    /// Folder for the figures and tables. With one file, they are written directly to this folder;
    /// with several, each file gets a subfolder [default: reports/NAME, with the name in the file]
    #[arg(long, value_name = "DIR", conflicts_with_all = ["method", "acuity"])]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}

fn gaze(text: &str) -> Result<[f64; 2], String> {
    let point = numbers::<2>(text, "X,Y in pixels")?;
    near(point).then_some(point).ok_or_else(|| FAR.to_owned())
}

fn method(name: &str) -> Result<Method, String> {
    Method::find(name).ok_or_else(|| {
        no_such("method", name, &Method::all().map(|method| method.key().replace('_', "-")))
    })
}

fn acuity(name: &str) -> Result<AcuityModel, String> {
    AcuityModel::find(name).ok_or_else(|| {
        let names = AcuityModel::all().map(|model| model.info().key.replace('_', "-"));
        no_such("acuity model", name, &names)
    })
}

fn assignment(text: &str) -> Result<(String, ParamValue), String> {
    let (name, value) = text.split_once('=').ok_or_else(|| "write PARAM=VALUE".to_owned())?;
    Ok((name.trim().to_owned(), literal(value.trim())?))
}

pub(super) fn resolution(text: &str) -> Result<[usize; 2], String> {
    parse_resolution(text).ok_or_else(|| {
        "write WIDTHxHEIGHT in pixels, each from 1 to 100000, such as 2560x1440".to_owned()
    })
}

fn step(text: &str) -> Result<f64, String> {
    let least = CurveRange::LEAST_STEP_DEG;
    finite(text)
        .ok()
        .filter(|step| (least..=60.0).contains(step))
        .ok_or_else(|| format!("write degrees from {least} to 60"))
}

fn to(text: &str) -> Result<f64, String> {
    let most = CurveRange::MOST_DEG;
    finite(text)
        .ok()
        .filter(|to| *to > 0.0 && *to <= most)
        .ok_or_else(|| format!("write degrees above 0 and at most {most}"))
}

impl CurvesArgs {
    /// The curve of the flags.
    pub(crate) fn spec(&self) -> Result<CurveSpec, String> {
        let parameters: Vec<String> =
            self.set.iter().map(|(name, value)| format!("{name}={}", value.in_words())).collect();
        let parameters = parameters.join(";");
        if let Some(mut model) = self.acuity.clone() {
            if self.budget.is_some() {
                return Err("--budget needs --method: an acuity model has no samples".to_owned());
            }
            for (name, value) in &self.set {
                model.set(name, value).map_err(|error| error.to_string())?;
            }
            model.curve().map_err(|error| error.to_string())?;
            // The value is not used here, but a mistake in it is still reported.
            if let Some(view) = self.view.spec()? {
                view.check().map_err(|error| error.to_string())?;
            }
            let name = model.info().label.to_owned();
            return Ok(CurveSpec { name, source: CurveSource::Acuity(model), parameters });
        }
        let Some(mut method) = self.method.clone() else {
            return Err("give a method or an acuity model".to_owned());
        };
        for (name, value) in &self.set {
            method.set(name, value).map_err(|error| error.to_string())?;
        }
        let budget = self.budget.map(|share| CurveBudget { share, samples: self.budget_of });
        let name = method.info().label.to_owned();
        CurveSpec::of_method(name, method, parameters, self.setting()?, budget)
            .map_err(|error| error.to_string())
    }

    fn setting(&self) -> Result<CurveSetting, String> {
        let no_view = "a method needs a view: give one, such as --fov-vertical 110 or --display";
        let spec = self.view.spec()?.ok_or(no_view)?;
        let [width, height] = match (self.resolution, &spec) {
            (Some(size), _) => size,
            (None, ViewSpec::Display(display)) => display.resolution,
            (None, _) => {
                return Err(
                    "a method needs the size of the frame: give it, such as --resolution 2560x1440"
                        .to_owned(),
                );
            }
        };
        let view = spec.resolve(width, height).map_err(|error| error.to_string())?.view;
        for doubt in spec.doubts(&view) {
            diagnostic::warning(&doubt);
        }
        let gaze_px = self.gaze.unwrap_or(view.principal_px);
        Ok(CurveSetting {
            view,
            gaze_px,
            direction_deg: self.direction,
            tangential: self.tangential,
            eccentricity: self.eccentricity,
        })
    }

    /// Whether a parameter is solved.
    pub(crate) fn has_budget(&self) -> bool {
        self.budget.is_some()
    }

    /// The eccentricities of the flags.
    pub(crate) fn range(&self) -> CurveRange {
        CurveRange { step_deg: self.step, to_deg: self.to }
    }
}
