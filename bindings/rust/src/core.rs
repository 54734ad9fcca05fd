//! What all objects share: errors, checked slices, options, handles that destroy themselves.
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

/// The number of entries as the library counts them.
pub(crate) fn count_of(length: usize, name: &str) -> Result<u32> {
    u32::try_from(length).map_err(|_| Error::new(raw::HF_ERROR_TOO_LARGE, format!("{name}: more than 4,294,967,295 entries")))
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

/// A slice in rows of `width`: the number of rows.
pub(crate) fn rows_of<T>(values: &[T], width: usize, name: &str) -> Result<u32> {
    if values.len() % width != 0 {
        let message = format!("{name} must hold {width} numbers each; {} is no multiple of {width}", values.len());
        return Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, message));
    }
    count_of(values.len() / width, name)
}

/// Lists of vertices, one behind the other, and their lengths.
pub(crate) fn flatten(lists: &[&[u32]], name: &str) -> Result<(Vec<u32>, Vec<u32>)> {
    let counts = lists.iter().map(|list| count_of(list.len(), name)).collect::<Result<Vec<_>>>()?;
    Ok((counts, lists.concat()))
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for u16 {}
    impl Sealed for u32 {}
}

/// Numbers that positions and fields may have: `f32` or `f64`.
pub trait Real: sealed::Sealed + Copy + Default {
    /// The pointer as single and as double precision; one of them is null.
    #[doc(hidden)]
    fn both(at: *const Self) -> (*const f32, *const f64);
    #[doc(hidden)]
    fn both_mut(at: *mut Self) -> (*mut f32, *mut f64) {
        let (single, double) = Self::both(at);
        (single.cast_mut(), double.cast_mut())
    }
}
impl Real for f32 {
    fn both(at: *const f32) -> (*const f32, *const f64) {
        (at, std::ptr::null())
    }
}
impl Real for f64 {
    fn both(at: *const f64) -> (*const f32, *const f64) {
        (std::ptr::null(), at)
    }
}

/// Numbers that triangles may have: `u16` or `u32`.
pub trait Corner: sealed::Sealed + Copy {
    #[doc(hidden)]
    fn both(at: *const Self) -> (*const u16, *const u32);
}
impl Corner for u16 {
    fn both(at: *const u16) -> (*const u16, *const u32) {
        (at, std::ptr::null())
    }
}
impl Corner for u32 {
    fn both(at: *const u32) -> (*const u16, *const u32) {
        (std::ptr::null(), at)
    }
}

/// A struct of options that fills fields of a desc. `set` finds an option by its name in the C ABI.
macro_rules! options {
    ($(#[$doc:meta])* $name:ident: $desc:ident { $($(#[$field_doc:meta])* $field:ident: $kind:ty,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $kind,)*
        }
        impl $name {
            #[allow(dead_code)]
            pub(crate) fn fill(&self, desc: &mut $crate::raw::$desc) {
                $(desc.$field = self.$field;)*
            }
            /// Sets the option of this name. Refuses unknown names and values that the option cannot hold.
            pub fn set(&mut self, name: &str, value: f64) -> $crate::Result<()> {
                match name {
                    $(stringify!($field) => {
                        let kept = value as $kind;
                        let real = stringify!($kind).starts_with('f');
                        let fits = if real { !value.is_finite() || (kept as f64).is_finite() } else { kept as f64 == value };
                        if !fits {
                            let message = format!("option {name} cannot hold {value}");
                            return Err($crate::Error::new($crate::raw::HF_ERROR_OUT_OF_RANGE, message));
                        }
                        self.$field = kept;
                        Ok(())
                    })*
                    _ => Err($crate::Error::new($crate::raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))),
                }
            }
        }
    };
}

/// A handle that is destroyed when it goes out of scope.
macro_rules! object {
    ($(#[$doc:meta])* $name:ident: $handle:ident, $destroy:ident { $($field:ident: $kind:ty),* $(,)? }) => {
        $(#[$doc])*
        pub struct $name {
            pub(crate) handle: $crate::raw::$handle,
            $(pub(crate) $field: $kind,)*
        }
        impl Drop for $name {
            fn drop(&mut self) {
                // SAFETY: this object alone owns the handle.
                unsafe { $crate::raw::$destroy(self.handle) }
            }
        }
        // SAFETY: any thread may use a handle. Calls that only read it may run at the same time, and these take &self.
        unsafe impl Send for $name {}
        unsafe impl Sync for $name {}
        impl std::fmt::Debug for $name {
            fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                out.debug_struct(stringify!($name)).finish_non_exhaustive()
            }
        }
    };
}

/// A method that runs one function of the C ABI on the handle.
macro_rules! plain {
    ($($(#[$doc:meta])* $name:ident => $call:ident;)*) => {
        $($(#[$doc])*
        pub fn $name(&mut self) -> $crate::Result<()> {
            // SAFETY: the handle is valid as long as this object lives.
            $crate::core::check(unsafe { $crate::raw::$call(self.handle) })
        })*
    };
}

/// A method that asks for a struct of figures.
macro_rules! figures {
    ($($(#[$doc:meta])* $name:ident => $call:ident -> $info:ident;)*) => {
        $($(#[$doc])*
        pub fn $name(&self) -> $crate::Result<$crate::raw::$info> {
            let mut info = $crate::raw::$info::default();
            // SAFETY: the handle is valid and `info` a whole struct of this version.
            $crate::core::check(unsafe { $crate::raw::$call(self.handle, &mut info) })?;
            Ok(info)
        })*
    };
}
pub(crate) use {figures, object, options, plain};

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

/// A list that is asked for its count first.
pub(crate) fn list<T: Clone + Default>(mut call: impl FnMut(u32, *mut T, *mut u32) -> i32) -> Result<Vec<T>> {
    let mut count = 0;
    check(call(0, std::ptr::null_mut(), &mut count))?;
    let mut out = vec![T::default(); count as usize];
    if count > 0 {
        check(call(count, out.as_mut_ptr(), &mut count))?;
        out.truncate(count as usize);
    }
    Ok(out)
}

object!(
    /// Follows a long call from another thread, and cancels it. Pass it with the options of the call.
    Progress: hf_progress, hf_progress_destroy {}
);
impl Progress {
    /// An object for one call at a time.
    pub fn new() -> Result<Self> {
        let mut handle = std::ptr::null_mut();
        // SAFETY: `handle` takes the new handle.
        check(unsafe { raw::hf_progress_create(&mut handle) })?;
        Ok(Progress { handle })
    }
    /// How much of the running call is done, 0 to 1.
    pub fn fraction(&self) -> Result<f64> {
        let mut fraction = 0.0;
        // SAFETY: the handle is valid and `fraction` takes the number.
        check(unsafe { raw::hf_progress_get_fraction(self.handle, &mut fraction) })?;
        Ok(fraction)
    }
    /// Stops the running call, or the next one. It returns `HF_ERROR_CANCELLED`.
    pub fn cancel(&self) -> Result<()> {
        // SAFETY: the handle is valid.
        check(unsafe { raw::hf_progress_cancel(self.handle) })
    }
}

/// The handle of an optional progress object.
pub(crate) fn handle_of(progress: Option<&Progress>) -> raw::hf_progress {
    progress.map_or(std::ptr::null_mut(), |p| p.handle)
}
