//! Display presets, from the data file `configs/displays.toml`.

use std::sync::LazyLock;

use serde::Deserialize;

/// How a display turns encoded values into light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Eotf {
    /// IEC 61966-2-1.
    Srgb,
    /// SMPTE ST 2084.
    Pq,
    /// Values are light already.
    Linear,
}

/// What a display shows, in light.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Luminance {
    /// White, in cd/m².
    pub peak_cd_m2: f64,
    /// Peak over black, in the dark. One of this and `min_cd_m2`.
    pub contrast: Option<f64>,
    /// Black in the dark, in cd/m².
    pub min_cd_m2: Option<f64>,
    /// Light falling on the screen, in lux.
    #[serde(default)]
    pub ambient_lux: f64,
    /// Encoding of its input.
    pub eotf: Eotf,
}

/// A display preset.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Its name, with `_`.
    pub name: String,
    /// Width and height in pixels.
    pub resolution: [usize; 2],
    /// Its optics.
    pub geometry: Geometry,
    /// Its photometry, where it is known.
    pub luminance: Option<Luminance>,
    /// Where the numbers come from.
    pub source: String,
}

/// Where the display stands in the visual field.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Geometry {
    /// A flat screen in front of the eye.
    Screen {
        /// Diagonal in inches.
        diagonal_in: f64,
        /// Distance of the eye in metres.
        distance_m: f64,
    },
    /// Diagonal field of view in degrees, square pixels.
    FovDiagonalDeg(f64),
    /// Vertical field of view in degrees, square pixels.
    FovVerticalDeg(f64),
    /// Horizontal and vertical field of view in degrees.
    FovDeg([f64; 2]),
    /// Pixels per degree at the centre, square pixels.
    PixelsPerDegree(f64),
}

impl Display {
    /// Focal length in pixels of the display, along x and y.
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

    /// Pixels that one degree takes at the centre, as FovVideoVDP counts them:
    /// `1 / (2 atan(pixel / 2))`.
    pub fn central_pixels_per_degree(&self) -> f64 {
        0.5 / libm::atan(0.5 / self.focal_px()[0]).to_degrees()
    }

    /// The geometry in words, for lists.
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
    // Embedded, and parsed by a test: it cannot fail for a user.
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

    /// FovVideoVDP's own figures for its presets.
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

    #[test]
    fn every_preset_is_whole() {
        for display in displays() {
            assert!(display.focal_px().iter().all(|f| *f > 1.0 && f.is_finite()), "{display:?}");
            assert!(!display.source.is_empty());
            assert!(!display.name.contains('-'));
            if let Some(light) = display.luminance {
                assert!(light.contrast.is_some() != light.min_cd_m2.is_some(), "{}", display.name);
            }
            assert_eq!(find_display(&display.name.replace('_', "-")), Some(display));
        }
        assert!((find_display("pimax-crystal").unwrap().focal_px()[0] - 2005.352).abs() < 1e-3);
    }
}
