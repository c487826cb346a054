//! The cut-off frequency of Geisler and Perry 1998, as Lee, Pattichis and Bovik 2002 use it:
//! `f_c(e) = e₂ ln(1 / CT₀) / (α (e + e₂))`, from their contrast threshold
//! `CT(f, e) = CT₀ exp(α f (e + e₂) / e₂)` at `CT = 1`.

use fovqa_params::ParamValue;

/// Parameters of the contrast threshold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeislerPerry {
    /// Spatial-frequency decay constant. Default 0.106.
    pub alpha: f64,
    /// Half-resolution eccentricity in degrees. Default 2.3.
    pub e2_deg: f64,
    /// Smallest contrast threshold. Default 1/64.
    pub ct0: f64,
}

impl Default for GeislerPerry {
    fn default() -> Self {
        Self { alpha: 0.106, e2_deg: 2.3, ct0: 1.0 / 64.0 }
    }
}

impl GeislerPerry {
    /// Sets a parameter to a value that the registry has checked. `None` if there is no such
    /// parameter.
    pub(super) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "alpha" => self.alpha = value.number()?,
            "e2_deg" => self.e2_deg = value.number()?,
            "ct0" => self.ct0 = value.number()?,
            _ => return None,
        }
        Some(())
    }

    /// `f_c(e) (e + e₂)`, which is constant: the cut-off frequency is this number divided by
    /// `e + e₂`.
    pub fn numerator(&self) -> f64 {
        self.e2_deg * libm::log(1.0 / self.ct0) / self.alpha
    }

    /// Cut-off frequency in cycles per degree at `eccentricity_deg` ≥ 0.
    pub fn cutoff_cpd(&self, eccentricity_deg: f64) -> f64 {
        self.numerator() / (eccentricity_deg + self.e2_deg)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_values() {
        let model = GeislerPerry::default();
        for (e, cpd) in [(0.0, 39.23), (10.0, 7.34), (30.0, 2.79)] {
            assert!((model.cutoff_cpd(e) - cpd).abs() < 5e-3, "{e}");
        }
    }
}
