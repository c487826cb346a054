//! Finds out which of the files that a run has read have changed since.

use std::collections::BTreeMap;
use std::sync::Arc;

use fovqa_frame::source::{InputId, Origin};
use fovqa_io::id_of_file;
use fovqa_plan::Plan;
use fovqa_results::{Identity, Inputs};
use rayon::prelude::*;

/// The identity of a file as results record it.
pub(crate) fn identity(id: &InputId) -> Identity {
    Identity::new(id.bytes, &id.sha256)
}

/// Describes what has changed, by name. `known` contains the files that the names stand for; names
/// that are not UTF-8 do not identify a file by themselves.
pub(crate) fn changed_inputs(
    inputs: &Inputs,
    plan: &Plan,
    known: &BTreeMap<String, Origin>,
) -> Vec<String> {
    let files: Vec<(&Arc<str>, &Identity)> = inputs.iter().collect();
    let change = |(shown, id): &(&Arc<str>, &Identity)| {
        let path = match known.get(&***shown) {
            Some(Origin::File(path)) => path.clone(),
            Some(Origin::Made(now)) if identity(now) == **id => return None,
            Some(Origin::Made(_)) => return Some(format!("{shown} has changed")),
            None => plan.base.join(&***shown),
        };
        match std::fs::metadata(&path) {
            Err(_) => return Some(format!("{shown} no longer exists")),
            Ok(file) if file.is_file() && file.len() == id.bytes() => {}
            Ok(_) => return Some(format!("{shown} has changed")),
        }
        match id_of_file(&path) {
            Ok(now) if identity(&now) == **id => None,
            Ok(_) => Some(format!("{shown} has changed")),
            Err(error) => Some(format!("{shown} can no longer be read: {error}")),
        }
    };
    files.par_iter().filter_map(change).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_changed_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let plan = Plan { base: folder.path().to_owned(), ..Plan::default() };
        let mut inputs = Inputs::default();
        for (name, text) in [("same", "a"), ("longer", "a"), ("other", "a"), ("gone", "a")] {
            std::fs::write(folder.path().join(name), text).unwrap();
            let id = id_of_file(&folder.path().join(name)).unwrap();
            inputs.add(name.into(), identity(&id));
        }
        assert!(changed_inputs(&inputs, &plan, &BTreeMap::new()).is_empty());
        std::fs::write(folder.path().join("longer"), "aa").unwrap();
        std::fs::write(folder.path().join("other"), "b").unwrap();
        std::fs::remove_file(folder.path().join("gone")).unwrap();
        let wanted = ["gone no longer exists", "longer has changed", "other has changed"];
        assert_eq!(changed_inputs(&inputs, &plan, &BTreeMap::new()), wanted);
    }
}
