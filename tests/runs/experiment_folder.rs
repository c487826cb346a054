//! Experiments to run in the tests, and what they leave behind.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::Folder;

pub(crate) const HEAD: &str = "name = \"e\"\n[view]\nfov_vertical_deg = 60\n";

/// Two scenes of three frames, two methods in each.
pub(crate) fn two_scenes() -> Folder {
    let folder = Folder::new();
    for (seed, scene) in ["hall", "room"].into_iter().enumerate() {
        for frame in 0..3 {
            let reference = codes(48, 40, 3, (10 * seed + frame) as u64);
            folder.png(&format!("{scene}/gt/{frame:04}.png"), 48, 40, &reference);
            for (index, method) in ["a", "b"].into_iter().enumerate() {
                let noise = 20.0 + 15.0 * index as f64 + frame as f64;
                let test = disturbed(&reference, noise, 3);
                folder.png(&format!("{scene}/{method}/{frame:04}.png"), 48, 40, &test);
            }
        }
    }
    folder.write("e.toml", experiment("[metrics]\nmse = {}\npsnr = {}\nssim = {}\nfpsnr = {}\n"));
    folder
}

pub(crate) fn experiment(rest: &str) -> String {
    format!(
        "{HEAD}[[scene]]\nname = \"room\"\nreference = \"room/gt\"\n\
         [[scene]]\nname = \"hall\"\nreference = \"{{scene}}/gt\"\n\
         [[method]]\nname = \"A\"\ntest = \"{{scene}}/a\"\n\
         [[method]]\nname = \"B\"\ntest = \"{{scene}}/b\"\n{rest}"
    )
}

/// The rows of results.csv, cells by column.
pub(crate) fn rows(folder: &Folder, results: &str) -> Vec<BTreeMap<String, String>> {
    let path = folder.path(&format!("{results}/results.csv"));
    let mut reader = csv::Reader::from_path(path).unwrap();
    let headers = reader.headers().unwrap().clone();
    let cells = |record: csv::StringRecord| {
        headers.iter().zip(record.iter()).map(|(h, c)| (h.to_owned(), c.to_owned())).collect()
    };
    reader.records().map(|record| cells(record.unwrap())).collect()
}

pub(crate) fn json(folder: &Folder, file: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.path(file)).unwrap()).unwrap()
}

/// All files below a folder but the lock, with their bytes.
pub(crate) fn bytes(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            files.extend(bytes(&path).into_iter().map(|(k, v)| (format!("{name}/{k}"), v)));
        } else if name != ".fovqa.lock" {
            files.insert(name, fs::read(path).unwrap());
        }
    }
    files
}
