//! Golden values: what independent implementations found for the same pictures.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;

/// One pair of pictures with its values. `None` for decibels of identical pictures, or for what
/// is not defined.
#[derive(Debug, Clone, Deserialize)]
#[allow(missing_docs, reason = "a field is named after the measure and the signal it is of")]
pub struct Case {
    pub id: String,
    pub reference: String,
    pub test: String,
    pub vfov_deg: f64,
    pub gaze: Option<[f64; 2]>,
    pub bands_deg: Vec<f64>,
    pub width: usize,
    pub height: usize,
    pub mse_rgb: f64,
    pub psnr_rgb: Option<f64>,
    pub psnr_luma: Option<f64>,
    pub ssim_rgb: f64,
    pub ssim_luma: f64,
    pub fpsnr_rgb: Option<f64>,
    pub fpsnr_luma: Option<f64>,
    pub ms_ssim_rgb: Option<f64>,
    pub ms_ssim_luma: Option<f64>,
    pub fssim_rgb: f64,
    pub fssim_luma: f64,
    pub bands: Vec<Band>,
    pub haar_reference: Vec<Haar>,
    pub haar_test: Vec<Haar>,
}

/// Values of one band.
#[derive(Debug, Clone, Deserialize)]
#[allow(missing_docs, reason = "a field is named after the measure and the signal it is of")]
pub struct Band {
    pub from_deg: f64,
    pub to_deg: f64,
    pub pixels: u64,
    #[serde(default)]
    pub psnr: Option<f64>,
    #[serde(default)]
    pub rms_contrast_reference: Option<f64>,
    #[serde(default)]
    pub rms_contrast_test: Option<f64>,
}

/// One picture's wavelet coefficients of one level in one band.
#[derive(Debug, Clone, Deserialize)]
#[allow(missing_docs, reason = "a field is named after what it holds")]
pub struct Haar {
    pub level: usize,
    pub from_deg: f64,
    pub to_deg: f64,
    pub coefficients: u64,
    pub mean_abs: f64,
    pub max_abs: f64,
    pub energy: f64,
}

/// Differences over time of the ground truth and of methods, by their folders.
#[derive(Debug, Clone, Deserialize)]
#[allow(missing_docs, reason = "a field is named after what it holds")]
pub struct AtdCase {
    pub exposure_stops: f64,
    /// Sources beyond the borders and at another depth left out.
    pub atd: BTreeMap<String, AtdValues>,
    /// Sources beyond the borders alone left out.
    pub atd_borders_only: BTreeMap<String, AtdValues>,
    /// Share of the pixels left out with depth, from the second frame on.
    pub left_out: Vec<f64>,
}

/// Differences over time of one sequence, from its second frame on.
#[derive(Debug, Clone, Deserialize)]
#[allow(missing_docs, reason = "a field is named after what it holds")]
pub struct AtdValues {
    pub mean: f64,
    pub frames: Vec<f64>,
}

/// The cases of `golden.json` in a folder.
///
/// # Panics
/// When it is not there, or not what it should be.
pub fn cases(folder: &Path) -> Vec<Case> {
    values(folder, "golden.json")
}

/// `atd.json` in a folder.
///
/// # Panics
/// When it is not there, or not what it should be.
pub fn atd(folder: &Path) -> AtdCase {
    values(folder, "atd.json")
}

fn values<T: DeserializeOwned>(folder: &Path, file: &str) -> T {
    let text = fs::read_to_string(folder.join(file)).expect("a file of golden values");
    serde_json::from_str(&text).expect("golden values in their form")
}
