//! Golden values of FovVideoVDP, and the frames they are of.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use fovqa_frame::{Channels, Crop, Frame, Samples};
use serde::Deserialize;
use serde_json::Value;

use crate::npy::{Array, Values};

/// `golden.json`.
#[derive(Debug, Clone, Deserialize)]
#[allow(missing_docs, reason = "a field is named after what it holds")]
pub struct Golden {
    pub cases: Vec<FvvdpCase>,
    /// Values of single steps, by their names.
    pub stages: BTreeMap<String, Value>,
    #[serde(skip)]
    folder: PathBuf,
}

/// A pair of pictures or sequences with its values.
#[derive(Debug, Clone, Deserialize)]
#[allow(missing_docs, reason = "a field is named after what it holds")]
#[allow(clippy::struct_excessive_bools, reason = "the file has them")]
pub struct FvvdpCase {
    pub id: String,
    pub dims: String,
    pub display: String,
    #[serde(default)]
    pub foveated: bool,
    pub jod: f64,
    pub ppd: f64,
    pub width: usize,
    pub height: usize,
    pub n_frames: usize,
    pub rho_band: Vec<f64>,
    /// Band by band, channel by channel, frame by frame.
    #[serde(rename = "Q_per_ch")]
    pub q_per_ch: Vec<Vec<Vec<f64>>>,
    #[serde(default)]
    pub pu_psnr_db: Option<f64>,
    #[serde(default)]
    pub fixation: Option<Fixation>,
    #[serde(default)]
    pub fps: Option<f64>,
    #[serde(default)]
    pub temp_padding: Option<String>,
    #[serde(default)]
    pub photometry: Option<Value>,
    #[serde(default)]
    pub geometry: Option<Value>,
    #[serde(default)]
    pub color_space: Option<String>,
    #[serde(default)]
    pub heatmap_file: Option<String>,
    test_file: String,
    ref_file: String,
    #[serde(default)]
    crop: Option<[usize; 4]>,
    #[serde(default)]
    invert: bool,
    #[serde(default)]
    to16: bool,
    #[serde(default)]
    scale255: bool,
    #[serde(default)]
    frames: Option<usize>,
}

/// Pixels looked at, their corners rather than their centres.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
#[allow(missing_docs, reason = "one point, or one a frame")]
pub enum Fixation {
    Fixed([f64; 2]),
    Trace(Vec<[f64; 2]>),
}

impl FvvdpCase {
    /// The gaze of a frame, in pixels with centres at +0.5.
    pub fn gaze_px(&self, frame: usize) -> [f64; 2] {
        let pixel = match &self.fixation {
            None => [self.width / 2, self.height / 2].map(|half| half as f64),
            Some(Fixation::Fixed(pixel)) => *pixel,
            Some(Fixation::Trace(pixels)) => pixels[frame],
        };
        pixel.map(|at| at + 0.5)
    }
}

impl Golden {
    /// Those of a folder.
    ///
    /// # Panics
    /// When they are not there, or not what they should be.
    pub fn read(folder: &Path) -> Self {
        let text = fs::read_to_string(folder.join("golden.json")).expect("golden values");
        let golden: Self = serde_json::from_str(&text).expect("golden values in their form");
        Self { folder: folder.to_owned(), ..golden }
    }

    /// A file of theirs.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// An array of theirs.
    ///
    /// # Panics
    /// When it is not there.
    pub fn array(&self, name: &str) -> Array {
        Array::read(&self.file(name))
    }

    /// Interleaved 8-bit codes of an RGB picture of theirs.
    ///
    /// # Panics
    /// When it is not there.
    pub fn codes(&self, name: &str) -> Vec<u8> {
        image::open(self.file(name)).expect("a picture").into_rgb8().into_raw()
    }

    /// The frames of a case: reference and test.
    ///
    /// # Panics
    /// When they are not there.
    pub fn frames(&self, case: &FvvdpCase) -> [Vec<Frame>; 2] {
        let reference = self.sequence(case, &case.ref_file);
        let test = if case.invert {
            reference.iter().map(inverted).collect()
        } else {
            self.sequence(case, &case.test_file)
        };
        [reference, test]
    }

    fn sequence(&self, case: &FvvdpCase, file: &str) -> Vec<Frame> {
        let (mut shape, mut values) =
            if Path::new(file).extension().is_some_and(|ending| ending == "npy") {
                let array = self.array(file);
                (array.shape, array.values)
            } else {
                let image = image::open(self.file(file)).expect("a picture");
                let (width, height) = (image.width() as usize, image.height() as usize);
                match image {
                    image::DynamicImage::ImageLuma8(image) => {
                        (vec![height, width], Values::U8(image.into_raw()))
                    }
                    other => (vec![height, width, 3], Values::U8(other.into_rgb8().into_raw())),
                }
            };
        if !case.dims.starts_with('F') {
            shape.insert(0, 1);
        }
        if case.dims.ends_with('W') {
            shape.push(1);
        }
        let [frames, height, width, channels] = shape[..] else { panic!("{file}: {shape:?}") };
        if case.to16 {
            let Values::U8(codes) = &values else { panic!("{file}: 8 bits") };
            values = Values::U16(codes.iter().map(|code| u16::from(*code) * 257).collect());
        }
        if case.scale255 {
            let Values::U8(codes) = &values else { panic!("{file}: 8 bits") };
            values = Values::F32(codes.iter().map(|code| f32::from(*code) / 255.0).collect());
        }
        let size = width * height * channels;
        (0..frames.min(case.frames.unwrap_or(frames)))
            .map(|index| {
                let part = index * size..(index + 1) * size;
                let samples = match &values {
                    Values::U8(codes) => Samples::U8(codes[part].to_vec().into()),
                    Values::U16(codes) => Samples::U16(codes[part].to_vec().into()),
                    Values::F32(values) => Samples::F32(planes(&values[part], channels).into()),
                    Values::F16(_) => panic!("{file}: half floats"),
                };
                let kind = if channels == 1 { Channels::Gray } else { Channels::Rgb };
                let frame = Frame::new(width, height, kind, samples).expect("a frame");
                match case.crop {
                    Some([x, y, width, height]) => {
                        frame.cropped(Crop { x, y, width, height }).expect("a crop of it")
                    }
                    None => frame,
                }
            })
            .collect()
    }
}

/// Planes out of interleaved values.
fn planes(values: &[f32], channels: usize) -> Vec<f32> {
    let plane = |c: usize| values.iter().skip(c).step_by(channels).copied();
    (0..channels).flat_map(plane).collect()
}

fn inverted(frame: &Frame) -> Frame {
    let Samples::U8(codes) = frame.samples() else { panic!("8 bits") };
    let codes = codes.iter().map(|code| 255 - code).collect();
    let (width, height) = frame.file_size();
    Frame::new(width, height, frame.channels(), Samples::U8(codes)).expect("a frame")
}
