//! VaFR, visual acuity consistent foveated rendering (Zhang, Gai, Li).
//!
//! Mapping (Eq. 3-12, 19): e = atan(c_r r), u = u(e) = ∫ 2f de, the column at e has l(e) = 360 Δ(e)
//! sin 2e f(e) rows, v = θ/360 l(e). Inverse: e(u), r = tan e / c_r. The rates are f (radial) and Δ
//! f (tangential), where both are divided by the radial dr/de (Eq. 6 and 20). In true visual angle
//! the tangential rate is f cos e, so that Eq. 6's "identical rates" hold only in the paper's
//! convention. `columns = "angle"` makes them identical in angle instead: l = 720 Δ sin e f. The
//! logarithm printed for u is singular where acuity is constant; this code uses log1p. Since v
//! depends on e, a line of constant θ moves by up to 2π rows per column near the gaze. Work at
//! equal θ, not at equal v.
//!
//! The number of samples is ∫ l du up to 60°, which is the paper's count. The paper mixes two sets
//! of knots: its number of samples is that of f(60°) = 4, its buffer of 932 x 1800 that of f(60°) =
//! 5.

use std::f64::consts::PI;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};
use fovqa_vision::acuity::{AcuityCurve, AcuityModel, GeislerPerry, LinearMar, PiecewiseParams};

use crate::error::MethodError;
use crate::foveation::{Counts, Foveation, Mapping, Rates};
use crate::info::MethodInfo;
use crate::quadrature;
use crate::setting::{Place, Setting, up_to};

/// The end of the paper's field, in degrees.
pub const FIELD_DEG: f64 = 60.0;

/// The sense in which a column's samples are as dense as the columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Columns {
    /// In the paper's convention.
    #[default]
    Paper,
    /// In visual angle.
    Angle,
}

/// How the method continues beyond 60°.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Beyond {
    /// The buffer continues to the farthest corner.
    #[default]
    Extend,
    /// The last column is repeated.
    Clamp,
    /// Nothing is shown.
    Black,
}

/// Parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// The acuity model that f follows.
    pub acuity: Acuity,
    /// Knots of the piecewise model, and the cap by a device.
    pub piecewise: PiecewiseParams,
    /// The sense in which rows are as dense as columns.
    pub columns: Columns,
    /// Δ(e), the ratio of the tangential to the radial rate: knots of eccentricity and ratio,
    /// linear in between and constant outside. Default 1 everywhere.
    pub ratio: Vec<[f64; 2]>,
    /// How the method continues beyond 60°.
    pub beyond: Beyond,
    /// VaFR_Rep (5.1): the share of the right eye's samples that are shaded again after
    /// reprojection.
    pub reprojected_share: Option<f64>,
    /// A factor on f; the number of samples grows with its square.
    pub factor: f64,
}

/// The acuity model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Acuity {
    /// The piecewise model with the given knots.
    #[default]
    Piecewise,
    /// The linear model with its defaults.
    LinearMar,
    /// Geisler and Perry's model with its defaults.
    GeislerPerry,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            acuity: Acuity::Piecewise,
            piecewise: PiecewiseParams::default(),
            columns: Columns::Paper,
            ratio: Vec::new(),
            beyond: Beyond::Extend,
            reprojected_share: None,
            factor: 1.0,
        }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "acuity" => {
                self.acuity = match value.text()? {
                    "piecewise" => Acuity::Piecewise,
                    "linear_mar" => Acuity::LinearMar,
                    "geisler_perry" => Acuity::GeislerPerry,
                    _ => return None,
                }
            }
            "columns" => {
                self.columns = match value.text()? {
                    "paper" => Columns::Paper,
                    "angle" => Columns::Angle,
                    _ => return None,
                }
            }
            "ratio" => self.ratio = value.pairs().unwrap_or_default(),
            "beyond" => {
                self.beyond = match value.text()? {
                    "extend" => Beyond::Extend,
                    "clamp" => Beyond::Clamp,
                    "black" => Beyond::Black,
                    _ => return None,
                }
            }
            "reprojected_share" => self.reprojected_share = value.number(),
            "factor" => self.factor = value.number()?,
            name => return self.piecewise.set(name, value),
        }
        Some(())
    }

    fn curve(&self) -> Result<AcuityCurve, MethodError> {
        let model = match self.acuity {
            Acuity::Piecewise => AcuityModel::Piecewise(self.piecewise.clone()),
            Acuity::LinearMar => AcuityModel::LinearMar(LinearMar::default()),
            Acuity::GeislerPerry => AcuityModel::GeislerPerry(GeislerPerry::default()),
        };
        let curve = model.curve().map_err(|error| refused(error.to_string()))?;
        // A device limits any model, not only the piecewise one.
        Ok(match (self.acuity, self.piecewise.cap_cpd) {
            (Acuity::LinearMar | Acuity::GeislerPerry, Some(cap_cpd)) => curve.capped(cap_cpd),
            _ => curve,
        })
    }
}

fn refused(message: String) -> MethodError {
    MethodError::Params { method: INFO.key, message }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "vafr",
    label: "VaFR",
    about: "visual acuity consistent foveated rendering: a log-polar buffer that follows acuity",
    source: "VaFR (Zhang, Gai, Li), Eq. 3-12, 19",
    params: &[
        ParamInfo {
            name: "acuity",
            default: "\"piecewise\"",
            values: ParamValues::Word(&["piecewise", "linear_mar", "geisler_perry"]),
            about: "the acuity model",
        },
        ParamInfo {
            name: "knots_deg",
            default: "[0, 10, 20, 30, 60]",
            values: ParamValues::Numbers,
            about: "eccentricities of the piecewise model's knots, °, increasing from 0",
        },
        ParamInfo {
            name: "knots_cpd",
            default: "[40, 10, 6, 5, 4]",
            values: ParamValues::Numbers,
            about: "acuity at the knots, cycles per degree, 0.01 to 1000",
        },
        ParamInfo {
            name: "cap_cpd",
            default: "\"none\"",
            values: ParamValues::NumberOr(0.01, 1000.0, "none"),
            about: "highest frequency that the device shows, cycles per degree",
        },
        ParamInfo {
            name: "columns",
            default: "\"paper\"",
            values: ParamValues::Word(&["paper", "angle"]),
            about: "definition of equal density along rows and columns",
        },
        ParamInfo {
            name: "ratio",
            default: "\"none\"",
            values: ParamValues::PairsOr("none"),
            about: "ratio of tangential to radial rate at eccentricities: [[°, ratio], …], increasing, 0.01 to 100",
        },
        ParamInfo {
            name: "beyond",
            default: "\"extend\"",
            values: ParamValues::Word(&["extend", "clamp", "black"]),
            about: "treatment of a frame beyond 60°",
        },
        ParamInfo {
            name: "reprojected_share",
            default: "\"none\"",
            values: ParamValues::NumberOr(0.0, 1.0, "none"),
            about: "VaFR_Rep: share of the second eye that is shaded again; counts are per eye",
        },
        ParamInfo {
            name: "factor",
            default: "1",
            values: ParamValues::Number(1e-3, 1000.0),
            about: "factor on the rate; samples grow with its square (a budget sets it)",
        },
    ],
};

/// VaFR, applied to a frame.
#[derive(Debug, Clone)]
pub struct Vafr {
    setting: Setting,
    curve: AcuityCurve,
    factor: f64,
    columns: Columns,
    ratio: Vec<[f64; 2]>,
    /// The end of the buffer, in degrees.
    end_deg: f64,
    /// The share of the samples that reprojection leaves to shade.
    shaded: f64,
}

impl Vafr {
    /// Applies the method to a frame and a gaze.
    ///
    /// # Errors
    /// When the knots do not make a curve, or ratios do not rise in eccentricity or are out of
    /// range.
    pub fn new(params: &Params, setting: &Setting) -> Result<Self, MethodError> {
        let curve = params.curve()?;
        let ratio = params.ratio.clone();
        if !ratio.windows(2).all(|pair| pair[0][0] < pair[1][0]) {
            return Err(refused("the eccentricities of ratio must increase".to_owned()));
        }
        if let Some([_, found]) = ratio.iter().find(|[_, r]| !(0.01..=100.0).contains(r)) {
            return Err(refused(format!("a ratio of {found} is not between 0.01 and 100")));
        }
        let corner_deg = setting.eccentricity_deg(setting.corner_px());
        let end_deg = match params.beyond {
            Beyond::Extend => corner_deg.max(FIELD_DEG),
            Beyond::Clamp | Beyond::Black => FIELD_DEG,
        };
        let shaded = params.reprojected_share.map_or(1.0, |share| f64::midpoint(1.0, share));
        Ok(Self {
            setting: *setting,
            curve,
            factor: params.factor,
            columns: params.columns,
            ratio,
            end_deg,
            shaded,
        })
    }

    /// f at an eccentricity in degrees, multiplied by the factor.
    fn rate_cpd(&self, e: f64) -> f64 {
        self.factor * self.curve.cutoff_cpd(e)
    }

    /// Δ at an eccentricity in degrees.
    fn ratio(&self, e: f64) -> f64 {
        let next = self.ratio.partition_point(|knot| knot[0] <= e);
        match (next.checked_sub(1).map(|i| self.ratio[i]), self.ratio.get(next)) {
            (None, None) => 1.0,
            (Some([_, only]), None) | (None, Some(&[_, only])) => only,
            (Some([e0, r0]), Some(&[e1, r1])) => r0 + (r1 - r0) * (e - e0) / (e1 - e0),
        }
    }

    /// u(e): the number of columns between the gaze and an eccentricity in degrees.
    pub fn columns_to(&self, e: f64) -> f64 {
        self.factor * self.curve.samples_to(e)
    }

    /// l(e): the number of rows of the column at an eccentricity in degrees.
    pub fn rows_at(&self, e: f64) -> f64 {
        let angle = e * (PI / 180.0);
        let around = match self.columns {
            Columns::Paper => 360.0 * libm::sin(2.0 * angle),
            Columns::Angle => 720.0 * libm::sin(angle),
        };
        around * self.ratio(e) * self.rate_cpd(e)
    }

    /// Eccentricities between which everything is smooth, within a range in degrees.
    fn breaks_deg(&self, from: f64, to: f64) -> Vec<f64> {
        let knots = self.curve.knots_deg().chain(self.ratio.iter().map(|knot| knot[0]));
        let mut breaks: Vec<f64> = knots.filter(|e| *e > from && *e < to).collect();
        breaks.extend([from, to]);
        breaks.sort_by(f64::total_cmp);
        breaks
    }

    /// The number of samples between two eccentricities in degrees: ∫ l(e) 2f(e) de.
    pub fn samples_between(&self, from: f64, to: f64) -> f64 {
        let breaks = self.breaks_deg(from, to);
        quadrature::pieces(&breaks, |e| self.rows_at(e) * 2.0 * self.rate_cpd(e))
    }

    /// The longest column up to an eccentricity in degrees: its eccentricity and its number of
    /// rows.
    pub fn longest_column(&self, to: f64) -> (f64, f64) {
        const SCAN: usize = 64;
        let longest = |(a, l): (f64, f64), b: f64| {
            if self.rows_at(b) > l { (b, self.rows_at(b)) } else { (a, l) }
        };
        let mut best = (0.0, 0.0);
        for ends in self.breaks_deg(0.0, to).windows(2) {
            let step = (ends[1] - ends[0]) / SCAN as f64;
            let at = |i: usize| ends[0] + i as f64 * step;
            let (near, _) = (0..=SCAN).map(at).fold((ends[0], 0.0), longest);
            // The function is smooth and has a single maximum between the neighbours.
            let (mut low, mut high) = ((near - step).max(ends[0]), (near + step).min(ends[1]));
            for _ in 0..100 {
                let third = (high - low) / 3.0;
                if self.rows_at(low + third) < self.rows_at(high - third) {
                    low += third;
                } else {
                    high -= third;
                }
            }
            best = [near, low.midpoint(high)].into_iter().fold(best, longest);
        }
        best
    }

    fn eccentricity_deg(&self, place: Place) -> f64 {
        self.setting.eccentricity_deg(place.radius_px)
    }
}

impl Mapping for Vafr {
    /// In a frame that extends beyond 60°, the buffer includes the columns out there.
    fn buffer(&self, _layer: usize) -> [f64; 2] {
        [self.columns_to(self.end_deg), self.longest_column(self.end_deg).1]
    }

    fn to_buffer(&self, _layer: usize, place: Place) -> [f64; 2] {
        let e = self.eccentricity_deg(place).min(self.end_deg);
        [self.columns_to(e), place.angle_deg() / 360.0 * self.rows_at(e)]
    }

    fn to_screen(&self, _layer: usize, [u, v]: [f64; 2]) -> Place {
        let e = self.curve.eccentricity_deg(u / self.factor);
        let rows = self.rows_at(e);
        let turn = if rows > 0.0 { v / rows } else { 0.0 };
        Place::polar(self.setting.radius_px(e), 360.0 * turn)
    }

    fn is_polar(&self) -> bool {
        true
    }
}

impl Foveation for Vafr {
    fn rates(&self, place: Place) -> Option<Rates> {
        let e = self.eccentricity_deg(place);
        if !up_to(e, self.end_deg) {
            return None;
        }
        let angle = e * (PI / 180.0);
        let cos = libm::cos(angle);
        // Degrees per pixel along the line from the gaze: dr/de = (π/180) f / cos² e.
        let degree = (180.0 / PI) * cos * cos / self.setting.focal_px();
        let across = match self.columns {
            Columns::Paper => degree,
            Columns::Angle => degree / cos,
        };
        let rate = 2.0 * self.rate_cpd(e);
        Some(Rates { radial: rate * degree, tangential: rate * self.ratio(e) * across })
    }

    fn counts(&self) -> Counts {
        let corner_deg = self.setting.eccentricity_deg(self.setting.corner_px());
        let samples = self.samples_between(0.0, FIELD_DEG);
        let beyond = if corner_deg > FIELD_DEG && self.end_deg > FIELD_DEG {
            self.samples_between(FIELD_DEG, corner_deg)
        } else {
            0.0
        };
        let mut breaks = vec![0.0];
        let knots = self.breaks_deg(0.0, self.end_deg.min(89.9));
        breaks.extend(knots.into_iter().skip(1).map(|e| self.setting.radius_px(e)));
        let density = |r| self.density(Place { radius_px: r, direction: [1.0, 0.0] });
        let on_screen = self.setting.integrate(&breaks, density);
        Counts {
            buffers: vec![[self.columns_to(FIELD_DEG), self.longest_column(FIELD_DEG).1]],
            samples: samples * self.shaded,
            samples_on_screen: on_screen * self.shaded,
            samples_beyond: beyond * self.shaded,
            samples_seen: on_screen * self.shaded,
        }
    }

    fn shaded_share(&self) -> f64 {
        self.shaded
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }

    fn note(&self) -> Option<String> {
        (self.shaded < 1.0).then(|| {
            "VaFR_Rep: the shares that remain to be shaded after reprojection were taken from the paper's \
             table, so its counts are not an independent check"
                .to_owned()
        })
    }
}
