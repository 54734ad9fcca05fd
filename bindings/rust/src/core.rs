//! What all objects share: errors, checked slices, undo, places.
use crate::raw;
use std::ffi::CStr;
use std::fmt;

/// Why a call failed. The object is as it was before the call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// One of the codes `HF_ERROR_*` of [`crate::raw`].
    pub code: i32,
    /// One line: what is wrong and what to do.
    pub message: String,
    /// The function of the C ABI that failed; empty if this crate refused the call.
    pub function: String,
    /// The vertex, triangle, site, handle or position in a list that is wrong.
    pub index: Option<u32>,
}

impl Error {
    /// The name of the code, such as `"HF_ERROR_EMPTY"`.
    pub fn name(&self) -> &'static str {
        // SAFETY: the library returns a constant string for every number, never null.
        unsafe { CStr::from_ptr(raw::hf_result_get_name(self.code)) }.to_str().unwrap_or("unknown")
    }

    pub(crate) fn new(code: i32, message: impl Into<String>) -> Self {
        Error { code, message: message.into(), function: String::new(), index: None }
    }

    /// The failed call of this thread.
    fn last(code: i32) -> Self {
        let mut detail = raw::hf_error_detail::default();
        // SAFETY: `detail` is a whole struct of the right layout.
        unsafe { raw::hf_error_get_detail(&mut detail) };
        // SAFETY: the library ends both texts with a zero.
        let text = |bytes: &[std::os::raw::c_char]| unsafe { CStr::from_ptr(bytes.as_ptr()) }.to_string_lossy().into_owned();
        Error {
            code,
            message: text(&detail.message),
            function: text(&detail.function),
            index: (detail.index != raw::HF_NO_INDEX).then_some(detail.index),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.function.is_empty() {
            write!(out, "{}: ", self.function)?;
        }
        write!(out, "{} ({})", self.message, self.name())
    }
}

impl std::error::Error for Error {}

/// What every call returns that can fail.
pub type Result<T> = std::result::Result<T, Error>;

pub(crate) fn check(code: i32) -> Result<()> {
    if code == raw::HF_OK {
        Ok(())
    } else {
        Err(Error::last(code))
    }
}

/// Refuses a slice of another length than the library will read or write.
pub(crate) fn of_length<T>(values: &[T], name: &str, length: usize) -> Result<()> {
    if values.len() == length {
        return Ok(());
    }
    let message = format!("{name} must hold {length} entries, not {}", values.len());
    Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, message))
}

/// The start of a slice; null if it is empty.
pub(crate) fn start<T>(values: &[T]) -> *const T {
    if values.is_empty() {
        std::ptr::null()
    } else {
        values.as_ptr()
    }
}

/// The start of an optional slice; null without one.
pub(crate) fn start_of<T>(values: Option<&[T]>) -> *const T {
    values.map_or(std::ptr::null(), start)
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// Numbers that positions and fields may have: `f32` or `f64`.
pub trait Real: sealed::Sealed + Copy + Default {
    #[doc(hidden)]
    const DOUBLE: bool;
}
impl Real for f32 {
    const DOUBLE: bool = false;
}
impl Real for f64 {
    const DOUBLE: bool = true;
}

/// What [`History`] keeps: objects whose clones share memory with them.
pub trait TryClone: Sized {
    /// A copy in the same state.
    fn try_clone(&self) -> Result<Self>;
}

/// Undo and redo of one object. Every record is a clone.
#[derive(Debug)]
pub struct History<T> {
    past: Vec<T>,
    undone: Vec<T>,
}
impl<T> Default for History<T> {
    fn default() -> Self {
        History { past: Vec::new(), undone: Vec::new() }
    }
}
impl<T: TryClone> History<T> {
    /// Keeps the present state for `undo`.
    pub fn record(&mut self, object: &T) -> Result<()> {
        self.past.push(object.try_clone()?);
        self.undone.clear();
        Ok(())
    }
    /// Goes back to the last record, bit for bit.
    pub fn undo(&mut self, object: &mut T) -> Result<()> {
        exchange(&mut self.past, &mut self.undone, object, "nothing is recorded; call record before the edits")
    }
    /// Goes to the state before the last `undo`.
    pub fn redo(&mut self, object: &mut T) -> Result<()> {
        exchange(&mut self.undone, &mut self.past, object, "nothing was undone since the last record")
    }
}
fn exchange<T>(from: &mut Vec<T>, to: &mut Vec<T>, object: &mut T, nothing: &str) -> Result<()> {
    let mut state = from.pop().ok_or_else(|| Error::new(raw::HF_ERROR_EMPTY, nothing))?;
    std::mem::swap(object, &mut state);
    to.push(state);
    Ok(())
}

impl From<u32> for raw::hf_place {
    /// The place of a vertex.
    fn from(vertex: u32) -> Self {
        raw::hf_place { corners: [vertex; 3], barycentrics: [1.0, 0.0, 0.0], ..Default::default() }
    }
}
impl From<&raw::hf_hit> for raw::hf_place {
    fn from(hit: &raw::hf_hit) -> Self {
        hit.place
    }
}
