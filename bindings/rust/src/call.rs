//! One call of the library: slices to pointers, the counts that follow from them and from the objects, room for arrays that
//! grow.
use crate::core::{check, of_length, start, start_of};
use crate::{raw, Error, Result};
use std::any::Any;

/// A slice of single or of double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reals<'a> {
    /// single precision
    F32(&'a [f32]),
    /// double precision
    F64(&'a [f64]),
}
/// A slice of vertices in 32 or in 16 bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Indices<'a> {
    /// 32 bits
    U32(&'a [u32]),
    /// 16 bits
    U16(&'a [u16]),
}

/// From slices, vectors and arrays, by reference.
macro_rules! from_slices {
    ($($to:ident::$case:ident($kind:ty);)*) => {
        $(impl<'a> From<&'a [$kind]> for $to<'a> {
            fn from(values: &'a [$kind]) -> Self {
                $to::$case(values)
            }
        }
        impl<'a> From<&'a Vec<$kind>> for $to<'a> {
            fn from(values: &'a Vec<$kind>) -> Self {
                $to::$case(values)
            }
        }
        impl<'a, const N: usize> From<&'a [$kind; N]> for $to<'a> {
            fn from(values: &'a [$kind; N]) -> Self {
                $to::$case(values)
            }
        })*
    };
}
from_slices!(Reals::F32(f32); Reals::F64(f64); Indices::U32(u32); Indices::U16(u16););

/// What an object says of its arrays.
pub(crate) type Counts = Vec<(String, usize)>;

pub(crate) fn known(counts: &[(String, usize)], key: &str) -> Option<usize> {
    counts.iter().find(|(name, _)| name == key).map(|&(_, size)| size)
}

/// The error of a name that no option has.
pub(crate) fn unknown(name: &str) -> Error {
    Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("no option {name}"))
}

/// Numbers that options may be.
pub(crate) trait Number: Sized {
    fn fit(name: &str, value: f64) -> Result<Self>;
}
macro_rules! numbers {
    ($($kind:ty)*) => {
        $(impl Number for $kind {
            fn fit(name: &str, value: f64) -> Result<Self> {
                let kept = value as $kind;
                if kept as f64 == value {
                    return Ok(kept);
                }
                Err(Error::new(raw::HF_ERROR_OUT_OF_RANGE, format!("option {name} cannot hold {value}")))
            }
        })*
    };
}
numbers!(i32 u32);
impl Number for f64 {
    fn fit(_: &str, value: f64) -> Result<Self> {
        Ok(value)
    }
}
impl Number for bool {
    fn fit(name: &str, value: f64) -> Result<Self> {
        let wrong = || Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("option {name} must be 0 or 1, not {value}"));
        (value == 0.0 || value == 1.0).then_some(value == 1.0).ok_or_else(wrong)
    }
}

pub(crate) struct Call {
    sizes: Counts,
    kept: Vec<Box<dyn Any>>,
}

impl Call {
    pub fn new(counts: &[(String, usize)]) -> Self {
        Call { sizes: counts.to_vec(), kept: Vec::new() }
    }

    // ---- counts ----

    pub fn parent(&mut self, name: &str, counts: &[(String, usize)]) {
        for (key, size) in counts {
            self.learn(&format!("{name}.{key}"), *size);
            self.learn(key, *size);
        }
    }
    pub fn learn(&mut self, key: &str, size: usize) {
        self.forget(key);
        self.sizes.push((key.into(), size));
    }
    pub fn forget(&mut self, key: &str) {
        self.sizes.retain(|(name, _)| name != key);
    }
    pub fn known(&mut self, key: &str, size: u32) {
        if size > 0 {
            self.learn(key, size as usize);
        }
    }
    /// What the object that was made keeps.
    pub fn counts(&self, keys: &[&str]) -> Counts {
        let kept = |name: &str| keys.contains(&name.rsplit('.').next().unwrap_or(name));
        self.sizes.iter().filter(|(name, _)| kept(name)).cloned().collect()
    }
    pub fn count(&mut self, key: &str, least: usize) -> Result<u32> {
        let size = self.size(key).unwrap_or(least);
        self.learn(key, size);
        self.count_of(key)
    }
    /// What a dimension such as "face_count + 1" is; `None`: not known yet.
    pub fn size(&self, dim: &str) -> Option<usize> {
        let (base, more) = dim.split_once(" + ").map_or((dim, 0), |(base, more)| (base, more.parse().unwrap_or(0)));
        base.parse().ok().or_else(|| known(&self.sizes, base)).map(|size: usize| size + more)
    }
    pub fn product(&self, dims: &[&str]) -> usize {
        dims.iter().fold(1usize, |product, dim| product.saturating_mul(self.size(dim).unwrap_or(0)))
    }

    /// Checks how many numbers there are; a dimension that is not known yet becomes known.
    fn fit(&mut self, length: usize, name: &str, dims: &[&str]) -> Result<()> {
        let refuse = |text: String| Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("{name} {text}")));
        let loose: Vec<&str> = dims.iter().copied().filter(|dim| self.size(dim).is_none()).collect();
        let each = dims.iter().fold(1usize, |product, dim| product.saturating_mul(self.size(dim).unwrap_or(1)));
        let [dim] = loose[..] else {
            return match () {
                _ if loose.len() > 1 => refuse("cannot be read without what it belongs to".into()),
                _ if length != each => refuse(format!("must hold {each} entries, not {length}")),
                _ => Ok(()),
            };
        };
        if (each == 0 && length > 0) || (each > 0 && length % each != 0) {
            return refuse(format!("must hold {each} entries for each, not {length}"));
        }
        let (base, more) = dim.split_once(" + ").map_or((dim, 0), |(base, more)| (base, more.parse().unwrap_or(0)));
        self.learn(base, length.checked_div(each).unwrap_or(0).saturating_sub(more));
        Ok(())
    }

    // ---- what goes in ----

    pub fn array<T>(&mut self, values: Option<&[T]>, name: &str, dims: &[&str]) -> Result<*const T> {
        values.map_or(Ok(()), |values| self.fit(values.len(), name, dims))?;
        Ok(start_of(values))
    }
    /// Rows of numbers where the caller has them.
    fn view<T>(&mut self, values: &[T], kind: i32, name: &str, dims: &[&str]) -> Result<raw::hf_array> {
        self.fit(values.len(), name, dims)?;
        Ok(raw::hf_array { data: start(values).cast(), count: self.count_of(dims[0])?, r#type: kind, ..Default::default() })
    }
    pub fn reals(&mut self, values: Option<Reals>, name: &str, dims: &[&str]) -> Result<raw::hf_array> {
        match values {
            Some(Reals::F32(values)) => self.view(values, raw::HF_TYPE_PLAIN, name, dims),
            Some(Reals::F64(values)) => self.view(values, raw::HF_TYPE_DOUBLE, name, dims),
            None => Ok(raw::hf_array::default()),
        }
    }
    pub fn indices(&mut self, values: Option<Indices>, name: &str, dims: &[&str]) -> Result<raw::hf_array> {
        match values {
            Some(Indices::U32(values)) => self.view(values, raw::HF_TYPE_PLAIN, name, dims),
            Some(Indices::U16(values)) => self.view(values, raw::HF_TYPE_UINT16, name, dims),
            None => Ok(raw::hf_array::default()),
        }
    }
    pub fn words(&mut self, values: Option<&[u32]>, name: &str, dims: &[&str]) -> Result<raw::hf_array> {
        values.map_or(Ok(raw::hf_array::default()), |values| self.view(values, raw::HF_TYPE_PLAIN, name, dims))
    }
    /// An array for the library to fill; none where it has no place.
    pub fn out<T>(&self, place: *mut T, double: bool, rows: &str) -> raw::hf_array_out {
        if place.is_null() {
            return raw::hf_array_out::default();
        }
        let kind = if double { raw::HF_TYPE_DOUBLE } else { raw::HF_TYPE_PLAIN };
        let count = u32::try_from(self.size(rows).unwrap_or(0)).unwrap_or(u32::MAX);
        raw::hf_array_out { data: place.cast(), count, r#type: kind, ..Default::default() }
    }
    fn count_of(&self, dim: &str) -> Result<u32> {
        let size = self.size(dim).unwrap_or(0);
        u32::try_from(size).map_err(|_| Error::new(raw::HF_ERROR_TOO_LARGE, format!("{dim}: more than 4,294,967,295 entries")))
    }
    /// Lists of different lengths, one after the other.
    pub fn lists(&mut self, lists: Option<&[&[u32]]>, name: &str, dims: &[&str]) -> Result<(*const u32, *const u32)> {
        let Some(lists) = lists else { return Ok((std::ptr::null(), std::ptr::null())) };
        self.fit(lists.len(), name, dims)?;
        let (counts, all): (Vec<u32>, Vec<u32>) = (lists.iter().map(|list| list.len() as u32).collect(), lists.concat());
        let starts = (start(&counts), start(&all));
        self.kept.push(Box::new((counts, all))); // the numbers stay where they are when the vectors move
        Ok(starts)
    }
    /// Lines in UTF-8, one for each.
    pub fn text(&mut self, lines: Option<&[&str]>) -> Result<*const std::os::raw::c_char> {
        let Some(lines) = lines else { return Ok(std::ptr::null()) };
        let mut text: Vec<u8> = lines.iter().flat_map(|line| line.replace(['\n', '\0'], " ").into_bytes().into_iter().chain([b'\n'])).collect();
        text.push(0);
        let start = text.as_ptr().cast();
        self.kept.push(Box::new(text));
        Ok(start)
    }
    /// Keeps a struct until the call is over.
    pub fn keep<T: 'static>(&mut self, inner: T) -> *const T {
        let kept = Box::new(inner);
        let place: *const T = &*kept;
        self.kept.push(kept);
        place
    }
    /// The start of an optional slice to fill.
    pub fn fill<T>(&self, values: Option<&mut [T]>, name: &str, dims: &[&str]) -> Result<*mut T> {
        let Some(values) = values else { return Ok(std::ptr::null_mut()) };
        of_length(values, name, self.product(dims))?;
        Ok(values.as_mut_ptr())
    }
}

/// Room for arrays of lengths that the library tells: called again with more when that was too little.
pub(crate) struct Room {
    rooms: Vec<(&'static str, usize)>,
    blind: bool, // asks for counts alone
}

/// Rows to try when nothing is known. Double clears more memory, half asks twice more often.
const FIRST: usize = 1024;

impl Room {
    pub fn new(rooms: &[(&'static str, Option<usize>)]) -> Self {
        Room { rooms: rooms.iter().map(|&(key, size)| (key, size.unwrap_or(FIRST))).collect(), blind: false }
    }
    pub fn begin(&mut self, c: &mut Call, arrays: &[&[&str]]) {
        self.rooms.iter().for_each(|&(key, size)| c.learn(key, size));
        self.blind = arrays.iter().any(|dims| dims.iter().any(|dim| c.size(dim).is_none()));
    }
    pub fn make<T: Clone + Default>(&self, c: &Call, array: &mut Vec<T>, dims: &[&str]) {
        array.clear();
        array.resize(if self.blind { 0 } else { c.product(dims) }, T::default());
    }
    pub fn get(&self, key: &str) -> u32 {
        if self.blind {
            return 0;
        }
        self.rooms.iter().find(|(name, _)| *name == key).map_or(0, |&(_, size)| u32::try_from(size).unwrap_or(u32::MAX))
    }
    pub fn at<T>(&self, array: &mut Vec<T>) -> *mut T {
        if array.is_empty() {
            std::ptr::null_mut()
        } else {
            array.as_mut_ptr()
        }
    }
    /// Whether the arrays are full and right.
    pub fn enough(&mut self, c: &mut Call, code: i32, told: &[(&str, u32)]) -> Result<bool> {
        let count = |key: &str| told.iter().find(|(name, _)| *name == key).map_or(0, |&(_, count)| count as usize);
        let fits = self.rooms.iter().all(|&(key, size)| count(key) <= size);
        if code != raw::HF_ERROR_TOO_SMALL || fits {
            check(code)?;
        }
        let done = code == raw::HF_OK && fits && !self.blind;
        for &(key, size) in told {
            if done || !self.rooms.iter().any(|(name, _)| *name == key) {
                c.learn(key, size as usize);
            }
        }
        for (key, size) in &mut self.rooms {
            *size = if self.blind { count(key) } else { (*size).max(count(key)) };
        }
        Ok(done)
    }
}

/// A handle that is destroyed when it goes out of scope.
macro_rules! object {
    ($(#[$doc:meta])* $name:ident: $handle:ident, $destroy:ident) => {
        $(#[$doc])*
        pub struct $name {
            pub(crate) handle: $crate::raw::$handle,
            pub(crate) counts: $crate::call::Counts,
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
        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                self.handle == other.handle
            }
        }
        impl std::fmt::Debug for $name {
            fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                out.debug_struct(stringify!($name)).finish_non_exhaustive()
            }
        }
    };
}
pub(crate) use object;
