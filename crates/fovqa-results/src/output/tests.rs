use std::path::Path;

use super::*;

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_file_is_replaced_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    write_whole(&path, b"one").unwrap();
    write_whole(&path, b"two").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"two");
    assert_eq!(names(folder.path()), ["a.txt"], "nothing temporary is left");
    let failed = write_whole_with(&path, |out| {
        out.write_all(b"half")?;
        Err(io::Error::other("no room"))
    });
    assert!(failed.unwrap_err().to_string().ends_with("a.txt: it cannot be written: no room"));
    let blocked = folder.path().join("b");
    fs::create_dir(&blocked).unwrap();
    fs::write(blocked.join("c"), b"").unwrap();
    assert!(write_whole(&blocked, b"x").is_err());
    assert_eq!(names(folder.path()), ["a.txt", "b"]);
    assert_eq!(fs::read(&path).unwrap(), b"two");
    assert!(replaces(&path) && !replaces(&folder.path().join("c")));
}

#[test]
fn the_folder_of_several_files_is_flushed_once() {
    let folder = tempfile::tempdir().unwrap();
    let batch = Batch::default();
    let waiting = || batch.folders.lock().unwrap().len();
    for name in ["a", "b"] {
        batch.write(&folder.path().join(name), b"x").unwrap();
    }
    assert_eq!(waiting(), 1);
    batch.write_json(&folder.path().join("c"), &1).unwrap();
    assert!(batch.write(&folder.path().join("no/d"), b"").is_err());
    batch.flush();
    assert_eq!((waiting(), names(folder.path())), (0, vec!["a".into(), "b".into(), "c".into()]));
}

/// The name has the maximum length, so the temporary file beside it cannot have a longer one.
#[test]
fn a_name_may_be_as_long_as_any() {
    let folder = tempfile::tempdir().unwrap();
    write_whole(&folder.path().join("n".repeat(255)), b"").unwrap();
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    use std::process::Command;

    use super::*;

    #[test]
    fn links_are_followed_and_stay() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir_all(at("real/deep")).unwrap();
        fs::write(at("real/old"), "old").unwrap();
        symlink("real/old", at("first")).unwrap();
        symlink(at("first"), at("second")).unwrap();
        symlink("real/new", at("dangling")).unwrap();
        // If the folder is a link, `..` leads to another place than the path suggests.
        symlink("real/deep", at("folder")).unwrap();
        symlink("folder/../up", at("through")).unwrap();
        // An open file keeps its number, so that no other file gets it.
        let before = fs::File::open(at("real/old")).unwrap();
        for (link, file) in [
            ("first", "real/old"),
            ("second", "real/old"),
            ("dangling", "real/new"),
            ("through", "real/up"),
        ] {
            assert_eq!(replaces(&at(link)), file == "real/old");
            write_whole(&at(link), link.as_bytes()).unwrap();
            assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink(), "{link}");
            assert!(fs::symlink_metadata(at(file)).unwrap().is_file(), "{link}");
            assert_eq!(fs::read_to_string(at(file)).unwrap(), link);
        }
        let before = before.metadata().unwrap().ino();
        assert_ne!(fs::metadata(at("real/old")).unwrap().ino(), before, "replaced, not changed");
        assert_eq!(names(&at("real")), ["deep", "new", "old", "up"]);
        take_away(&at("second")).unwrap();
        take_away(&at("second")).unwrap();
        assert!(!at("real/old").exists() && fs::symlink_metadata(at("second")).is_ok());
        symlink("loop", at("loop")).unwrap();
        let error = write_whole(&at("loop"), b"").unwrap_err().to_string();
        assert!(error.contains("loop: it cannot be written: too many symbolic links"), "{error}");
        symlink("real/made", at("to-folder")).unwrap();
        make_folder(&at("to-folder")).unwrap();
        make_folder(&at("to-folder")).unwrap();
        assert!(at("real/made").is_dir());
    }

    #[test]
    fn a_file_has_the_mode_of_any_other() {
        let folder = tempfile::tempdir().unwrap();
        let [plain, written] = ["plain", "written"].map(|name| folder.path().join(name));
        fs::write(&plain, "").unwrap();
        write_whole(&written, b"").unwrap();
        let mode = |path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(written), mode(plain));
    }

    #[test]
    fn devices_and_pipes_are_written_to() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read(pipe).unwrap()
        });
        write_output(&pipe, b"through").unwrap();
        assert_eq!(reader.join().unwrap(), b"through");
        assert_eq!(names(folder.path()), ["pipe"]);
        let null = folder.path().join("null");
        symlink("/dev/null", &null).unwrap();
        write_output(&null, b"x").unwrap();
        assert!(fs::symlink_metadata(&null).unwrap().is_symlink());
        assert!(!replaces(&null) && fs::metadata("/dev/null").unwrap().len() == 0);
        // Writing a file of a run never waits for a reader, and never replaces a device elsewhere.
        for name in ["pipe", "null"] {
            write_whole(&folder.path().join(name), b"ours").unwrap();
            assert_eq!(fs::read(folder.path().join(name)).unwrap(), b"ours");
        }
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_device_is_an_error() {
        let error = write_output(Path::new("/dev/full"), b"x").unwrap_err().to_string();
        assert!(error.starts_with("/dev/full: it cannot be written: No space left"), "{error}");
    }

    /// If a process has the file open, new data is written after the existing data.
    #[cfg(target_os = "linux")]
    #[test]
    fn an_open_file_is_appended_to() {
        use std::os::fd::AsRawFd;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("open");
        fs::write(&path, "one ").unwrap();
        let file = fs::File::open(&path).unwrap();
        let before = fs::metadata(&path).unwrap().ino();
        write_output(Path::new(&format!("/dev/fd/{}", file.as_raw_fd())), b"two").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "one two");
        assert_eq!(fs::metadata(&path).unwrap().ino(), before);
    }
}
