//! Acuity whose inverse is piecewise linear over eccentricity (VaFR, Eq. 12).

use fovqa_params::ParamValue;
use thiserror::Error;

use super::AcuityCurve;
use super::model::CPD;

/// Acuity whose inverse `1/f` is linear between knots and keeps its last slope beyond the last
/// knot.
#[derive(Debug, Clone, PartialEq)]
pub struct PiecewiseMar {
    knots: Vec<(f64, f64)>,
}

/// The parameters: two lists that give the knots, and the highest frequency that a device shows.
#[derive(Debug, Clone, PartialEq)]
pub struct PiecewiseParams {
    /// Eccentricities of the knots in degrees, rising from 0.
    pub knots_deg: Vec<f64>,
    /// Acuity at these eccentricities, in cycles per degree.
    pub knots_cpd: Vec<f64>,
    /// The highest frequency that a device shows, in cycles per degree (VaFR, Fig. 3: 9 for the
    /// Vive Pro Eye, 18 for the Pimax Crystal).
    pub cap_cpd: Option<f64>,
}

impl Default for PiecewiseParams {
    fn default() -> Self {
        let (knots_deg, knots_cpd) = PiecewiseMar::default().knots.into_iter().unzip();
        Self { knots_deg, knots_cpd, cap_cpd: None }
    }
}

impl PiecewiseParams {
    /// Sets a parameter to a value that a registry has checked. `None` if there is no such
    /// parameter.
    pub fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "knots_deg" => self.knots_deg = value.list()?,
            "knots_cpd" => self.knots_cpd = value.list()?,
            "cap_cpd" => self.cap_cpd = value.number(),
            _ => return None,
        }
        Some(())
    }

    /// The curve through the knots, limited to the cap.
    ///
    /// # Errors
    /// When the knots do not make a curve.
    pub fn curve(&self) -> Result<AcuityCurve, PiecewiseMarError> {
        let knots = PiecewiseMar::new(&self.knots_deg, &self.knots_cpd)?.knots;
        if let Some(&(_, found_cpd)) = knots.iter().find(|knot| !CPD.contains(&knot.1)) {
            return Err(PiecewiseMarError::Frequency { found_cpd });
        }
        let mars: Vec<(f64, f64)> = knots.iter().map(|&(deg, cpd)| (deg, 1.0 / cpd)).collect();
        let &[.., before, last] = mars.as_slice() else { return Err(PiecewiseMarError::Order) };
        let curve = AcuityCurve::through(&mars, (last.1 - before.1) / (last.0 - before.0));
        Ok(self.cap_cpd.map_or(curve.clone(), |cap_cpd| curve.capped(cap_cpd)))
    }
}

/// Knots that do not make an acuity curve.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PiecewiseMarError {
    /// There are fewer than two knots, or the two lists differ in length.
    #[error(
        "{eccentricities} eccentricities and {frequencies} frequencies do not form knots: give at \
         least two, with one frequency per eccentricity"
    )]
    Count {
        /// Number of eccentricities given.
        eccentricities: usize,
        /// Number of frequencies given.
        frequencies: usize,
    },
    /// The eccentricities do not rise from 0.
    #[error("the eccentricities of the knots must start at 0° and increase up to at most 180°")]
    Order,
    /// Acuity rises at the end: beyond the last knot it would grow without bound.
    #[error("acuity must decrease between the last two knots")]
    Rising,
    /// A frequency is beyond that of any eye.
    #[error("the knot of {found_cpd} cpd is not between 0.01 and 1000 cycles per degree")]
    Frequency {
        /// The frequency that was given, in cycles per degree.
        found_cpd: f64,
    },
}

impl Default for PiecewiseMar {
    /// VaFR's knots: (0°, 40), (10°, 10), (20°, 6), (30°, 5), (60°, 4) cycles per degree.
    fn default() -> Self {
        let knots = [(0.0, 40.0), (10.0, 10.0), (20.0, 6.0), (30.0, 5.0), (60.0, 4.0)];
        Self { knots: knots.to_vec() }
    }
}

impl PiecewiseMar {
    /// A curve through knots of eccentricity in degrees and acuity in cycles per degree.
    ///
    /// # Errors
    /// When there are fewer than two knots, they do not rise from 0°, or a frequency is not
    /// positive.
    pub fn new(knots_deg: &[f64], knots_cpd: &[f64]) -> Result<Self, PiecewiseMarError> {
        if knots_deg.len() != knots_cpd.len() || knots_deg.len() < 2 {
            return Err(PiecewiseMarError::Count {
                eccentricities: knots_deg.len(),
                frequencies: knots_cpd.len(),
            });
        }
        if knots_deg[0] != 0.0
            || !knots_deg.windows(2).all(|pair| pair[1] > pair[0])
            || knots_deg.iter().any(|deg| *deg > 180.0)
        {
            return Err(PiecewiseMarError::Order);
        }
        if let Some(&found_cpd) = knots_cpd.iter().find(|f| !(**f > 0.0 && f.is_finite())) {
            return Err(PiecewiseMarError::Frequency { found_cpd });
        }
        if knots_cpd[knots_cpd.len() - 1] > knots_cpd[knots_cpd.len() - 2] {
            return Err(PiecewiseMarError::Rising);
        }
        Ok(Self { knots: knots_deg.iter().copied().zip(knots_cpd.iter().copied()).collect() })
    }

    /// Acuity in cycles per degree at `eccentricity_deg` ≥ 0.
    pub fn cutoff_cpd(&self, eccentricity_deg: f64) -> f64 {
        let next = self.knots.partition_point(|knot| knot.0 <= eccentricity_deg);
        let segment = next.clamp(1, self.knots.len() - 1);
        let ((e0, f0), (e1, f1)) = (self.knots[segment - 1], self.knots[segment]);
        let slope = (1.0 / f1 - 1.0 / f0) / (e1 - e0);
        1.0 / (1.0 / f0 + slope * (eccentricity_deg - e0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_its_knots_and_continues() {
        let model = PiecewiseMar::default();
        for (e, f) in [(0.0, 40.0), (10.0, 10.0), (20.0, 6.0), (30.0, 5.0), (60.0, 4.0)] {
            assert!((model.cutoff_cpd(e) - f).abs() < 1e-12);
        }
        assert!((1.0 / model.cutoff_cpd(5.0) - 0.0625).abs() < 1e-12);
        assert!((1.0 / model.cutoff_cpd(90.0) - (2.0 / 4.0 - 1.0 / 5.0)).abs() < 1e-12);
    }

    #[test]
    fn refuses_knots_out_of_order() {
        assert_eq!(
            PiecewiseMar::new(&[0.0, 5.0, 5.0], &[3.0, 2.0, 1.0]),
            Err(PiecewiseMarError::Order)
        );
        assert_eq!(PiecewiseMar::new(&[1.0, 5.0], &[3.0, 2.0]), Err(PiecewiseMarError::Order));
        assert_eq!(PiecewiseMar::new(&[0.0, 5.0], &[3.0, 4.0]), Err(PiecewiseMarError::Rising));
        assert!(PiecewiseMar::new(&[0.0], &[3.0]).is_err());
        assert!(PiecewiseMar::new(&[0.0, 5.0], &[3.0, 0.0]).is_err());
    }

    #[test]
    fn refuses_unequal_lists_and_impossible_knots() {
        for (degs, cpds) in
            [(&[0.0, 5.0, 9.0][..], &[3.0, 2.0][..]), (&[0.0, 5.0], &[3.0, 2.0, 1.0])]
        {
            let error = PiecewiseMar::new(degs, cpds).unwrap_err();
            assert!(matches!(error, PiecewiseMarError::Count { .. }), "{error}");
        }
        assert_eq!(PiecewiseMar::new(&[0.0, 181.0], &[3.0, 2.0]), Err(PiecewiseMarError::Order));
        assert!(PiecewiseMar::new(&[0.0, 180.0], &[3.0, 3.0]).is_ok(), "flat at the end");
        for cpd in [f64::NAN, f64::INFINITY] {
            assert!(PiecewiseMar::new(&[0.0, 5.0], &[cpd, 1.0]).is_err());
        }
        // A curve with two knots and one with six.
        let two = PiecewiseMar::new(&[0.0, 10.0], &[10.0, 5.0]).unwrap();
        assert!((two.cutoff_cpd(30.0) - 2.5).abs() < 1e-12);
        let six =
            PiecewiseMar::new(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], &[9.0, 8.0, 7.0, 6.0, 5.0, 4.0]);
        assert!((six.unwrap().cutoff_cpd(5.0) - 4.0).abs() < 1e-12);
    }
}
