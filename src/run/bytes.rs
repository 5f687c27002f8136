//! Little-endian numbers in a row, and back with a name for what is missing.

use glam::{DQuat, DVec2, DVec3};

use super::StateError;
use crate::math::SymTensor2;
use crate::scene::Pose;

/// A value with a fixed number of bytes.
pub(super) trait Stored: Sized {
    const SIZE: usize;
    fn put(&self, bytes: &mut Vec<u8>);
    /// # Panics
    /// If `bytes` is not `SIZE` long.
    fn get(bytes: &[u8]) -> Self;
}

macro_rules! stored_number {
    ($($number:ty),*) => {$(
        impl Stored for $number {
            const SIZE: usize = size_of::<$number>();
            fn put(&self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_le_bytes());
            }
            fn get(bytes: &[u8]) -> Self {
                Self::from_le_bytes(bytes.try_into().expect("the reader slices SIZE bytes"))
            }
        }
    )*};
}

stored_number!(u8, u32, u64, f64);

impl<T: Stored + Copy + Default, const N: usize> Stored for [T; N] {
    const SIZE: usize = T::SIZE * N;
    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|item| item.put(bytes));
    }
    fn get(bytes: &[u8]) -> Self {
        let mut items = [T::default(); N];
        for (item, bytes) in items.iter_mut().zip(bytes.chunks_exact(T::SIZE)) {
            *item = T::get(bytes);
        }
        items
    }
}

/// Declares a type to be stored as an array of numbers.
macro_rules! stored_as {
    ($type:ty, [$number:ty; $count:literal], |$value:ident| $to:expr, |$array:ident| $from:expr) => {
        impl Stored for $type {
            const SIZE: usize = <[$number; $count]>::SIZE;
            fn put(&self, bytes: &mut Vec<u8>) {
                let $value = self;
                let array: [$number; $count] = $to;
                array.put(bytes);
            }
            fn get(bytes: &[u8]) -> Self {
                let $array = <[$number; $count]>::get(bytes);
                $from
            }
        }
    };
}

stored_as!(DVec2, [f64; 2], |v| v.to_array(), |a| DVec2::from_array(a));
stored_as!(DVec3, [f64; 3], |v| v.to_array(), |a| DVec3::from_array(a));
stored_as!(SymTensor2, [f64; 3], |m| [m.xx, m.xy, m.yy], |a| SymTensor2::new(a[0], a[1], a[2]));
// No corner has index 2^32 - 1: faces have three, and 2^32 - 1 is the first of its face.
stored_as!(Option<u32>, [u32; 1], |o| [o.map_or(0, |i| i + 1)], |a| a[0].checked_sub(1));
stored_as!(
    Pose,
    [f64; 8],
    |p| {
        let (r, t) = (p.rotation, p.translation);
        [p.scale, r.x, r.y, r.z, r.w, t.x, t.y, t.z]
    },
    |a| Pose {
        scale: a[0],
        rotation: DQuat::from_xyzw(a[1], a[2], a[3], a[4]),
        translation: DVec3::new(a[5], a[6], a[7]),
    }
);

/// Appends values.
#[derive(Default)]
pub(super) struct ByteWriter {
    bytes: Vec<u8>,
}

impl ByteWriter {
    pub fn put(&mut self, value: impl Stored) {
        value.put(&mut self.bytes);
    }

    /// # Panics
    /// If the count does not fit in 32 bits: meshes are smaller.
    pub fn count(&mut self, count: usize) {
        self.put(u32::try_from(count).expect("counts in a state fit in 32 bits"));
    }

    /// The items without their count.
    pub fn items<T: Stored>(&mut self, items: &[T]) {
        self.bytes.reserve(items.len() * T::SIZE);
        items.iter().for_each(|item| item.put(&mut self.bytes));
    }

    pub fn text(&mut self, text: &str) {
        self.count(text.len());
        self.bytes.extend_from_slice(text.as_bytes());
    }

    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// Takes values from the front; every failure names the value that was wanted.
pub(super) struct ByteReader<'a> {
    rest: &'a [u8],
}

impl<'a> ByteReader<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    pub fn take(&mut self, what: &'static str, size: usize) -> Result<&'a [u8], StateError> {
        let (taken, rest) = self.rest.split_at_checked(size).ok_or(StateError::TooShort {
            what,
            needed: size as u64,
            left: self.rest.len(),
        })?;
        self.rest = rest;
        Ok(taken)
    }

    pub fn get<T: Stored>(&mut self, what: &'static str) -> Result<T, StateError> {
        Ok(T::get(self.take(what, T::SIZE)?))
    }

    pub fn count(&mut self, what: &'static str) -> Result<usize, StateError> {
        Ok(self.get::<u32>(what)? as usize)
    }

    /// Nothing is reserved for items that are not there.
    pub fn items<T: Stored>(
        &mut self,
        what: &'static str,
        count: usize,
    ) -> Result<Vec<T>, StateError> {
        let bytes = self.take(what, count.saturating_mul(T::SIZE))?;
        Ok(bytes.chunks_exact(T::SIZE).map(T::get).collect())
    }

    /// # Errors
    /// If bytes are left.
    pub fn end(self) -> Result<(), StateError> {
        match self.rest.len() {
            0 => Ok(()),
            count => Err(StateError::Surplus { count }),
        }
    }
}
