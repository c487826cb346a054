//! The curves that a plot or table of a curves file shows.

use fovqa_methods::curves::CurveSpec;
use fovqa_plan::CurvePlan;

/// The curves that a plot or table shows.
pub(super) fn shown<'a>(
    plan: &'a CurvePlan,
    wanted: Option<&'a [String]>,
) -> impl Iterator<Item = &'a CurveSpec> {
    let wanted = move |spec: &&CurveSpec| wanted.is_none_or(|wanted| wanted.contains(&spec.name));
    plan.curves.iter().filter(wanted)
}

/// Whether a plot or table has no curve because all of its curves are left out.
pub(super) fn nothing_is_left(plan: &CurvePlan, wanted: Option<&[String]>) -> bool {
    !plan.left_out.is_empty() && shown(plan, wanted).next().is_none()
}
