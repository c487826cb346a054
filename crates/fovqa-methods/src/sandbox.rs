//! The perceptual sandbox of Patney et al. 2016 (section 3.1) as mathematics: how wide its blur is at
//! an eccentricity, and what it leaves of the contrast of a sine grating (their Fig. 3).
//!
//! - `stable`: a Gaussian of σ(e) = rate/60 · max(0, e − e_f) degrees, so a gain of
//!   G_σ(ν) = exp(−2 π² σ² ν²) at ν cycles per degree.
//! - `perceptual-target`: I' = I + f(e) (I − G_2σ * I) of the blurred frame I, so a gain of
//!   G_σ (1 + f (1 − G_2σ)), with f(e) = f_max · clamp((e − e_f)/T, 0, 1). The clamp of I' to \[0, 1\]
//!   is not linear, and is left out.
//! - `aliased`: samples on a grid of spacing d, read linearly, so a gain of sinc²(ν d) with
//!   sinc x = sin πx / πx, on average over the grid. The grids are 2^l pixels wide; σ pixels lie
//!   between two of them, whose gains are blended as their pictures are: linearly in log2 σ. The grid
//!   of one pixel is the frame itself. Above 1/(2d) the grid shows an alias instead of the grating.
//!
//! Degrees are those at the screen's centre: there is one number of pixels per degree, as in the
//! emulation. The emulation differs in two ways. It blends Gaussians of fixed widths, so that between
//! them its gain is up to 0.032 higher, and with an enhancement of f = 1 up to 0.064. And a finished
//! frame has no value between its pixels: a sample there is their mean, so that `aliased` has another
//! factor of cos(π ν p) for pixels of p degrees. A scene that can be asked anywhere has not.

use std::f64::consts::PI;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::setting::Setting;

/// `rate_arcmin`.
pub const RATE: ParamInfo = ParamInfo {
    name: "rate_arcmin",
    default: "2",
    values: ParamValues::Number(0.0, 600.0),
    about: "growth of the blur, minutes of arc a degree",
};

/// `foveal_deg`.
pub const FOVEAL: ParamInfo = ParamInfo {
    name: "foveal_deg",
    default: "15",
    values: ParamValues::Number(0.0, 89.0),
    about: "where the blur begins, ° (7.5 on a desktop)",
};

/// `transition_deg`.
pub const TRANSITION: ParamInfo = ParamInfo {
    name: "transition_deg",
    default: "20",
    values: ParamValues::Number(0.001, 1000.0),
    about: "over which enhancement rises to its full strength, °",
};

/// The largest strength of an enhancement.
pub const MOST_F_MAX: f64 = 100.0;

/// `f_max`.
pub const F_MAX: ParamInfo = ParamInfo {
    name: "f_max",
    default: "1",
    values: ParamValues::Number(0.0, MOST_F_MAX),
    about: "strength of the enhancement (3 and 5 ring)",
};

/// A blur that grows linearly with eccentricity, and the enhancement that follows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sandbox {
    /// Growth of the blur in minutes of arc per degree.
    pub rate_arcmin: f64,
    /// Where blur and enhancement begin, in degrees.
    pub foveal_deg: f64,
    /// Strength of the enhancement.
    pub f_max: f64,
    /// The range in degrees over which the strength rises to `f_max`.
    pub transition_deg: f64,
}

impl Default for Sandbox {
    fn default() -> Self {
        Self { rate_arcmin: 2.0, foveal_deg: 15.0, f_max: 1.0, transition_deg: 20.0 }
    }
}

impl Sandbox {
    /// Sets a parameter to a value that was checked. `None` if there is no such parameter.
    pub fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "rate_arcmin" => self.rate_arcmin = value.number()?,
            "foveal_deg" => self.foveal_deg = value.number()?,
            "f_max" => self.f_max = value.number()?,
            "transition_deg" => self.transition_deg = value.number()?,
            _ => return None,
        }
        Some(())
    }

    /// σ(e), the width of the blur in degrees.
    pub fn width_deg(&self, eccentricity_deg: f64) -> f64 {
        self.rate_arcmin / 60.0 * (eccentricity_deg - self.foveal_deg).max(0.0)
    }

    /// The width of the blur in pixels, at a distance in pixels from the gaze.
    pub fn width_px(&self, setting: &Setting, radius_px: f64) -> f64 {
        self.width_deg(setting.eccentricity_deg(radius_px)) * (setting.focal_px() * PI / 180.0)
    }

    /// f(e), the strength of the enhancement.
    pub fn strength(&self, eccentricity_deg: f64) -> f64 {
        let beyond_deg = eccentricity_deg - self.foveal_deg;
        self.f_max * (beyond_deg / self.transition_deg).clamp(0.0, 1.0)
    }

    /// The gain of `stable` at an eccentricity and a spatial frequency.
    pub fn stable_gain(&self, eccentricity_deg: f64, cpd: f64) -> f64 {
        gaussian_gain(self.width_deg(eccentricity_deg), cpd)
    }

    /// The gain of `perceptual-target`.
    pub fn perceptual_target_gain(&self, eccentricity_deg: f64, cpd: f64) -> f64 {
        let width_deg = self.width_deg(eccentricity_deg);
        let restored = 1.0 - gaussian_gain(2.0 * width_deg, cpd);
        gaussian_gain(width_deg, cpd) * (1.0 + self.strength(eccentricity_deg) * restored)
    }

    /// The gain of `aliased` on a screen: what is left of the grating itself, without its aliases.
    pub fn aliased_gain(&self, eccentricity_deg: f64, cpd: f64, pixels_per_degree: f64) -> f64 {
        let level = self.level(eccentricity_deg, pixels_per_degree);
        let (fine, blend) = (level.floor(), level - level.floor());
        let gain = |level: f64| match level {
            0.0 => 1.0,
            level => sinc(cpd * libm::exp2(level) / pixels_per_degree).powi(2),
        };
        (1.0 - blend) * gain(fine) + blend * gain(fine + 1.0)
    }

    /// The Nyquist frequency of the coarsest grid that `aliased` reads, in cycles per degree.
    pub fn aliased_nyquist_cpd(&self, eccentricity_deg: f64, pixels_per_degree: f64) -> f64 {
        let spacing_px = libm::exp2(self.level(eccentricity_deg, pixels_per_degree).ceil());
        pixels_per_degree / (2.0 * spacing_px)
    }

    /// j = log2 max(1, σ in pixels): the grids of 2^⌊j⌋ and 2^(⌊j⌋ + 1) pixels are blended.
    fn level(&self, eccentricity_deg: f64, pixels_per_degree: f64) -> f64 {
        libm::log2((self.width_deg(eccentricity_deg) * pixels_per_degree).max(1.0))
    }
}

/// What a Gaussian of width σ leaves of a grating.
fn gaussian_gain(width_deg: f64, cpd: f64) -> f64 {
    libm::exp(-2.0 * (PI * width_deg * cpd).powi(2))
}

fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { libm::sin(PI * x) / (PI * x) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PPD: f64 = 60.0;

    fn close(found: f64, want: f64) {
        assert!((found - want).abs() < 1e-9, "{found} {want}");
    }

    #[test]
    fn nothing_is_lost_within_the_fovea_and_at_frequency_0() {
        let sandbox = Sandbox::default();
        for (e, cpd) in [(15.0, 25.0), (3.0, 1.0), (40.0, 0.0)] {
            close(sandbox.stable_gain(e, cpd), 1.0);
            close(sandbox.perceptual_target_gain(e, cpd), 1.0);
            close(sandbox.aliased_gain(e, cpd, PPD), 1.0);
        }
        close(sandbox.aliased_nyquist_cpd(10.0, PPD), 30.0);
    }

    /// By hand: at 30°, σ = 0.5° and f = 0.75; at 0.5 cycles per degree, G = exp(−π²/8).
    #[test]
    fn gains_are_those_of_the_formulas() {
        let sandbox = Sandbox::default();
        let (g, g2) = (0.291_212_9, 0.007_191_883);
        assert!((sandbox.stable_gain(30.0, 0.5) - g).abs() < 1e-6);
        let want = g * (1.0 + 0.75 * (1.0 - g2));
        assert!((sandbox.perceptual_target_gain(30.0, 0.5) - want).abs() < 1e-6);
        // On a screen of 64 pixels per degree σ is 32 pixels, a grid of its own: sinc²(1/4) = 8/π².
        close(sandbox.aliased_gain(30.0, 0.5, 64.0), 8.0 / (PI * PI));
        close(sandbox.aliased_nyquist_cpd(30.0, 64.0), 1.0);
        // √2 times as many: half way between the grids of 32 and 64 pixels.
        let ppd = 64.0 * 2f64.sqrt();
        let fine = sinc(32.0 * 0.5 / ppd).powi(2);
        let coarse = sinc(64.0 * 0.5 / ppd).powi(2);
        close(sandbox.aliased_gain(30.0, 0.5, ppd), f64::midpoint(fine, coarse));
        close(sandbox.aliased_nyquist_cpd(30.0, ppd), ppd / 128.0);
    }

    #[test]
    fn parameters_are_set_by_name() {
        let mut sandbox = Sandbox::default();
        for (info, default) in
            [(RATE, sandbox.rate_arcmin), (FOVEAL, 15.0), (TRANSITION, 20.0), (F_MAX, 1.0)]
        {
            assert_eq!(info.default_value(), ParamValue::Number(default));
            sandbox.set(info.name, &ParamValue::Number(7.0)).unwrap();
        }
        let want = Sandbox { rate_arcmin: 7.0, foveal_deg: 7.0, f_max: 7.0, transition_deg: 7.0 };
        assert_eq!(sandbox, want);
        assert_eq!(sandbox.set("x", &ParamValue::Number(1.0)), None);
    }
}
