//! The files that a run has read, each recorded once.

use std::collections::BTreeMap;

use fovqa_frame::source::{InputId, Origin};
use fovqa_io::id_of_file;
use fovqa_plan::Plan;
use fovqa_results::Input;
use rayon::prelude::*;

/// Inputs by path.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Inputs(BTreeMap<String, InputId>);

impl Inputs {
    /// Records a file. Returns the input if it is new.
    pub(crate) fn add(&mut self, path: &str, id: &InputId) -> Option<Input> {
        if self.0.contains_key(path) {
            return None;
        }
        self.0.insert(path.to_owned(), id.clone());
        Some(input((path, id)))
    }

    /// The identity of a file.
    pub(crate) fn get(&self, path: &str) -> Option<&InputId> {
        self.0.get(path)
    }

    /// All files with their identities, ordered by path.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &InputId)> {
        self.0.iter().map(|(path, id)| (path.as_str(), id))
    }

    /// All files as inputs, ordered by path.
    pub(crate) fn all(&self) -> Vec<Input> {
        self.0.iter().map(|(path, id)| input((path.as_str(), id))).collect()
    }

    /// All files as inputs, ordered by path, without copies: a long sequence has many.
    pub(crate) fn into_all(self) -> Vec<Input> {
        let input = |(path, InputId { bytes, sha256 })| Input { path, bytes, sha256 };
        self.0.into_iter().map(input).collect()
    }

    /// Describes what has changed, by name. `known` contains the files that the names stand for;
    /// names that are not UTF-8 do not identify a file by themselves.
    pub(crate) fn changes(&self, plan: &Plan, known: &BTreeMap<String, Origin>) -> Vec<String> {
        let files: Vec<(&String, &InputId)> = self.0.iter().collect();
        let change = |(shown, id): &(&String, &InputId)| {
            let path = match known.get(*shown) {
                Some(Origin::File(path)) => path.clone(),
                Some(Origin::Made(now)) if now == *id => return None,
                Some(Origin::Made(_)) => return Some(format!("{shown} has changed")),
                None => plan.base.join(shown),
            };
            match std::fs::metadata(&path) {
                Err(_) => return Some(format!("{shown} no longer exists")),
                Ok(file) if file.is_file() && file.len() == id.bytes => {}
                Ok(_) => return Some(format!("{shown} has changed")),
            }
            match id_of_file(&path) {
                Ok(now) if now == **id => None,
                Ok(_) => Some(format!("{shown} has changed")),
                Err(error) => Some(format!("{shown} can no longer be read: {error}")),
            }
        };
        files.par_iter().filter_map(change).collect()
    }
}

fn input((path, id): (&str, &InputId)) -> Input {
    Input { path: path.to_owned(), bytes: id.bytes, sha256: id.sha256.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_recorder_once() {
        let id = InputId { bytes: 1, sha256: "0".to_owned() };
        let mut inputs = Inputs::default();
        assert!(inputs.add("b", &id).is_some() && inputs.add("a", &id).is_some());
        assert!(inputs.add("b", &id).is_none());
        let paths: Vec<String> = inputs.all().into_iter().map(|input| input.path).collect();
        assert_eq!(paths, ["a", "b"]);
        assert_eq!(inputs.clone().into_all(), inputs.all());
    }

    #[test]
    fn what_has_changed_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let plan = Plan { base: folder.path().to_owned(), ..Plan::default() };
        let mut inputs = Inputs::default();
        for (name, text) in [("same", "a"), ("longer", "a"), ("other", "a"), ("gone", "a")] {
            std::fs::write(folder.path().join(name), text).unwrap();
            inputs.add(name, &id_of_file(&folder.path().join(name)).unwrap());
        }
        assert!(inputs.changes(&plan, &BTreeMap::new()).is_empty());
        std::fs::write(folder.path().join("longer"), "aa").unwrap();
        std::fs::write(folder.path().join("other"), "b").unwrap();
        std::fs::remove_file(folder.path().join("gone")).unwrap();
        let wanted = ["gone no longer exists", "longer has changed", "other has changed"];
        assert_eq!(inputs.changes(&plan, &BTreeMap::new()), wanted);
    }
}
