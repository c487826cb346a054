//! An acuity curve that is ready to compute with: its minimum angle of resolution is piecewise
//! linear.

/// Acuity over eccentricity. `1/f` is piecewise linear and keeps its last slope beyond the last
/// knot.
#[derive(Debug, Clone, PartialEq)]
pub struct AcuityCurve {
    /// Never empty; the first begins at 0°.
    segments: Vec<Segment>,
}

/// A linear piece of the minimum angle of resolution.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Segment {
    from_deg: f64,
    /// `1/f` at the start of the segment, in degrees per cycle.
    mar_deg: f64,
    /// Slope in degrees per cycle, per degree of eccentricity.
    slope: f64,
    /// `∫ 2f de` from 0° to the start of the segment.
    samples_before: f64,
}

impl AcuityCurve {
    /// A curve through knots `(eccentricity, minimum angle of resolution)`, both in degrees.
    /// Eccentricities rise from 0° and angles are positive. Beyond the last knot the slope is
    /// `last_slope`.
    pub(crate) fn through(knots: &[(f64, f64)], last_slope: f64) -> Self {
        let mut segments: Vec<Segment> = Vec::with_capacity(knots.len());
        for (i, &(from_deg, mar_deg)) in knots.iter().enumerate() {
            let slope = knots
                .get(i + 1)
                .map_or(last_slope, |next| (next.1 - mar_deg) / (next.0 - from_deg));
            let samples_before = segments.last().map_or(0.0, |last| last.samples_to(from_deg));
            segments.push(Segment { from_deg, mar_deg, slope, samples_before });
        }
        Self { segments }
    }

    /// The curve limited to a frequency, such as the highest that a device shows: `min(f, cap)`.
    /// The point where the two cross becomes a knot.
    #[must_use]
    pub fn capped(&self, cap_cpd: f64) -> Self {
        let least = 1.0 / cap_cpd;
        let mut knots: Vec<(f64, f64)> = Vec::new();
        for (i, segment) in self.segments.iter().enumerate() {
            knots.push((segment.from_deg, segment.mar_deg.max(least)));
            let end_deg = self.segments.get(i + 1).map_or(f64::INFINITY, |next| next.from_deg);
            let crossing_deg = segment.from_deg + (least - segment.mar_deg) / segment.slope;
            if crossing_deg > segment.from_deg && crossing_deg < end_deg {
                knots.push((crossing_deg, least));
            }
        }
        // Along the last segment the frequency falls or is constant, so the cap either ends on it
        // or holds for all larger eccentricities.
        Self::through(&knots, self.segments[self.segments.len() - 1].slope)
    }

    fn at(&self, eccentricity_deg: f64) -> &Segment {
        let next = self.segments.partition_point(|segment| segment.from_deg <= eccentricity_deg);
        &self.segments[next.saturating_sub(1)]
    }

    /// Acuity in cycles per degree at `eccentricity_deg` ≥ 0.
    pub fn cutoff_cpd(&self, eccentricity_deg: f64) -> f64 {
        let segment = self.at(eccentricity_deg);
        1.0 / (segment.mar_deg + segment.slope * (eccentricity_deg - segment.from_deg))
    }

    /// `u(e) = ∫ 2f de` from 0° to `eccentricity_deg` ≥ 0: the number of samples between the gaze
    /// and this eccentricity when sampling at the rate of acuity.
    pub fn samples_to(&self, eccentricity_deg: f64) -> f64 {
        self.at(eccentricity_deg).samples_to(eccentricity_deg)
    }

    /// The eccentricity in degrees up to which there are `samples` ≥ 0 samples: the inverse of
    /// [`AcuityCurve::samples_to`].
    pub fn eccentricity_deg(&self, samples: f64) -> f64 {
        let next = self.segments.partition_point(|segment| segment.samples_before <= samples);
        self.segments[next.saturating_sub(1)].eccentricity_deg(samples)
    }

    /// Eccentricities in degrees where the slope of `1/f` changes, in rising order, without 0.
    pub fn knots_deg(&self) -> impl Iterator<Item = f64> + '_ {
        self.segments.iter().skip(1).map(|segment| segment.from_deg)
    }
}

impl Segment {
    /// `∫ 2 de / (a + b (e - e₀)) = 2/b ln(1 + b (e - e₀) / a)`. The code uses `log1p` because a
    /// flat segment has `b = 0`, where the printed logarithm is singular.
    fn samples_to(&self, eccentricity_deg: f64) -> f64 {
        let x = (eccentricity_deg - self.from_deg) / self.mar_deg;
        let t = self.slope * x;
        let mean = if t == 0.0 { 1.0 } else { libm::log1p(t) / t };
        self.samples_before + 2.0 * x * mean
    }

    fn eccentricity_deg(&self, samples: f64) -> f64 {
        let half = (samples - self.samples_before) / 2.0;
        let t = self.slope * half;
        let mean = if t == 0.0 { 1.0 } else { libm::expm1(t) / t };
        self.from_deg + self.mar_deg * half * mean
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::acuity::{AcuityModel, PiecewiseParams};

    fn piecewise(knots_cpd: [f64; 5], cap_cpd: Option<f64>) -> super::AcuityCurve {
        let knots_deg = vec![0.0, 10.0, 20.0, 30.0, 60.0];
        let params = PiecewiseParams { knots_deg, knots_cpd: knots_cpd.to_vec(), cap_cpd };
        AcuityModel::Piecewise(params).curve().unwrap()
    }

    /// VaFR's buffer is as wide as the number of samples up to 60°: 932.3 with f(60°) = 5, 900.1
    /// with f(60°) = 4.
    #[test]
    fn the_published_width_of_a_buffer() {
        let flat = piecewise([40.0, 10.0, 6.0, 5.0, 5.0], None);
        assert!((flat.samples_to(60.0) - 932.3).abs() < 0.05, "{}", flat.samples_to(60.0));
        let falling = piecewise([40.0, 10.0, 6.0, 5.0, 4.0], None);
        assert!((falling.samples_to(60.0) - 900.1).abs() < 0.05);
    }

    #[test]
    fn a_cap_breaks_exactly_where_acuity_falls_below_it() {
        let capped = piecewise([40.0, 10.0, 6.0, 5.0, 4.0], Some(9.0));
        // 1/f = 1/10 + (1/6 - 1/10)/10 (e - 10) = 1/9 at 10 + 5/3 degrees.
        let knots: Vec<f64> = capped.knots_deg().collect();
        assert!(knots.iter().any(|knot| (knot - (10.0 + 5.0 / 3.0)).abs() < 1e-12), "{knots:?}");
        for (e, cpd) in [(0.0, 9.0), (5.0, 9.0), (20.0, 6.0), (60.0, 4.0)] {
            assert!((capped.cutoff_cpd(e) - cpd).abs() < 1e-12, "{e}");
        }
        let uncapped = piecewise([40.0, 10.0, 6.0, 5.0, 4.0], Some(400.0));
        assert_eq!(uncapped, piecewise([40.0, 10.0, 6.0, 5.0, 4.0], None));
        let always = piecewise([40.0, 10.0, 6.0, 5.0, 5.0], Some(2.0));
        assert!((always.cutoff_cpd(90.0) - 2.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn samples_are_the_integral_and_turn_back(
            knots in prop::array::uniform5(1.0..60.0f64), e in 0.0..89.0f64,
            cap in prop::option::of(2.0..30.0f64)
        ) {
            let mut knots = knots;
            knots[4] = knots[4].min(knots[3]);
            let curve = piecewise(knots, cap);
            let u = curve.samples_to(e);
            prop_assert!((curve.eccentricity_deg(u) - e).abs() < 1e-9);
            let h = 1e-5;
            let away = curve.knots_deg().all(|knot| (knot - e).abs() > 2.0 * h);
            if away && e > h {
                let slope = (curve.samples_to(e + h) - curve.samples_to(e - h)) / (2.0 * h);
                prop_assert!((slope / (2.0 * curve.cutoff_cpd(e)) - 1.0).abs() < 1e-6);
            }
        }
    }

    /// At a knot, and at the number of samples before it, the next segment applies; the first
    /// segment begins at the gaze.
    #[test]
    fn knots_are_where_the_slope_changes() {
        let curve = piecewise([40.0, 10.0, 6.0, 5.0, 4.0], None);
        assert_eq!(curve.knots_deg().collect::<Vec<_>>(), [10.0, 20.0, 30.0, 60.0]);
        // 2 ∫ de / (1/40 + 3/400 e) = 800/3 ln(1 + 3 e / 10) up to 10°, and so on.
        let first = |e: f64| 800.0 / 3.0 * (1.0 + 0.3 * e).ln();
        let second = |e: f64| first(10.0) + 300.0 * (1.0 + (e - 10.0) / 15.0).ln();
        for (e, want) in [(9.9, first(9.9)), (10.0, first(10.0)), (10.1, second(10.1))] {
            assert!((curve.samples_to(e) / want - 1.0).abs() < 1e-12, "{e}");
            assert!((curve.eccentricity_deg(want) - e).abs() < 1e-9, "{e}");
        }
        // Beyond the last knot the last slope, 1/600 per degree, continues: 1200 ln(1 + (e - 60) /
        // 150).
        let beyond = curve.samples_to(75.0) - curve.samples_to(60.0);
        assert!((beyond / (1200.0 * 1.1f64.ln()) - 1.0).abs() < 1e-12, "{beyond}");
        assert!((curve.eccentricity_deg(curve.samples_to(9.9995)) - 9.9995).abs() < 1e-10);
    }
}
