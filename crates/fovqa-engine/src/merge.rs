//! Merges the shards of a run. The merged findings are those of the whole run.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use fovqa_plan::Plan;
use thiserror::Error;

use crate::findings::{Findings, ViewFindings};
use crate::journal::{self, Content, Header, Said, Shared, Text};
use crate::share::Shard;

/// Why shards cannot be merged.
#[derive(Debug, Error)]
pub enum MergeError {
    /// A folder without the journal of a shard.
    #[error("{}: the folder contains no shard of a run", .0.display())]
    NoShard(PathBuf),
    /// A folder with the journal of a whole run.
    #[error("{}: the folder contains a complete run, not a shard", .0.display())]
    Whole(PathBuf),
    /// A journal that cannot be read.
    #[error("{}: the journal cannot be read: {error}", path.display())]
    Io {
        /// The folder.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// A journal with another version of the format.
    #[error("{}: another version of fovqa wrote this shard, in format {format}", path.display())]
    Format {
        /// The folder.
        path: PathBuf,
        /// The name of the format.
        format: String,
    },
    /// A journal with a line that was changed after it was written.
    #[error("{}:{line}: this line of the journal was changed or damaged", path.join(journal::JOURNAL).display())]
    Changed {
        /// The folder.
        path: PathBuf,
        /// Number of the line, counted from 1.
        line: usize,
    },
    /// Two shards that viewed a scene under different conditions.
    #[error("{} and {} have different {what} in scene {scene}", first.display(), second.display())]
    Disagree {
        /// A folder.
        first: PathBuf,
        /// Another one.
        second: PathBuf,
        /// Name of the scene.
        scene: String,
        /// In what they differ.
        what: &'static str,
    },
    /// A shard that is not finished.
    #[error("{}: shard {shard} is not finished", path.display())]
    Unfinished {
        /// The folder.
        path: PathBuf,
        /// The unfinished shard.
        shard: Shard,
    },
    /// Two shards that do not belong to the same run.
    #[error("{} and {} belong to different runs: {what}", first.display(), second.display())]
    Differ {
        /// A folder.
        first: PathBuf,
        /// Another one.
        second: PathBuf,
        /// What differs.
        what: String,
    },
    /// Shards that were written by another version of fovqa.
    #[error("{}: fovqa {version} wrote this shard, but this is fovqa {}", path.display(), env!("CARGO_PKG_VERSION"))]
    Version {
        /// A folder.
        path: PathBuf,
        /// The version that wrote it.
        version: String,
    },
    /// The same shard twice.
    #[error("shard {shard} was given twice: {} and {}", first.display(), second.display())]
    Twice {
        /// The repeated shard.
        shard: Shard,
        /// A folder.
        first: PathBuf,
        /// The other one.
        second: PathBuf,
    },
    /// Some shards are missing.
    #[error("{} missing: {}", if missing.len() == 1 { "a shard is" } else { "shards are" }, listed(missing, *of))]
    Missing {
        /// Indices of the missing shards.
        missing: Vec<u32>,
        /// Number of shards of the run.
        of: u32,
    },
    /// A file that was not the same for all shards.
    #[error("{}: {file} differs from the file that another shard used", path.display())]
    Input {
        /// The file.
        file: String,
        /// A folder whose shard read a different file than an earlier one.
        path: PathBuf,
    },
}

fn listed(missing: &[u32], of: u32) -> String {
    const SHOWN: usize = 10;
    let mut names: Vec<String> =
        missing.iter().take(SHOWN).map(|index| format!("{index}/{of}")).collect();
    if missing.len() > SHOWN {
        names.push(format!("{} more", missing.len() - SHOWN));
    }
    names.join(", ")
}

impl MergeError {
    /// How to correct the error.
    pub fn help(&self) -> &'static str {
        match self {
            Self::NoShard(_) | Self::Io { .. } => {
                "give the folders that `fovqa run --shard` wrote to"
            }
            Self::Whole(_) => "a complete run needs no merging; `fovqa report` draws it again",
            Self::Unfinished { .. } => "continue it with `fovqa run --shard I/N --resume`",
            Self::Differ { .. } | Self::Version { .. } | Self::Format { .. } => {
                "score all shards with the same version, the same experiment file and the same --frames"
            }
            Self::Changed { .. } => {
                "copy it again from the machine that wrote it, or score the shard again"
            }
            Self::Disagree { .. } => "score both shards again",
            Self::Twice { .. } => "give each shard once",
            Self::Missing { .. } => "score them, and give their folders too",
            Self::Input { .. } => "score all shards with the same files",
        }
    }
}

/// All shards of a run.
pub struct Shards {
    header: Header,
    /// The folder of each shard, in order. Their journals are read one after another when they are needed.
    folders: BTreeMap<Shard, PathBuf>,
}

impl Shards {
    /// Reads the first lines of the shards in some folders. Each shard of one run must be there exactly
    /// once.
    ///
    /// # Errors
    /// If that is not the case.
    pub fn read(folders: &[PathBuf]) -> Result<Self, MergeError> {
        let mut first: Option<Header> = None;
        let mut shards: BTreeMap<Shard, PathBuf> = BTreeMap::new();
        for path in folders {
            let header = text(path)?.header;
            let Some(shard) = header.shard else {
                return Err(MergeError::Whole(path.clone()));
            };
            match &mut first {
                None => first = Some(header),
                Some(first) => {
                    if let Some(what) = difference(first, &header) {
                        let (first, second) = (folders[0].clone(), path.clone());
                        return Err(MergeError::Differ { first, second, what });
                    }
                    // The maps of a run are in one folder, or the run has none.
                    first.maps =
                        first.maps.take().filter(|maps| Some(maps) == header.maps.as_ref());
                }
            }
            if let Some(first) = shards.insert(shard, path.clone()) {
                return Err(MergeError::Twice { shard, first, second: path.clone() });
            }
        }
        let Some((of, first)) = first.and_then(|first| Some((first.shard?.of(), first))) else {
            return Err(MergeError::Missing { missing: vec![1], of: 1 });
        };
        let there: BTreeSet<u32> = shards.keys().map(|shard| shard.index()).collect();
        let missing: Vec<u32> = (1..=of).filter(|index| !there.contains(index)).collect();
        if !missing.is_empty() {
            return Err(MergeError::Missing { missing, of });
        }
        Ok(Self { header: first.of_all(), folders: shards })
    }

    /// The header of the whole run.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The folders of the shards, in order.
    pub fn folders(&self) -> impl Iterator<Item = (Shard, &Path)> {
        self.folders.iter().map(|(shard, folder)| (*shard, folder.as_path()))
    }

    /// The findings of all shards. `plan` must be the plan of their experiment. `changed` is called with
    /// each shard whose values are not all values of the run: after a frame of another shard that could not be
    /// read, FovVideoVDP has none.
    ///
    /// # Errors
    /// If a shard is not finished, or a file was not the same for all shards.
    pub fn findings(
        &self,
        plan: &Plan,
        changed: &mut dyn FnMut(Shard),
    ) -> Result<Findings, MergeError> {
        let (mut all, mut shared) = (Findings::default(), Shared::default());
        for (shard, path) in self.folders() {
            let text = text(path)?;
            let said = said(path, &text, plan, &mut shared)?;
            if let Some(line) = said.changed {
                return Err(MergeError::Changed { path: path.to_owned(), line });
            }
            if !said.done || said.torn || !is_complete(plan, &text, &said.findings) {
                return Err(MergeError::Unfinished { path: path.to_owned(), shard });
            }
            let other = |file: String| MergeError::Input { file, path: path.to_owned() };
            if let Some(file) = said.twice {
                return Err(other(file));
            }
            let mut findings = said.findings;
            for (file, id) in findings.inputs.iter() {
                if all.inputs.get(file).is_some_and(|known| known != id) {
                    return Err(other(file.to_string()));
                }
            }
            self.agree(plan, &all, path, &findings)?;
            if all.break_off(&mut findings, &mut shared.values) {
                changed(shard);
            }
            all.join(findings);
        }
        Ok(all)
    }

    /// The findings about a shard among those of all shards.
    pub fn part(&self, plan: &Plan, all: &Findings, shard: Shard) -> Findings {
        let units = self.header.of_shard(shard).units_with_ends(plan);
        all.of_units(&units)
    }

    /// Refuses a shard that viewed a scene under other conditions than earlier shards.
    fn agree(
        &self,
        plan: &Plan,
        all: &Findings,
        path: &Path,
        other: &Findings,
    ) -> Result<(), MergeError> {
        for (place, found) in &other.views {
            let settled = |view: &ViewFindings| view.settled.as_ref()?.view.clone();
            let before = all.views.get(place).and_then(settled);
            let what = match (before, settled(found)) {
                (Some(one), Some(other)) if one.bands_deg != other.bands_deg => {
                    "eccentricity bands"
                }
                (Some(one), Some(other)) if one.size != other.size => "frame sizes",
                (Some(one), Some(other))
                    if (one.focal_px, one.eccentricity) != (other.focal_px, other.eccentricity) =>
                {
                    "views"
                }
                _ => continue,
            };
            let has_it = |folder: &&PathBuf| {
                let said =
                    text(folder).and_then(|text| said(folder, &text, plan, &mut Shared::default()));
                said.is_ok_and(|said| said.findings.views.get(place).and_then(settled).is_some())
            };
            let first = self.folders.values().find(has_it);
            let first = first.map_or_else(|| path.to_owned(), Clone::clone);
            let scene = plan.scenes[place.0].name.clone();
            return Err(MergeError::Disagree { first, second: path.to_owned(), scene, what });
        }
        Ok(())
    }
}

/// Reads the rest of a journal.
fn said(path: &Path, text: &Text, plan: &Plan, shared: &mut Shared) -> Result<Said, MergeError> {
    text.said(plan, shared).map_err(|error| MergeError::Io { path: path.to_owned(), error })
}

fn text(path: &Path) -> Result<Text, MergeError> {
    let none = || MergeError::NoShard(path.to_owned());
    let text = match journal::read(path) {
        Ok(Content::Journal(text)) => *text,
        Ok(Content::Nothing | Content::Other) => return Err(none()),
        Ok(Content::OtherFormat(format)) => {
            return Err(MergeError::Format { path: path.to_owned(), format });
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotADirectory => return Err(none()),
        Err(error) => return Err(MergeError::Io { path: path.to_owned(), error }),
    };
    if text.header.version != env!("CARGO_PKG_VERSION") {
        let version = text.header.version;
        return Err(MergeError::Version { path: path.to_owned(), version });
    }
    Ok(text)
}

/// The difference that prevents two shards from belonging to the same run.
fn difference(one: &Header, other: &Header) -> Option<String> {
    let frames = |header: &Header| header.frames.clone().unwrap_or_else(|| "all".to_owned());
    let of = |header: &Header| header.shard.map_or(0, Shard::of);
    let differ = |what: &str, one: &str, other: &str| Some(format!("{what} {one} and {other}"));
    if one.version != other.version {
        differ("versions", &one.version, &other.version)
    } else if one.experiment_sha256 != other.experiment_sha256 {
        Some("their experiments differ".to_owned())
    } else if one.experiment_file != other.experiment_file {
        differ("experiment files", &one.experiment_file, &other.experiment_file)
    } else if one.frames != other.frames {
        differ("frames", &frames(one), &frames(other))
    } else if of(one) != of(other) {
        differ("shard counts", &of(one).to_string(), &of(other).to_string())
    } else if one.views != other.views {
        Some("they found different files or different bands".to_owned())
    } else {
        None
    }
}

/// Whether a shard contains all of its pairs.
fn is_complete(plan: &Plan, text: &Text, findings: &Findings) -> bool {
    let units = text.header.units(plan);
    let own = text.shares.iter().filter(|share| !share.is_empty()).count();
    own == units.len() && units.iter().all(|unit| findings.has_all_of(unit))
}
