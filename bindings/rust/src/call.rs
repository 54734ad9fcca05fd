//! One call of the library: slices to pointers, the counts that follow from them and from the objects, room for arrays that
//! grow.
use crate::core::check;
use crate::{raw, Error, Result};
use std::{any::Any, collections::BTreeMap};

/// Slices of either of two types, from slices, vectors and arrays by reference.
macro_rules! slices {
    ($($(#[$doc:meta])* $name:ident { $($(#[$what:meta])* $case:ident($kind:ty): $code:expr,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $name<'a> {
            $($(#[$what])* $case(&'a [$kind]),)*
        }
        impl $name<'_> {
            pub(crate) fn numbers(self) -> Numbers {
                match self {
                    $($name::$case(values) => (start(values).cast(), values.len(), $code),)*
                }
            }
        }
        $(impl<'a> From<&'a [$kind]> for $name<'a> {
            fn from(values: &'a [$kind]) -> Self {
                $name::$case(values)
            }
        }
        impl<'a> From<&'a Vec<$kind>> for $name<'a> {
            fn from(values: &'a Vec<$kind>) -> Self {
                $name::$case(values)
            }
        }
        impl<'a, const N: usize> From<&'a [$kind; N]> for $name<'a> {
            fn from(values: &'a [$kind; N]) -> Self {
                $name::$case(values)
            }
        })*
    )*};
}
slices! {
    /// A slice of single or of double precision.
    Reals {
        /// single precision
        F32(f32): raw::HF_TYPE_PLAIN,
        /// double precision
        F64(f64): raw::HF_TYPE_DOUBLE,
    }
    /// A slice of vertices in 32 or in 16 bits.
    Indices {
        /// 32 bits
        U32(u32): raw::HF_TYPE_PLAIN,
        /// 16 bits
        U16(u16): raw::HF_TYPE_UINT16,
    }
}
/// The start of a slice; null if it is empty.
pub(crate) fn start<T>(values: &[T]) -> *const T {
    values.first().map_or(std::ptr::null(), |_| values.as_ptr())
}
/// Where numbers are, how many, of which type.
pub(crate) type Numbers = (*const std::os::raw::c_void, usize, i32);

/// What an object says of its arrays.
pub(crate) type Counts = BTreeMap<String, usize>;

/// A whole number as an option holds it; `most` is 1 for a flag.
pub(crate) fn whole<T: TryFrom<i64>>(name: &str, value: f64, most: f64) -> Result<T> {
    let kept = (value.fract() == 0.0 && value <= most).then(|| T::try_from(value as i64).ok()).flatten();
    let code = if most == 1.0 { raw::HF_ERROR_INVALID_ARGUMENT } else { raw::HF_ERROR_OUT_OF_RANGE };
    kept.ok_or_else(|| Error::new(code, format!("option {name} cannot hold {value}")))
}

#[derive(Default)]
pub(crate) struct Call {
    pub sizes: Counts,
    pub kept: Vec<Box<dyn Any>>,
}

impl Call {
    /// Rows to try for an array that grows. Double clears more memory, half asks twice more often.
    pub const FIRST: usize = 1024;

    pub fn parent(&mut self, name: &str, counts: &Counts) {
        for (key, &size) in counts {
            self.learn(&format!("{name}.{key}"), size);
            self.learn(key, size);
        }
    }
    pub fn learn(&mut self, key: &str, size: usize) {
        self.sizes.insert(key.into(), size);
    }
    /// What the object that was made keeps.
    pub fn counts(&self, keys: &[&str]) -> Counts {
        let kept = |name: &str| keys.contains(&name.rsplit('.').next().unwrap_or(name));
        self.sizes.iter().filter(|(name, _)| kept(name)).map(|(name, &size)| (name.clone(), size)).collect()
    }
    /// A count; `least` where no array says.
    pub fn count(&mut self, key: &str, least: usize) -> Result<u32> {
        let size = self.size(key).unwrap_or(least);
        self.learn(key, size);
        u32::try_from(size).map_err(|_| Error::new(raw::HF_ERROR_TOO_LARGE, format!("{key}: more than 4,294,967,295 entries")))
    }
    /// What a dimension such as "face_count + 1" is; `None`: not known yet.
    pub fn size(&self, dim: &str) -> Option<usize> {
        let more = |(base, more): (&str, &str)| Some(self.sizes.get(base)?.saturating_add(more.parse().ok()?));
        dim.parse().ok().or_else(|| self.sizes.get(dim).copied()).or_else(|| dim.split_once(" + ").and_then(more))
    }
    pub fn product(&self, dims: &[&str]) -> usize {
        dims.iter().fold(1usize, |product, dim| product.saturating_mul(self.size(dim).unwrap_or(0)))
    }

    /// Checks how many numbers there are; a dimension that is not known yet becomes known.
    pub fn fit(&mut self, length: usize, name: &str, dims: &[&str]) -> Result<()> {
        let loose: Vec<&str> = dims.iter().copied().filter(|dim| self.size(dim).is_none()).collect();
        let each = dims.iter().fold(1usize, |product, dim| product.saturating_mul(self.size(dim).unwrap_or(1)));
        let rows = length / each.max(1);
        let wrong = match loose[..] {
            [] if length != each => format!("must hold {each} entries, not {length}"),
            [_] if length != each.saturating_mul(rows) => format!("must hold {each} entries for each, not {length}"),
            [_, _, ..] => "cannot be read without what it belongs to".into(),
            _ => {
                loose.iter().for_each(|dim| self.learn(dim, rows));
                return Ok(());
            }
        };
        Err(Error::new(raw::HF_ERROR_INVALID_ARGUMENT, format!("{name} {wrong}")))
    }

    // ---- what goes in ----

    pub fn array<T>(&mut self, values: Option<&[T]>, name: &str, dims: &[&str]) -> Result<*const T> {
        values.map_or(Ok(()), |values| self.fit(values.len(), name, dims))?;
        Ok(values.map_or(std::ptr::null(), start))
    }
    /// Rows of numbers where the caller has them.
    pub fn view(&mut self, values: Option<Numbers>, name: &str, dims: &[&str]) -> Result<raw::hf_array> {
        let Some((data, length, r#type)) = values else { return Ok(raw::hf_array::default()) };
        self.fit(length, name, dims)?;
        Ok(raw::hf_array { data, count: self.count(dims[0], 0)?, r#type, ..Default::default() })
    }
    /// Lists of different lengths, one after the other.
    pub fn lists(&mut self, lists: Option<&[&[u32]]>, name: &str, dims: &[&str]) -> Result<(*const u32, *const u32)> {
        let Some(lists) = lists else { return Ok((std::ptr::null(), std::ptr::null())) };
        self.fit(lists.len(), name, dims)?;
        let kept: Box<[Vec<u32>; 2]> = Box::new([lists.iter().map(|list| list.len() as u32).collect(), lists.concat()]);
        let starts = (start(&kept[0]), start(&kept[1]));
        self.kept.push(kept);
        Ok(starts)
    }
    /// Lines in UTF-8, one for each.
    pub fn text(&mut self, lines: Option<&[&str]>) -> Result<*const std::os::raw::c_char> {
        let Some(lines) = lines else { return Ok(std::ptr::null()) };
        let text: String = lines.iter().map(|line| line.replace(['\n', '\0'], " ") + "\n").chain(["\0".into()]).collect();
        let start = text.as_ptr().cast();
        self.kept.push(Box::new(text)); // the letters stay where they are when the string moves
        Ok(start)
    }
    /// Keeps a struct until the call is over.
    pub fn keep<T: 'static>(&mut self, inner: T) -> *const T {
        let kept = Box::new(inner);
        let place: *const T = &*kept;
        self.kept.push(kept);
        place
    }

    // ---- what comes out ----

    /// An array for the library to fill; none where it has no place.
    pub fn out<T>(&self, place: *mut T, rows: &str) -> raw::hf_array_out {
        let r#type = if std::mem::size_of::<T>() == 8 { raw::HF_TYPE_DOUBLE } else { raw::HF_TYPE_PLAIN };
        let count = if place.is_null() { 0 } else { self.size(rows).unwrap_or(0) as u32 };
        raw::hf_array_out { data: place.cast(), count, r#type, ..Default::default() }
    }
    /// The start of an optional slice to fill.
    pub fn fill<T>(&mut self, values: Option<&mut [T]>, name: &str, dims: &[&str]) -> Result<*mut T> {
        let Some(values) = values else { return Ok(std::ptr::null_mut()) };
        self.fit(values.len(), name, dims)?;
        Ok(values.as_mut_ptr())
    }
    /// Room for an array whose length the library tells.
    pub fn room<T: Clone + Default>(&self, array: &mut Vec<T>, dims: &[&str]) -> *mut T {
        array.clear();
        array.resize(self.product(dims), T::default());
        match array.len() {
            0 => std::ptr::null_mut(),
            _ => array.as_mut_ptr(),
        }
    }
    /// Whether the room sufficed and all counts were known. If not, they are now, and the call is made again.
    pub fn enough(&mut self, code: i32, told: &[(&str, u32)]) -> Result<bool> {
        let (rooms, others): (Vec<_>, Vec<_>) = told.iter().partition(|(key, _)| key.ends_with("capacity"));
        let fits = rooms.iter().all(|&&(key, count)| Some(count as usize) <= self.size(key));
        let known = others.iter().all(|&&(key, count)| Some(count as usize) == self.size(key));
        let again = code == raw::HF_ERROR_TOO_SMALL && !fits;
        check(if again { raw::HF_OK } else { code })?;
        told.iter().for_each(|&(key, count)| self.learn(key, count as usize));
        Ok(fits && known)
    }
}

/// A handle that is destroyed when it goes out of scope.
macro_rules! object {
    ($(#[$doc:meta])* $name:ident: $handle:ident, $destroy:ident) => {
        $(#[$doc])*
        #[derive(Debug, PartialEq)]
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
    };
}
pub(crate) use object;
