//! What the targets share: which panics count, and bytes as a file.

use std::io::Write;
use std::os::fd::AsRawFd;
use std::path::Path;

/// Makes a panic abort, which is what the fuzzer sees, unless it becomes a file's error. Where a
/// mistake of ours is contained with those of the decoders, it is a finding all the same.
///
/// For the `init` of a target: it replaces the fuzzer's own hook, which aborts on every panic.
pub fn abort_on_escaping_panics() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        let ours = info.location().is_some_and(|place| place.file().contains("crates/fovqa-"));
        if ours || !fovqa_io::is_contained() {
            // The fuzzer's own: it says where, and aborts.
            report(info);
            std::process::abort();
        }
    }));
}

/// One worker, so that an input takes the same way each time. Not the thread of the fuzzer: what
/// holds on one thread alone shall be found.
pub fn decode_on_one_thread() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    pool.build_global().expect("the first pool");
}

/// Gives `read` the path of a file of these bytes. The file is in memory and has no name: nothing
/// is left behind by a target that crashes.
pub fn with_file<T>(bytes: &[u8], read: impl FnOnce(&Path) -> T) -> T {
    let mut file = tempfile::tempfile_in("/dev/shm").expect("room in memory");
    file.write_all(bytes).expect("room in memory");
    read(Path::new(&format!("/proc/self/fd/{}", file.as_raw_fd())))
}
