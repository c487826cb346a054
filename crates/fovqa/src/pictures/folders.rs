//! The folders of frames with pictures, and those of other frames between them.

use std::fs;
use std::io;
use std::path::Path;

use fovqa_results::{IMAGES, IMAGES_JSON, take_away};

use crate::kept_frames::copy;

/// Removes the pictures of an earlier run: their list, and the folders that have a record of a frame.
pub(crate) fn clear_pictures(results: &Path) {
    // What cannot be removed is replaced, or is not listed and does no harm.
    let _ = take_away(&results.join(IMAGES_JSON));
    keep_frames(results, &|_| false);
}

/// Removes the folders of frames except those for which `is_kept` holds. What somebody else put between
/// them stays.
pub(super) fn keep_frames(results: &Path, is_kept: &dyn Fn(&Path) -> bool) {
    let images = results.join(IMAGES);
    remove_frames(&images, &|path| !is_kept(path));
    // Only an empty folder can be removed this way.
    let _ = fs::remove_dir(&images);
}

/// Removes the folders of frames for which `is_old` holds, wherever they are below a folder.
fn remove_frames(folder: &Path, is_old: &dyn Fn(&Path) -> bool) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        // A link is not followed: what it leads to belongs to somebody else.
        if !entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            continue;
        }
        if path.join("frame.json").is_file() {
            if is_old(&path) {
                let _ = fs::remove_dir_all(&path);
            }
        } else {
            remove_frames(&path, is_old);
            let _ = fs::remove_dir(&path);
        }
    }
}

/// Copies the pictures that a shard has taken.
///
/// # Errors
/// If a file cannot be read or written.
pub(crate) fn copy_pictures(shard: &Path, results: &Path) -> io::Result<()> {
    copy(&shard.join(IMAGES), &results.join(IMAGES))
}
