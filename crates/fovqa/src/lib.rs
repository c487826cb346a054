//! Scores foveated renders against ground truth by eccentricity. This crate offers the functions of the command
//! `fovqa` to programs.
//!
//! # A pair of images
//!
//! [`score`] compares two images in memory. The numbers are exactly those of `fovqa score`.
//!
//! ```
//! use fovqa::{Metric, ScoreOptions, Settings, ViewSpec, score};
//! use ndarray::Array3;
//!
//! // Height x width x channel, 8-bit codes. The test lacks detail in its left half.
//! let reference = Array3::from_shape_fn((64, 96, 3), |(y, x, c)| ((x * 7 + y * 5 + c * 11) % 256) as u8);
//! let mut test = reference.clone();
//! for ((_, x, _), code) in test.indexed_iter_mut() {
//!     if x < 48 {
//!         *code = *code / 16 * 16;
//!     }
//! }
//!
//! let view = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(60.0) };
//! let settings = Settings { view: Some(view), ..Settings::default() };
//! let scores = score(reference.view(), test.view(), &ScoreOptions { settings, ..ScoreOptions::default() })?;
//!
//! let psnr = scores.value(Metric::Psnr).expect("it is scored by default");
//! assert!((30.0..35.0).contains(&psnr), "{psnr} dB");
//! # Ok::<(), fovqa::Error>(())
//! ```
//!
//! # Experiments
//!
//! An experiment names scenes, methods and metrics. [`read_experiment`] reads one from a TOML file, and a program
//! can also build one itself ([`Experiment`], [`Plan`]). A [`Run`] finds its frames and scores them. It writes
//! results, tables and figures to a folder, as `fovqa run` does. [`gate`] checks the scores against the rules of
//! an experiment.
//!
//! ```no_run
//! use std::path::Path;
//! use fovqa::{Given, Run, RunOptions, Silent, read_experiment};
//!
//! let experiment = read_experiment(Path::new("first.toml"))?;
//! let run = Run::new(experiment, RunOptions::default(), &Given::default())?;
//! let finished = run.start(&Silent)?;
//! println!("{} frames, results in {}", finished.scored, finished.folder.display());
//! # Ok::<(), fovqa::Error>(())
//! ```
//!
//! # Frames from elsewhere
//!
//! Any type that implements [`Source`] is a sequence of frames. A plan names it ([`SourceSpec::Given`]), and the
//! program that runs the plan provides it ([`Given`]). [`open_source`] opens the source at a path. [`video_stream`]
//! makes a source from any reader of the bytes of a y4m video.
//!
//! # Work for other processes
//!
//! [`units`] splits a plan into parts that can be scored independently. A [`Task`] is one unit with its plan. It
//! can be written as JSON and run in any process that sees the same files. Its findings are written as text too,
//! and the findings of all tasks are merged again ([`TaskFindings::merge`], [`results`]).

mod baseline;
mod calibrate;
mod calibrated_rules;
mod crops;
mod curves;
mod dialect;
mod error;
mod events;
mod experiment;
mod finish;
mod finished_run;
mod foreseen_figures;
mod foveate;
mod gallery;
mod gate;
mod kept_frames;
mod limit;
mod map_sheets;
mod maps;
mod memory;
mod merge;
mod opinions;
mod pair;
mod pictures;
mod reopened;
mod repeats;
mod report;
mod run;
mod samples;
mod score;
mod study;
mod values;

pub use baseline::{Accepted, Frames, Saved, accept_baseline, read_baseline, save_baseline};
pub use calibrate::calibrate;
pub use calibrated_rules::write_limits;
pub use curves::curves;
pub use dialect::Dialect;
pub use error::{Complaint, Error};
pub use events::Silent;
pub use experiment::{
    parse_curves, parse_experiment, parse_study, read_curves, read_experiment, read_study,
};
pub use finish::text_hash;
pub use finished_run::FinishedRun;
pub use foreseen_figures::{check_curves, foresee_figures};
pub use foveate::{FoveateOutputs, Foveated, ShownFrame, foveate_files, foveate_frames};
pub use gallery::{GalleryRequest, write_gallery};
pub use gate::{Against, gate, gate_folder};
pub use limit::{FoundLimits, LimitOptions, find_limits};
pub use maps::maps_lacking;
pub use merge::{MergeOptions, merge};
pub use opinions::check_study_of;
pub use pair::{PairScores, ScoreMap, ScoreOptions, score};
pub use report::{Report, report};
pub use run::{Finished, Run, RunOptions, problems};
pub use samples::Sample;
pub use score::{Compared, PairMaps, TakeMaps, score_files, score_plan, score_two_eyes};
pub use study::{FinishedStudy, check_study, not_negated, read_table, study};

pub use fovqa_config::{ExperimentError, Fault};
pub use fovqa_emulate::{Budget, EmulationSpec, FilterChoice, Sampling, Space};
pub use fovqa_engine::{
    Events, FoundInputs, FoundView, Given, ItemDone, Locking, Shard, Task, TaskError, TaskFindings,
    Unit, find, foresee, preview, results, units,
};
pub use fovqa_frame::source::{Listing, Picture, Source, SourceError};
pub use fovqa_frame::{Crop, Frame, SignalChannels, SignalParams, ToneMap, Transfer};
pub use fovqa_gallery::{BuiltinSpec, SceneName};
pub use fovqa_io::{ReadOptions, SourceOptions, open_source, video_stream};
pub use fovqa_metrics::{Metric, ParamSet, ReadBackError};
pub use fovqa_params::ParamValue;
pub use fovqa_plan::{
    CurvesFile, Emulation, Experiment, Eye, EyeView, GateRule, Gaze, MetricChoice, Nonfinite, Plan,
    Scene, Settings, SourceSpec, StudyFile,
};
pub use fovqa_results::{
    Baseline, Calibration, FALSE_ALARMS, Failure, FoveateRecord, RunResults, ScoreReport,
    StereoReport, Verdict, write_csv, write_json, write_stereo_csv, write_stereo_json,
};
pub use fovqa_vision::{BandEdges, EccentricityKind, ViewSpec};
