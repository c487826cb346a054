//! Results as data: the findings of a run, its summary, JSON and tidy tables.

mod baseline;
mod both_eyes;
mod checksums;
mod compared;
mod crops;
mod csv_names;
mod curves;
mod files;
mod fvvdp;
mod gate;
mod inputs;
mod inputs_csv;
mod json;
mod limits;

mod output;
mod pictures;
mod report;
mod samples;
mod spread;
mod stereo;
mod summary;
mod table;
mod temporal;

pub use baseline::{
    BASELINE_SCHEMA, Baseline, BaselineComparison, Difference, FrameRecords, InputGroup,
    MetricRecord,
};
pub use both_eyes::both_eyes;
pub use checksums::{Checksums, check_files, checksums};
pub use compared::Sides;
pub use crops::{CROPS, CropRecord, crop_folder};
pub use csv_names::CsvNames;
pub use curves::{CurveRecord, CurvesRecord, FieldRecord, ScreenRecord, ShadingRecord, curves_csv};
pub use files::{
    CURVES_CSV, CURVES_JSON, CURVES_SCHEMA, FileError, INDEX_HTML, INPUTS_CSV, LIMITS_CSV,
    LIMITS_JSON, OPINIONS_CSV, REPORT_HTML, REPORT_JSON, RESULTS_CSV, RESULTS_PARQUET, RUN_JSON,
    STUDIES_SCHEMA, STUDY_JSON, SUMMARY_JSON, VALUES_PARQUET, open_result_file, read_json_file,
};
pub use fvvdp::{EccentricityShare, FvvdpSummary, SpatialBand};
pub use gate::{
    BandLoss, BandRecord, Calibration, Check, CheckRecord, Compared, ComparisonName, FALSE_ALARMS,
    FoundValue, FrameCheck, FrameCheckRecord, GATE, GATE_SCHEMA, Lacking, Limit, Loss, LossPicture,
    LossRecord, Outcome, PictureRecord, Place, PlaceRecord, Proposal, ProposedLimit, RuleRecord,
    RuleVerdict, RunValues, State, Verdict, VerdictRecord, calibrate, keep_verdict, kept_verdict,
    statistic_name, verdict_file, write_verdict_json,
};
pub use inputs::{Identity, Input, Inputs};
pub use inputs_csv::write_inputs;
pub use json::{
    BandStatistics, BudgetRecord, ComparisonSummary, DoubtRecord, ErrorRecord, ExperimentRecord,
    FOVEATE_SCHEMA, FoveateErrorRecord, FoveateRecord, FoveatedRecord, HaarRecord, HaarSides,
    HaarValues, MOST_LISTED_INPUTS, Number, RUN_SCHEMA, RunRecord, SCORE_SCHEMA, SUMMARY_SCHEMA,
    SideValues, SpectrumBin, SpectrumRecord, SpectrumValues, ViewRecord, read_summary,
    summary_spectra, write_json, write_stereo_json, write_summary,
};
pub use limits::{LIMITS_SCHEMA, LimitPoint, LimitRecord, LimitRule, LimitState, LimitsRecord};
pub use output::{
    Batch, make_folder, replaces, sweep, take_away, try_writing, write_json_file,
    write_json_output, write_output, write_whole, write_whole_with,
};
pub use pictures::{
    ChosenFrame, FrameImages, FrameRecord, FrameView, IMAGES, IMAGES_JSON, IMAGES_SCHEMA,
    ImagesRecord, MapBlocks, TestRecord, ViewImages, padded, read_record,
};
pub use report::{
    Comparison, Doubt, Failure, FrameResult, FvvdpViewing, GuideSource, GuideSources, RunResults,
    ScoreReport, Swept, ViewResult,
};
pub use samples::{BudgetSummary, SampleSummary};
pub use spread::Spread;
pub use stereo::StereoReport;
pub use summary::{BandSummary, SideStatistics, Statistics, Summary};
pub use table::{
    ERROR, GAZE_STEP, HAS_PARQUET, TableRow, Value, Which, read_results, table_file, write_csv,
    write_results_csv, write_stereo_csv, write_tables,
};
#[cfg(feature = "parquet")]
pub use table::{Part, write_results_parquet};
pub use temporal::{TemporalSummaries, TemporalSummary, needs_frames};
