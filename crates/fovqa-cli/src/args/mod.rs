//! The command line as it is declared to clap.

mod baseline;
mod curves;
mod display;
mod foveate;
mod gallery;
mod gate;
mod guides;
mod limit;
mod lock;
mod luminance;
mod metrics;
mod no_such;
mod offered;
mod right_eye;
mod run;
mod score;
mod signal;
mod study;
mod values;
mod view;

pub(crate) use baseline::{AcceptArgs, BaselineCommand, SaveArgs};
pub(crate) use curves::CurvesArgs;
pub(crate) use foveate::{FoveateArgs, FoveateFormat};
pub(crate) use gallery::GalleryArgs;
pub(crate) use gate::{Annotations, GateArgs, GateFormat};
pub(crate) use limit::LimitArgs;
pub(crate) use run::{CheckArgs, MergeArgs, ReportArgs, RunArgs};
pub(crate) use score::{Format, ScoreArgs};
pub(crate) use study::{Asked, InputArgs, SettingsArgs, StudyArgs, StudyCommand, StudyFormat};

use clap::{Parser, Subcommand, ValueEnum};

/// Score foveated renders against ground truth, by eccentricity.
#[derive(Debug, Parser)]
#[command(
    name = "fovqa",
    bin_name = "fovqa",
    version,
    max_term_width = 100,
    subcommand_required = true,
    arg_required_else_help = true
)]
#[command(
    after_help = "Exit codes: 0 done, and every gate holds; 1 a gate fails; 2 the command line or the experiment file\n\
is wrong; 3 an input is missing, unreadable or does not fit, or the output cannot be written; 70 a bug\n\
in fovqa; 130 interrupted."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Score test frames against reference frames.
    #[command(after_help = score::EXAMPLES)]
    Score(Box<ScoreArgs>),
    /// Write a built-in scene as files: frames with motion and depth, gaze and camera.
    #[command(after_help = gallery::EXAMPLES)]
    Gallery(Box<GalleryArgs>),
    /// Run an experiment: scenes, methods and metrics of a TOML file, with tables and figures.
    #[command(after_help = run::EXAMPLES)]
    Run(RunArgs),
    /// Check the [[gate]] rules of an experiment against its results; exit code 0 (pass) or 1 (fail).
    #[command(after_help = gate::EXAMPLES)]
    Gate(Box<GateArgs>),
    /// Find how far methods can foveate: the smallest budget at which each [[gate]] rule still holds.
    #[command(after_help = limit::EXAMPLES)]
    Limit(Box<LimitArgs>),
    /// Save, show and update the baseline that a gate compares with.
    #[command(subcommand, after_help = baseline::EXAMPLES)]
    Baseline(BaselineCommand),
    /// Join the shards of a run; the result is the same as that of a single run.
    #[command(after_help = run::MERGE_EXAMPLES)]
    Merge(MergeArgs),
    /// Draw the tables, figures and page of a run again, without scoring, or an overview page of several runs.
    Report(ReportArgs),
    /// Check an experiment file and print its plan and the frames found; pixels are read with --previews only.
    Check(CheckArgs),
    /// Print the JSON Schema of a file, for editors.
    Schema {
        /// The file that the schema describes.
        #[arg(default_value = "experiment")]
        what: SchemaOf,
    },
    /// Compare the shading rate of foveation methods with acuity: one curve as CSV, or figures and tables.
    #[command(after_help = curves::EXAMPLES)]
    Curves(Box<CurvesArgs>),
    /// Show what a foveation method would have shown of finished frames, and write it to files.
    #[command(after_help = foveate::EXAMPLES)]
    Foveate(Box<FoveateArgs>),
    /// Statistics of user studies: pairwise comparisons, ranks, ANOVA, thresholds, ratings.
    #[command(after_help = study::EXAMPLES)]
    Study(Box<StudyArgs>),
    /// List metrics, foveation methods and acuity models, or display presets.
    List {
        /// What to list.
        what: Listed,
    },
    /// Print a completion script for a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

/// What a schema is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaOf {
    /// The experiment file of `fovqa run`.
    Experiment,
    /// The curve file of `fovqa curves`.
    Curves,
    /// The study file of `fovqa study`.
    Study,
}

/// What can be listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Listed {
    /// Metrics, their parameters, defaults, units and sources.
    Metrics,
    /// Foveation methods, their filters, and acuity models: parameters, defaults, units and sources.
    Methods,
    /// Display presets.
    Displays,
}
