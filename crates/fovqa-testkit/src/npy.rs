//! Arrays of NumPy's files.

use std::fs;
use std::path::Path;

use half::f16;
use npyz::{NpyFile, TypeStr};

/// The values of an array, the last axis fastest.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs, reason = "a variant is named after its type")]
pub enum Values {
    U8(Vec<u8>),
    U16(Vec<u16>),
    F16(Vec<f16>),
    F32(Vec<f32>),
}

/// An array.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Length along each axis.
    pub shape: Vec<usize>,
    /// Its values.
    pub values: Values,
}

impl Array {
    /// Reads a file.
    ///
    /// # Panics
    /// When it is not there, or of another type.
    pub fn read(path: &Path) -> Self {
        let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let file = NpyFile::new(bytes.as_slice()).expect("a NumPy file");
        assert_eq!(file.order(), npyz::Order::C, "{}", path.display());
        let shape = file.shape().iter().map(|side| *side as usize).collect();
        let types: TypeStr = match file.dtype() {
            npyz::DType::Plain(types) => types,
            other => panic!("{}: {other:?}", path.display()),
        };
        let values = match types.to_string().trim_start_matches(['<', '|']) {
            "u1" => Values::U8(file.into_vec().expect("its values")),
            "u2" => Values::U16(file.into_vec().expect("its values")),
            "f2" => Values::F16(file.into_vec().expect("its values")),
            "f4" => Values::F32(file.into_vec().expect("its values")),
            other => panic!("{}: {other}", path.display()),
        };
        Self { shape, values }
    }

    /// Its values as floats.
    pub fn floats(&self) -> Vec<f32> {
        match &self.values {
            Values::U8(values) => values.iter().map(|v| f32::from(*v)).collect(),
            Values::U16(values) => values.iter().map(|v| f32::from(*v)).collect(),
            Values::F16(values) => values.iter().map(|v| v.to_f32()).collect(),
            Values::F32(values) => values.clone(),
        }
    }
}
