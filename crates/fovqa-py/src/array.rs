//! Arrays of numpy as frames, and frames as arrays. A contiguous array is not copied.
#![allow(unsafe_code, reason = "a frame refers to the memory of an array, which Python keeps")]

use fovqa_frame::{
    Buffer, Channels, Frame, FrameError, Guides, Motion, Plane, PlaneSamples, Samples,
};
use half::f16;
use numpy::{
    Element, IntoPyArray, PyArray1, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods,
    PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyMemoryView;

use crate::document::type_name;
use crate::error::wrong_input;

/// The memory of a contiguous array.
struct ArrayMemory<T> {
    first: *const T,
    length: usize,
    /// Keeps the memory.
    _array: Py<PyArrayDyn<T>>,
}

// SAFETY: the memory is only read, and the array is kept until the last reader is gone. Python code that
// writes to the array meanwhile gets scores of something in between, as with every reader of numpy arrays
// that releases the interpreter's lock.
unsafe impl<T: Sync> Send for ArrayMemory<T> {}
// SAFETY: as above.
unsafe impl<T: Sync> Sync for ArrayMemory<T> {}

impl<T> AsRef<[T]> for ArrayMemory<T> {
    fn as_ref(&self) -> &[T] {
        if self.length == 0 {
            return &[];
        }
        // SAFETY: a contiguous array has `length` elements from `first` on. It is aligned, which was checked,
        // and it is not resized while there is another reference to it.
        unsafe { std::slice::from_raw_parts(self.first, self.length) }
    }
}

/// The elements of an array in C order, without a copy if they are contiguous.
fn buffer<T: Element + Sync + Clone + 'static>(array: &Bound<'_, PyAny>) -> PyResult<Buffer<T>> {
    let mut array: Bound<'_, PyArrayDyn<T>> = array.cast::<PyArrayDyn<T>>()?.clone();
    let is_aligned = array.data().is_aligned();
    if !array.is_c_contiguous() || !is_aligned {
        let numpy = array.py().import("numpy")?;
        let kwargs = pyo3::types::PyDict::new(array.py());
        kwargs.set_item("order", "C")?;
        let copy = numpy.call_method("array", (&array,), Some(&kwargs))?;
        array = copy.cast_into::<PyArrayDyn<T>>()?;
    }
    let (first, length) = (array.data().cast_const(), array.len());
    Ok(Buffer::shared(ArrayMemory { first, length, _array: array.unbind() }))
}

/// Whether a value is an array, or can be made one.
pub(crate) fn is_like_array(value: &Bound<'_, PyAny>) -> bool {
    let has = |method: &&str| value.hasattr(*method).unwrap_or(false);
    value.is_instance_of::<PyMemoryView>() || ["__array__", "__array_interface__"].iter().any(has)
}

/// The array of a value that is one or can be made one without a copy, such as a picture of Pillow or a
/// tensor in main memory.
pub(crate) fn array_of<'py>(
    name: &str,
    value: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    if value.get_type().name().is_ok_and(|name| name == "MaskedArray") {
        return Err(wrong_input(
            format!("the {name} is a masked array"),
            "give its data, array.data, and the pixels that count with mask=~array.mask",
        ));
    }
    if let Ok(array) = value.cast::<PyUntypedArray>() {
        return Ok(array.clone());
    }
    if !is_like_array(value) {
        return Err(PyTypeError::new_err(format!(
            "the {name} is {}; give a numpy array (height x width, or height x width x 3), a path, or a \
             sequence of these",
            type_name(value)
        )));
    }
    let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
    Ok(array.cast_into::<PyUntypedArray>()?)
}

/// The shape of an array in words: 480 x 640 x 3.
pub(crate) fn shape_in_words(shape: &[usize]) -> String {
    match shape {
        [] => "of a single number".to_owned(),
        shape => shape.iter().map(usize::to_string).collect::<Vec<_>>().join(" x "),
    }
}

/// The name of an array's type.
fn type_of(array: &Bound<'_, PyUntypedArray>) -> String {
    let name = array.dtype().getattr("name").and_then(|name| name.extract::<String>());
    name.unwrap_or_else(|_| "another type".to_owned())
}

/// The samples of an array, with the channels of a pixel side by side.
fn samples(name: &str, array: &Bound<'_, PyUntypedArray>) -> PyResult<Samples> {
    let of = type_of(array);
    if !array.dtype().is_native_byteorder().unwrap_or(true) {
        return Err(wrong_input(
            format!("the {name} is an array of {of} in foreign byte order"),
            format!("convert it: array.astype(numpy.{of})"),
        ));
    }
    match of.as_str() {
        "uint8" => buffer(array).map(Samples::U8),
        "uint16" => buffer(array).map(Samples::U16),
        "float16" => buffer::<f16>(array).map(Samples::F16),
        "float32" => buffer(array).map(Samples::F32),
        _ => Err(wrong_input(
            format!("the {name} is an array of {of}"),
            match of.as_str() {
                "float64" => {
                    "convert it: array.astype(numpy.float32); floats are linear light unless signal={\"transfer\": \
                     \"srgb\"} says that they are encoded"
                }
                "bool" => "convert it: array.astype(numpy.uint8) * 255",
                _ => {
                    "give uint8 or uint16 (codes of a display), or float16 or float32 (linear light)"
                }
            },
        )),
    }
}

/// The frame of an array of height x width, height x width x 1 (gray) or height x width x 3 (RGB).
pub(crate) fn frame(name: &str, value: &Bound<'_, PyAny>, max_megapixels: u64) -> PyResult<Frame> {
    let array = array_of(name, value)?;
    let shape = array.shape().to_vec();
    let (height, width, channels) = match shape.as_slice() {
        [height, width] | [height, width, 1] => (*height, *width, Channels::Gray),
        [height, width, 3] => (*height, *width, Channels::Rgb),
        shape => {
            return Err(wrong_input(
                format!("the {name} has the shape {}", shape_in_words(shape)),
                shape_help(shape),
            ));
        }
    };
    // A few bytes can stand for a huge array whose rows are all the same.
    if width.saturating_mul(height) as u64 > max_megapixels.saturating_mul(1_000_000) {
        return Err(wrong_input(
            format!("the {name} has {width}x{height} pixels, more than {max_megapixels} million"),
            "if this is right, give a larger max_megapixels in signal",
        ));
    }
    let wrong = |error: FrameError| {
        wrong_input(format!("the {name}: {error}"), "give an array with pixels")
    };
    if width == 0 || height == 0 {
        return Err(wrong(FrameError::Empty { width, height }));
    }
    let frame = Frame::new(width, height, channels, samples(name, &array)?).map_err(wrong)?;
    Ok(frame.interleaved())
}

fn shape_help(shape: &[usize]) -> &'static str {
    match shape {
        [_, _, 4] => "leave alpha out: array[..., :3]",
        [_, _, 2] => "leave alpha out: array[..., 0]",
        [1 | 3, _, _] => "the channels come last: numpy.moveaxis(array, 0, -1)",
        [_, 1 | 3, _, _] => "the channels come last: numpy.moveaxis(array, 1, -1)",
        [_, _, _] => {
            "give height x width, or height x width x 3; for several gray frames, frames x height x width x 1 or a \
             list"
        }
        [_, _, _, _] => "give frames x height x width x 3, or a list of frames",
        _ => "give height x width, or height x width x 3",
    }
}

/// The mask of an array of height x width: True, or brighter than half, where pixels count.
pub(crate) fn mask(value: &Bound<'_, PyAny>, max_megapixels: u64) -> PyResult<Frame> {
    let array = array_of("mask", value)?;
    if type_of(&array) == "bool" {
        let numpy = value.py().import("numpy")?;
        let codes = array.call_method1("astype", (numpy.getattr("uint8")?,))?;
        return frame("mask", &codes.mul(255)?, max_megapixels);
    }
    if value.py().import("numpy")?.call_method1("max", (&array,))?.eq(1)?
        && type_of(&array).starts_with("uint")
    {
        return Err(wrong_input(
            "the mask has codes 0 and 1 alone, which are both dark",
            "convert it: mask.astype(bool)",
        ));
    }
    frame("mask", &array, max_megapixels)
}

/// A plane of floats of an array of height x width.
fn plane(name: &str, array: &Bound<'_, PyAny>) -> PyResult<Plane> {
    let numpy = array.py().import("numpy")?;
    let floats = numpy.call_method1("ascontiguousarray", (array, numpy.getattr("float32")?))?;
    let floats = floats.cast_into::<PyArrayDyn<f32>>()?;
    let [height, width] = *floats.shape() else {
        return Err(wrong_input(
            format!("the {name} has the shape {}", shape_in_words(floats.shape())),
            "give height x width",
        ));
    };
    let samples = PlaneSamples::F32(floats.to_vec().unwrap_or_default());
    Plane::new(width, height, samples)
        .map_err(|error| wrong_input(format!("the {name}: {error}"), "give an array with pixels"))
}

/// The motion of an array of height x width x 2: where each pixel was in the frame before, in pixels to the
/// right and down from where it is.
pub(crate) fn motion(value: &Bound<'_, PyAny>) -> PyResult<Motion> {
    const NAME: &str = "motion";
    let array = array_of(NAME, value)?;
    let shape = array.shape().to_vec();
    if shape.len() != 3 || shape[2] != 2 {
        return Err(wrong_input(
            format!("the motion of a frame has the shape {}", shape_in_words(&shape)),
            "give height x width x 2: pixels to the right and down, to where the pixel was in the frame before",
        ));
    }
    let of = |axis: usize| {
        let all = pyo3::types::PySlice::full(value.py());
        plane(NAME, &array.get_item((&all, &all, axis))?)
    };
    let motion = Motion::new(of(0)?, of(1)?, [1.0; 2]);
    Ok(motion.unwrap_or_else(|| unreachable!("both planes are of one array")))
}

/// The depth of an array of height x width.
pub(crate) fn depth(value: &Bound<'_, PyAny>) -> PyResult<Plane> {
    plane("depth", array_of("depth", value)?.as_any())
}

/// The arrays of motion and of depth, as far as these exist.
pub(crate) type GuideArrays<'py> = (Option<Bound<'py, PyAny>>, Option<Bound<'py, PyAny>>);

/// Motion and depth as arrays of height x width x 2 and height x width.
pub(crate) fn guide_arrays<'py>(py: Python<'py>, guides: &Guides) -> PyResult<GuideArrays<'py>> {
    let motion = guides.motion.as_ref().map(|motion| {
        let (width, height) = (motion.width(), motion.height());
        let values = (0..width * height).flat_map(|i| motion.at(i % width, i / width));
        let values = values.map(|value| value as f32).collect();
        array(py, values, &[height, width, 2])
    });
    let depth = guides.depth.as_ref().map(|depth| {
        let (width, height) = (depth.width(), depth.height());
        let values = (0..width * height).map(|i| depth.at(i % width, i / width)).collect();
        array(py, values, &[height, width])
    });
    Ok((motion.transpose()?, depth.transpose()?))
}

/// An array of values in C order.
pub(crate) fn array<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let array: Bound<'py, PyArray1<T>> = values.into_pyarray(py);
    Ok(array.reshape(shape)?.into_any())
}

/// A frame as an array of its own type, of height x width (gray) or height x width x 3.
pub(crate) fn of_frame<'py>(py: Python<'py>, frame: &Frame) -> PyResult<Bound<'py, PyAny>> {
    let (width, height) = (frame.width(), frame.height());
    let channels = frame.channels().count();
    let shape: &[usize] = if channels == 1 { &[height, width] } else { &[height, width, 3] };
    let is_whole = frame.file_size() == (width, height);
    let place = |i: usize| (i % channels, i / channels % width, i / channels / width);
    let all = 0..width * height * channels;
    let value = |i: usize| {
        let (c, x, y) = place(i);
        frame.sample(c, x, y)
    };
    let is_as_it_is = is_whole && (frame.is_interleaved() || channels == 1);
    match frame.samples() {
        Samples::U8(codes) if is_as_it_is => array(py, codes.to_vec(), shape),
        Samples::U16(codes) if is_as_it_is => array(py, codes.to_vec(), shape),
        Samples::F16(values) if is_as_it_is => array(py, values.to_vec(), shape),
        Samples::F32(values) if is_as_it_is => array(py, values.to_vec(), shape),
        Samples::U8(_) => array(py, all.map(|i| value(i) as u8).collect(), shape),
        Samples::U16(_) => array(py, all.map(|i| value(i) as u16).collect(), shape),
        Samples::F16(_) => array(py, all.map(|i| f16::from_f32(value(i))).collect(), shape),
        Samples::F32(_) => array(py, all.map(value).collect(), shape),
    }
}
