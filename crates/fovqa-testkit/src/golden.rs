//! Golden values: what independent implementations found for the same pictures.

use std::fs;
use std::path::Path;

use serde::Deserialize;

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
}

/// The cases of `golden.json` in a folder.
///
/// # Panics
/// When it is not there, or not what it should be.
pub fn cases(folder: &Path) -> Vec<Case> {
    let text = fs::read_to_string(folder.join("golden.json")).expect("golden.json");
    serde_json::from_str(&text).expect("golden.json in its form")
}
