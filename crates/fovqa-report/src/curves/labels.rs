//! Labels for curves that are shown together. They name what differs between the curves.

use fovqa_methods::Method;
use fovqa_methods::curves::{Curve, CurveSetting, CurveSource};
use fovqa_plan::PanelOf;

/// The properties that distinguish the curves of a figure or table.
pub(super) struct Labels {
    /// The properties that are not the same for all curves.
    differ: Vec<PanelOf>,
}

/// The screen, if the curve is that of a method.
pub(super) fn screen(curve: &Curve) -> Option<&CurveSetting> {
    match &curve.spec.source {
        CurveSource::Acuity(_) => None,
        CurveSource::Method { setting, .. } => Some(setting),
    }
}

/// The name of a curve. It states if no paper defines the curve.
pub(super) fn name(curve: &Curve) -> String {
    let name = &curve.spec.name;
    match &curve.spec.source {
        CurveSource::Method { method: Method::VisualPolar(_), .. }
            if !name.to_lowercase().contains("reconstruct") =>
        {
            format!("{name} (reconstruction)")
        }
        _ => name.clone(),
    }
}

/// A resolution such as "2560 × 1440".
pub(super) fn resolution(screen: &CurveSetting) -> String {
    format!("{} × {}", screen.view.width, screen.view.height)
}

pub(super) fn gaze(screen: &CurveSetting) -> String {
    let [x, y] = screen.gaze_px;
    let off = [0, 1].map(|i| (screen.gaze_px[i] - screen.view.principal_px[i]).abs());
    if off[0] + off[1] < 1e-9 { "gaze at centre".to_owned() } else { format!("gaze ({x}, {y})") }
}

pub(super) fn direction(screen: &CurveSetting) -> String {
    format!("direction {}°", screen.direction_deg)
}

impl Labels {
    pub(super) fn of(curves: &[&Curve]) -> Self {
        let differ = |of: &dyn Fn(&Curve) -> Option<String>| {
            let mut found = curves.iter().filter_map(|curve| of(curve));
            found.next().is_some_and(|first| found.any(|other| other != first))
        };
        let found = [
            (PanelOf::Curve, differ(&|curve| Some(curve.spec.name.clone()))),
            (PanelOf::Resolution, differ(&|curve| screen(curve).map(resolution))),
            // The centres of two frames with different sizes count as the same gaze.
            (PanelOf::Gaze, differ(&|curve| screen(curve).map(gaze))),
            (PanelOf::Direction, differ(&|curve| screen(curve).map(direction))),
        ];
        Self { differ: found.into_iter().filter(|(_, differ)| *differ).map(|(of, _)| of).collect() }
    }

    /// The label of a curve, without the parts that are in the title of its panel. A curve that has
    /// its own panel is labelled with its name.
    pub(super) fn label(&self, curve: &Curve, panels: PanelOf) -> String {
        if panels == PanelOf::Curve {
            return name(curve);
        }
        let parts = self.parts(curve, |of| match panels {
            PanelOf::Setting => of == PanelOf::Curve,
            PanelOf::Name => of != PanelOf::Curve,
            panels => of != panels,
        });
        if parts.is_empty() { name(curve) } else { parts.join(", ") }
    }

    /// The name of a curve's row in a table that has a column for each resolution.
    pub(super) fn row(&self, curve: &Curve) -> String {
        let others = self.parts(curve, |of| !matches!(of, PanelOf::Curve | PanelOf::Resolution));
        std::iter::once(name(curve)).chain(others).collect::<Vec<_>>().join(", ")
    }

    /// The title of a curve's panel; empty if the curve has no panel of its own.
    pub(super) fn title(&self, curve: &Curve, panels: PanelOf) -> String {
        match panels {
            PanelOf::One => String::new(),
            PanelOf::Curve => {
                let mut parts = self.parts(curve, |_| true);
                if !self.differ.contains(&PanelOf::Curve) {
                    parts.insert(0, name(curve));
                }
                parts.join(", ")
            }
            PanelOf::Name => name(curve),
            PanelOf::Setting => self.parts(curve, |of| of != PanelOf::Curve).join(", "),
            panels => self.parts(curve, |of| of == panels).join(", "),
        }
    }

    fn parts(&self, curve: &Curve, wanted: impl Fn(PanelOf) -> bool) -> Vec<String> {
        let text = |of: PanelOf| match of {
            PanelOf::Curve => Some(name(curve)),
            PanelOf::Resolution => screen(curve).map(resolution),
            PanelOf::Gaze => screen(curve).map(gaze),
            PanelOf::Direction => screen(curve).map(direction),
            PanelOf::One | PanelOf::Setting | PanelOf::Name => None,
        };
        self.differ.iter().copied().filter(|of| wanted(*of)).filter_map(text).collect()
    }
}
