//! The files a run has read, each taken down once.

use std::collections::BTreeMap;

use fovqa_io::FileId;
use fovqa_results::Input;

/// Inputs by path.
#[derive(Debug, Default)]
pub(crate) struct Inputs(BTreeMap<String, FileId>);

impl Inputs {
    /// Takes a file down; the input, if it is a new one.
    pub(crate) fn add(&mut self, path: &str, id: &FileId) -> Option<Input> {
        if self.0.contains_key(path) {
            return None;
        }
        self.0.insert(path.to_owned(), id.clone());
        Some(input((path.to_owned(), id.clone())))
    }

    /// All of them, by path.
    pub(crate) fn all(self) -> Vec<Input> {
        self.0.into_iter().map(input).collect()
    }
}

fn input((path, FileId { bytes, sha256 }): (String, FileId)) -> Input {
    Input { path, bytes, sha256 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_taken_down_once() {
        let id = FileId { bytes: 1, sha256: "0".to_owned() };
        let mut inputs = Inputs::default();
        assert!(inputs.add("b", &id).is_some() && inputs.add("a", &id).is_some());
        assert!(inputs.add("b", &id).is_none());
        let paths: Vec<String> = inputs.all().into_iter().map(|input| input.path).collect();
        assert_eq!(paths, ["a", "b"]);
    }
}
