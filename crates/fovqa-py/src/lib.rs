//! The native part of the Python package `fovqa`. It is a thin layer over the library: Python gives plain
//! values and arrays, and gets JSON, CSV, arrays and pictures. The classes that people use are in `python/fovqa/`.

mod array;
mod command;
mod curves;
mod document;
mod error;
mod fetch;
mod foveate;
mod gallery;
mod lists;
mod png;
mod profile;
mod read;
mod run;
mod score;
mod sharded;
mod source;
mod study;
mod threads;
mod worker;

use pyo3::prelude::*;

#[pymodule(name = "_native")]
fn native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    worker::watch_panics();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<gallery::Gallery>()?;
    module.add_class::<sharded::Sharded>()?;
    module.add_class::<sharded::Lock>()?;
    for function in [
        wrap_pyfunction!(score::score, module)?,
        wrap_pyfunction!(foveate::foveate, module)?,
        wrap_pyfunction!(run::run, module)?,
        wrap_pyfunction!(sharded::merge, module)?,
        wrap_pyfunction!(curves::curves, module)?,
        wrap_pyfunction!(study::study, module)?,
        wrap_pyfunction!(read::read, module)?,
        wrap_pyfunction!(png::png, module)?,
        wrap_pyfunction!(profile::profile, module)?,
        wrap_pyfunction!(lists::metrics, module)?,
        wrap_pyfunction!(lists::methods, module)?,
        wrap_pyfunction!(lists::displays, module)?,
        wrap_pyfunction!(threads::set_threads, module)?,
        wrap_pyfunction!(threads::after_fork, module)?,
        wrap_pyfunction!(worker::shutdown, module)?,
        wrap_pyfunction!(command::command, module)?,
    ] {
        module.add_function(function)?;
    }
    Ok(())
}
