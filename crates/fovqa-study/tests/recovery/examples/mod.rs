//! The simulated tables in `configs/studies/data`. `FOVQA_RECORD=1` writes them; otherwise the test
//! compares them with the committed files. Each participant has random numbers of their own.

mod choices;
mod conditions;
mod ratings;
mod shown;
mod staircases;

use std::path::PathBuf;

use fovqa_study::random::Replicate;

/// The names of participants, with their random numbers.
fn participants(count: u64, seed: u64) -> impl Iterator<Item = (String, Replicate)> {
    (0..count).map(move |index| (format!("P{:02}", index + 1), Replicate::new(seed, index)))
}

/// Puts values in a random order (Fisher and Yates).
fn shuffle<T>(values: &mut [T], random: &mut Replicate) {
    for last in (1..values.len()).rev() {
        values.swap(last, random.index(last + 1));
    }
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../configs/studies/data")
}

#[test]
fn the_committed_tables_are_the_simulated_ones() {
    let [mos, results] = conditions::tables();
    let files = [
        ("votes.csv", choices::votes()),
        ("ranking.csv", ratings::ranking()),
        ("slider.csv", ratings::slider()),
        ("staircases.csv", staircases::staircases()),
        ("scores.csv", ratings::scores()),
        ("grid.csv", ratings::grid()),
        ("mos.csv", mos),
        ("results.csv", results),
    ];
    let is_recorded = std::env::var_os("FOVQA_RECORD").is_some_and(|value| value == "1");
    for (name, table) in files {
        let path = folder().join(name);
        assert!(table.len() < 40_000, "{name} has {} bytes", table.len());
        if is_recorded {
            std::fs::create_dir_all(folder()).unwrap();
            std::fs::write(&path, &table).unwrap();
        }
        let committed = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            committed == table,
            "{name} is not what the observers answer; FOVQA_RECORD=1 writes it again"
        );
    }
}
