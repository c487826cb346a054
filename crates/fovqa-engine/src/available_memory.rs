//! How much memory this process can still get. Only Linux is asked; on other systems the amount is
//! unknown.

use std::fs;
use std::path::Path;

/// Bytes of free memory and swap space, limited by the control groups of this process. `None` if
/// nothing is known.
pub(crate) fn available_bytes() -> Option<u64> {
    let system = fs::read_to_string("/proc/meminfo").ok().and_then(|text| of_meminfo(&text));
    let groups = fs::read_to_string("/proc/self/cgroup").ok();
    let groups = groups.and_then(|text| of_groups(&text, Path::new("/sys/fs/cgroup")));
    [system, groups].into_iter().flatten().min()
}

/// The sum of `MemAvailable` and `SwapFree` in the text of /proc/meminfo, in bytes.
fn of_meminfo(text: &str) -> Option<u64> {
    let value = |key: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(key))?;
        let kilobytes: u64 = line.strip_suffix("kB")?.trim().parse().ok()?;
        Some(kilobytes * 1024)
    };
    Some(value("MemAvailable:")? + value("SwapFree:").unwrap_or(0))
}

/// The bytes that are left in the groups listed in /proc/self/cgroup and in their parent groups. Of
/// cgroup version 1, only the `memory` controller is read.
fn of_groups(text: &str, mounted: &Path) -> Option<u64> {
    let left = text.lines().filter_map(|line| {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, group) = (parts.next()?, parts.next()?.trim_start_matches('/'));
        let (root, files) = match controllers {
            "" => (mounted.to_owned(), ["memory.max", "memory.current", "inactive_file "]),
            _ if controllers.split(',').any(|name| name == "memory") => (
                mounted.join("memory"),
                ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file "],
            ),
            _ => return None,
        };
        let folder = root.join(group);
        let groups = folder.ancestors().take_while(|folder| folder.starts_with(&root));
        groups.filter_map(|folder| left_in(folder, files)).min()
    });
    left.min()
}

/// The limit of a group minus its usage. The system gives back pages of files that have not been
/// used lately, so they do not count as used.
fn left_in(folder: &Path, [limit, used, unused]: [&str; 3]) -> Option<u64> {
    let number =
        |file: &str| fs::read_to_string(folder.join(file)).ok()?.trim().parse::<u64>().ok();
    // If there is no limit, the file contains `max`, which is not a number.
    let (limit, used) = (number(limit)?, number(used)?);
    let statistics = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let unused = statistics.lines().find_map(|line| line.strip_prefix(unused)?.parse().ok());
    Some(limit.saturating_sub(used.saturating_sub(unused.unwrap_or(0))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_and_swap_space_of_the_system() {
        let text = "MemTotal:  16 kB\nMemAvailable:   8 kB\nSwapTotal: 9 kB\nSwapFree:  2 kB\n";
        assert_eq!(of_meminfo(text), Some(10 * 1024));
        assert_eq!(of_meminfo("MemAvailable: 8 kB\n"), Some(8 * 1024));
        assert_eq!(of_meminfo("MemTotal: 8 kB\n"), None);
    }

    #[test]
    fn the_tightest_group_counts() {
        let root = std::env::temp_dir().join(format!("fovqa-groups-{}", std::process::id()));
        let write = |group: &str, files: &[(&str, &str)]| {
            fs::create_dir_all(root.join(group)).unwrap();
            for (file, text) in files {
                fs::write(root.join(group).join(file), text).unwrap();
            }
        };
        write(
            "a",
            &[
                ("memory.max", "1000\n"),
                ("memory.current", "700\n"),
                ("memory.stat", "anon 5\ninactive_file 200\n"),
            ],
        );
        write("a/b", &[("memory.max", "max\n"), ("memory.current", "300\n")]);
        write(
            "memory/c",
            &[("memory.limit_in_bytes", "400\n"), ("memory.usage_in_bytes", "100\n")],
        );
        let found = [
            of_groups("0::/a/b\n", &root),
            of_groups("7:cpu,memory:/c\n3:cpu:/a\n", &root),
            of_groups("0::/none\n", &root),
        ];
        fs::remove_dir_all(&root).unwrap();
        assert_eq!(found, [Some(500), Some(300), None]);
    }
}
