//! Writes all values of all curves as one long, tidy table.

use fovqa_methods::curves::{Curve, CurveSource};
use fovqa_params::Words;
use fovqa_plan::CurvePlan;

const HEADER: [&str; 16] = [
    "curve",
    "model",
    "parameters",
    "width_px",
    "height_px",
    "gaze_x_px",
    "gaze_y_px",
    "direction_deg",
    "tangential",
    "eccentricity",
    "eccentricity_deg",
    "radial_cpd",
    "tangential_cpd",
    "display_radial_cpd",
    "display_tangential_cpd",
    "samples_per_pixel",
];

/// One row per eccentricity of each curve, in the order of the plan. The last column, `acuity_cpd`,
/// contains the plan's acuity. A cell is empty if its column does not apply.
pub fn curves_csv(plan: &CurvePlan, curves: &[Curve]) -> String {
    let acuity = plan.acuity.curve().ok();
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory does not fail, and all rows have the same length.
    let _ = writer.write_record(HEADER.into_iter().chain(["acuity_cpd"]));
    for curve in curves {
        let spec = &curve.spec;
        let (model, screen) = match &spec.source {
            CurveSource::Acuity(model) => (model.info().key, None),
            CurveSource::Method { method, setting } => (method.key(), Some(setting)),
        };
        let mut head = vec![spec.name.clone(), model.to_owned(), spec.parameters.clone()];
        head.extend(match screen {
            None => std::array::from_fn(|_| String::new()),
            Some(screen) => [
                screen.view.width.to_string(),
                screen.view.height.to_string(),
                format!("{:?}", screen.gaze_px[0]),
                format!("{:?}", screen.gaze_px[1]),
                format!("{:?}", screen.direction_deg),
                screen.tangential.word().to_owned(),
                screen.eccentricity.word().to_owned(),
            ],
        });
        for point in &curve.points {
            let [radial, across] = point.display_cpd.map_or([None; 2], |cpd| cpd.map(Some));
            let acuity = acuity.as_ref().map(|acuity| acuity.cutoff_cpd(point.eccentricity_deg));
            let values = [
                Some(point.eccentricity_deg),
                Some(point.radial_cpd),
                Some(point.tangential_cpd),
                radial,
                across,
                point.samples_per_pixel,
                acuity,
            ];
            let cells = values.map(|value| value.map(|v| format!("{v:?}")).unwrap_or_default());
            let _ = writer.write_record(head.iter().chain(&cells));
        }
    }
    String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}
