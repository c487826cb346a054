//! The linear minimum angle of resolution, `1/f = m e + ω₀` (Guenter et al. 2012; VaFR, Eq. 2).

use fovqa_params::ParamValue;

/// A minimum angle of resolution that is linear over eccentricity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearMar {
    /// Slope in degrees per degree. Default 0.0275 (the conservative value is 0.022).
    pub m: f64,
    /// Angle of one cycle at the fovea, in degrees. Default 1/48.
    pub omega0_deg: f64,
}

impl Default for LinearMar {
    fn default() -> Self {
        Self { m: 0.0275, omega0_deg: 1.0 / 48.0 }
    }
}

impl LinearMar {
    /// Sets a parameter to a value that the registry has checked. `None` if there is no such
    /// parameter.
    pub(super) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "m" => self.m = value.number()?,
            "omega0_deg" => self.omega0_deg = value.number()?,
            _ => return None,
        }
        Some(())
    }

    /// Acuity in cycles per degree at `eccentricity_deg` ≥ 0.
    pub fn cutoff_cpd(&self, eccentricity_deg: f64) -> f64 {
        1.0 / (self.m * eccentricity_deg + self.omega0_deg)
    }
}
