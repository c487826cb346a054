//! Display presets, from the data file `configs/displays.toml`.

use std::f64::consts::PI;
use std::sync::LazyLock;

use fovqa_params::words;
use serde::{Deserialize, Serialize};
use thiserror::Error;

words! {
    /// How a display turns encoded values into luminance.
    pub enum Eotf {
        /// IEC 61966-2-1.
        Srgb "srgb" "IEC 61966-2-1";
        /// A power function with the exponent [`Luminance::gamma`].
        Gamma "gamma" "A power function";
        /// SMPTE ST 2084: values are encoded absolute luminance.
        Pq "pq" "SMPTE ST 2084";
        /// Values are luminance already, in cd/m².
        Linear "linear" "Values are luminances in cd/m²";
        /// Values are measured luminance in cd/m²: the display adds neither black level nor
        /// reflections.
        Absolute "absolute" "Measured luminances in cd/m², to which nothing is added";
    }
}

impl Eotf {
    /// Whether a value stands for a share of the display's white, rather than for an absolute
    /// luminance.
    pub fn is_relative(self) -> bool {
        matches!(self, Self::Srgb | Self::Gamma)
    }
}

/// The photometry of a display.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Luminance {
    /// Luminance of white, in cd/m².
    pub peak_cd_m2: f64,
    /// Contrast in the dark, peak over black. The default is 500 if `min_cd_m2` is missing as well.
    pub contrast: Option<f64>,
    /// Luminance of black in the dark, in cd/m². If it is given, `contrast` is ignored.
    pub min_cd_m2: Option<f64>,
    /// Illuminance on the screen, in lux.
    #[serde(default)]
    pub ambient_lux: f64,
    /// Share of the ambient light that the screen reflects, from 0 to 1.
    #[serde(default = "usual_reflectivity")]
    pub reflectivity: f64,
    /// Encoding of the display's input.
    pub eotf: Eotf,
    /// The exponent of [`Eotf::Gamma`].
    #[serde(default = "usual_gamma")]
    pub gamma: f64,
}

fn usual_reflectivity() -> f64 {
    Luminance::REFLECTIVITY
}

fn usual_gamma() -> f64 {
    Luminance::GAMMA
}

/// Photometry that is not possible.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("the display's {what} of {found} is not {expected}")]
pub struct LuminanceError {
    /// Name of the number that is wrong.
    pub what: &'static str,
    /// The value that was given.
    pub found: f64,
    /// The values that are possible.
    pub expected: &'static str,
}

impl Luminance {
    /// Default reflectivity (FovVideoVDP 1.2).
    pub const REFLECTIVITY: f64 = 0.005;
    /// Default gamma.
    pub const GAMMA: f64 = 2.2;
    /// Default contrast if neither contrast nor black is given (FovVideoVDP 1.2).
    pub const CONTRAST: f64 = 500.0;

    /// A display with this peak luminance, in the dark, with defaults for everything else.
    pub fn of_peak(peak_cd_m2: f64) -> Self {
        Self {
            peak_cd_m2,
            contrast: None,
            min_cd_m2: None,
            ambient_lux: 0.0,
            reflectivity: Self::REFLECTIVITY,
            eotf: Eotf::Srgb,
            gamma: Self::GAMMA,
        }
    }

    /// The luminance of black in cd/m²: the panel's own black plus the reflected light
    /// `ambient_lux / π · reflectivity` (FovVideoVDP 1.2). It is 0 for measured luminance
    /// ([`Eotf::Absolute`]).
    pub fn black_cd_m2(&self) -> f64 {
        if self.eotf == Eotf::Absolute {
            return 0.0;
        }
        let contrast = self.contrast.unwrap_or(Self::CONTRAST);
        let leak = self.min_cd_m2.unwrap_or(self.peak_cd_m2 / contrast);
        self.ambient_lux / PI * self.reflectivity + leak
    }

    /// Checks that such a display is possible.
    ///
    /// # Errors
    /// When a number is out of its range (the error names the first one), or black is as bright as
    /// white.
    pub fn check(&self) -> Result<(), LuminanceError> {
        let error = |what, found, expected| Err(LuminanceError { what, found, expected });
        let within = |value: f64, from: f64, to: f64| (from..=to).contains(&value);
        let light = "between 0.01 and 1,000,000 cd/m²";
        if !within(self.peak_cd_m2, 0.01, 1e6) {
            return error("peak_cd_m2", self.peak_cd_m2, light);
        }
        if let Some(contrast) = self.contrast.filter(|c| !within(*c, 1.0, 1e12)) {
            return error("contrast", contrast, "between 1 and 1e12");
        }
        if let Some(min) = self.min_cd_m2.filter(|min| !within(*min, 0.0, 1e6)) {
            return error("min_cd_m2", min, "between 0 and 1,000,000 cd/m²");
        }
        if !within(self.ambient_lux, 0.0, 1e6) {
            return error("ambient_lux", self.ambient_lux, "between 0 and 1,000,000 lux");
        }
        if !within(self.reflectivity, 0.0, 1.0) {
            return error("reflectivity", self.reflectivity, "between 0 and 1");
        }
        if !within(self.gamma, 0.1, 10.0) {
            return error("gamma", self.gamma, "between 0.1 and 10");
        }
        let darkest = self.min_cd_m2.filter(|_| self.eotf == Eotf::Absolute);
        let black = darkest.unwrap_or_else(|| self.black_cd_m2());
        if black >= self.peak_cd_m2 {
            return error("black", black, "below its peak, in cd/m²");
        }
        Ok(())
    }
}

/// A display preset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// The preset's name, written with `_`.
    pub name: String,
    /// Width and height in pixels.
    pub resolution: [usize; 2],
    /// Its geometry.
    pub geometry: Geometry,
    /// Its photometry, if it is known.
    pub luminance: Option<Luminance>,
    /// The publication or data sheet of the numbers.
    pub source: String,
}

/// The part of the visual field that the display fills.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Geometry {
    /// A flat screen in front of the eye.
    Screen {
        /// Diagonal in inches.
        diagonal_in: f64,
        /// Distance from the eye in metres.
        distance_m: f64,
    },
    /// Diagonal field of view in degrees; pixels are square.
    FovDiagonalDeg(f64),
    /// Vertical field of view in degrees; pixels are square.
    FovVerticalDeg(f64),
    /// Horizontal and vertical field of view in degrees.
    FovDeg([f64; 2]),
    /// Pixels per degree at the centre; pixels are square.
    PixelsPerDegree(f64),
}

impl Display {
    /// Focal lengths in pixels of the display, along x and y.
    pub fn focal_px(&self) -> [f64; 2] {
        let [w, h] = self.resolution.map(|side| side as f64);
        let focal =
            |extent: f64, fov_deg: f64| extent / 2.0 / libm::tan((fov_deg / 2.0).to_radians());
        match self.geometry {
            Geometry::Screen { diagonal_in, distance_m } => {
                const METRES_PER_INCH: f64 = 0.0254;
                [distance_m * libm::hypot(w, h) / (diagonal_in * METRES_PER_INCH); 2]
            }
            Geometry::FovDiagonalDeg(fov) => [focal(libm::hypot(w, h), fov); 2],
            Geometry::FovVerticalDeg(fov) => [focal(h, fov); 2],
            Geometry::FovDeg([x, y]) => [focal(w, x), focal(h, y)],
            Geometry::PixelsPerDegree(ppd) => [ppd.to_degrees(); 2],
        }
    }

    /// Pixels per degree at the centre, as FovVideoVDP counts them: `1 / (2 atan(pixel / 2))`.
    pub fn central_pixels_per_degree(&self) -> f64 {
        0.5 / libm::atan(0.5 / self.focal_px()[0]).to_degrees()
    }

    /// The geometry in words, for lists of displays.
    pub fn geometry_in_words(&self) -> String {
        match self.geometry {
            Geometry::Screen { diagonal_in, distance_m } => {
                format!("{diagonal_in} in at {distance_m} m")
            }
            Geometry::FovDiagonalDeg(fov) => format!("{fov}° diagonal"),
            Geometry::FovVerticalDeg(fov) => format!("{fov}° vertical"),
            Geometry::FovDeg([x, y]) => format!("{x}° x {y}°"),
            Geometry::PixelsPerDegree(ppd) => format!("{ppd} px/° at the centre"),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    display: Vec<Display>,
}

static DISPLAYS: LazyLock<Vec<Display>> = LazyLock::new(|| {
    let file: Result<File, _> = toml::from_str(include_str!("../../../configs/displays.toml"));
    // The file is embedded and a test parses it, so this cannot fail for a user.
    file.unwrap_or_else(|error| panic!("configs/displays.toml: {error}")).display
});

/// All presets, in the order of the file.
pub fn displays() -> &'static [Display] {
    &DISPLAYS
}

/// The preset of a name; `-` and `_` are alike.
pub fn find_display(name: &str) -> Option<&'static Display> {
    let name = name.replace('-', "_").to_lowercase();
    displays().iter().find(|display| display.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The expected values are FovVideoVDP's own for its presets.
    #[test]
    fn pixels_per_degree_are_those_of_fovvideovdp() {
        for (name, ppd) in [
            ("standard_4k", 75.402_449_3),
            ("standard_fhd", 37.842_503_9),
            ("standard_hmd", 13.153_262_5),
            ("standard_phone", 120.560_815),
            ("sdr_4k_30", 60.548_005_5),
            ("iphone_12_pro", 159.611_877),
            ("ipad_pro_12_9", 92.391_509_8),
            ("macbook_pro_16", 98.792_419_7),
            ("lg_oled_2017_sdr", 120.410_738),
        ] {
            let found = find_display(name).unwrap().central_pixels_per_degree();
            assert!((found / ppd - 1.0).abs() < 1e-7, "{name}: {found}");
        }
    }

    /// The expected values are FovVideoVDP's own.
    #[test]
    fn black_is_panel_black_plus_reflections() {
        for (name, black) in [
            ("standard_4k", 0.597_887_358),
            ("standard_hdr_pq", 0.017_415_494_3),
            ("standard_hdr_linear", 0.017_415_494_3),
            ("standard_fhd", 0.597_887_358),
            ("standard_hmd", 0.1),
            ("standard_phone", 0.447_887_358),
            ("sdr_4k_30", 0.497_887_358),
            ("sdr_fhd_24", 0.497_887_358),
            ("htc_vive_pro", 0.1),
            ("iphone_12_pro", 0.398_287_358),
            ("ipad_pro_12_9", 0.767_887_358),
            ("macbook_pro_16", 0.767_887_358),
            ("lg_oled_2017_sdr", 0.173_154_943),
            ("lg_oled_2017_hdr", 0.197_154_943),
        ] {
            let found = find_display(name).unwrap().luminance.unwrap().black_cd_m2();
            assert!((found / black - 1.0).abs() < 1e-8, "{name}: {found}");
        }
        let plain = Luminance::of_peak(100.0);
        assert!((plain.black_cd_m2() - 0.2).abs() < 1e-12);
        let both = Luminance { min_cd_m2: Some(0.05), contrast: Some(10.0), ..plain };
        assert!((both.black_cd_m2() - 0.05).abs() < 1e-12, "min goes before contrast");
        assert!(Luminance { eotf: Eotf::Absolute, ..plain }.black_cd_m2().abs() < 1e-12);
    }

    #[test]
    fn photometry_that_cannot_be_is_refused() {
        let plain = Luminance::of_peak(100.0);
        plain.check().unwrap();
        for (what, wrong) in [
            ("peak_cd_m2", Luminance::of_peak(0.0)),
            ("peak_cd_m2", Luminance::of_peak(f64::NAN)),
            ("contrast", Luminance { contrast: Some(0.5), ..plain }),
            ("min_cd_m2", Luminance { min_cd_m2: Some(-1.0), ..plain }),
            ("ambient_lux", Luminance { ambient_lux: -1.0, ..plain }),
            ("reflectivity", Luminance { reflectivity: 1.5, ..plain }),
            ("gamma", Luminance { gamma: 0.0, ..plain }),
            ("black", Luminance { min_cd_m2: Some(100.0), ..plain }),
            ("black", Luminance { ambient_lux: 1e6, ..plain }),
        ] {
            assert_eq!(wrong.check().unwrap_err().what, what);
        }
    }

    #[test]
    fn every_preset_is_whole() {
        for display in displays() {
            assert!(display.focal_px().iter().all(|f| *f > 1.0 && f.is_finite()), "{display:?}");
            assert!(!display.source.is_empty());
            assert!(!display.name.contains('-'));
            if let Some(light) = display.luminance {
                assert!(light.contrast.is_some() != light.min_cd_m2.is_some(), "{}", display.name);
                light.check().unwrap();
            }
            assert_eq!(find_display(&display.name.replace('_', "-")), Some(display));
        }
        assert!((find_display("pimax-crystal").unwrap().focal_px()[0] - 2005.352).abs() < 1e-3);
    }
}
