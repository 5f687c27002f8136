//! Typed indices, and arrays that only their own kind of index opens.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

/// A dense index into one of the mesh's arrays.
pub trait Id: Copy + Eq + Ord + fmt::Debug {
    fn from_index(index: usize) -> Self;
    fn index(self) -> usize;
}

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(u32);

        impl Id for $name {
            /// # Panics
            /// If the index does not fit in 32 bits.
            fn from_index(index: usize) -> Self {
                Self(u32::try_from(index).expect("a mesh has fewer than 2^32 elements of a kind"))
            }
            fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!(stringify!($name), " {}"), self.0)
            }
        }
    };
}

id!(
    /// A point of the cloth in the world.
    NodeId
);
id!(
    /// A point of the flat cloth: a node on a seam has several.
    VertexId
);
id!(
    /// A triangle.
    FaceId
);
id!(
    /// One of the three corners of a face; it names the edge opposite to it as well.
    CornerId
);

impl FaceId {
    /// The face's corner at position 0, 1 or 2.
    pub fn corner(self, position: usize) -> CornerId {
        debug_assert!(position < 3);
        CornerId(self.0 * 3 + position as u32)
    }

    pub fn corners(self) -> [CornerId; 3] {
        [0, 1, 2].map(|k| self.corner(k))
    }
}

impl CornerId {
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// 0, 1 or 2: where in the face the corner stands.
    pub fn position(self) -> usize {
        (self.0 % 3) as usize
    }

    /// The next corner of the face, counter-clockwise.
    pub fn next(self) -> CornerId {
        CornerId(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    pub fn previous(self) -> CornerId {
        CornerId(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }
}

/// A flat array which is indexed by one kind of id.
#[derive(Clone, PartialEq)]
pub struct IdVec<I, T> {
    items: Vec<T>,
    kind: PhantomData<fn() -> I>,
}

impl<I: Id, T> IdVec<I, T> {
    pub fn new() -> Self {
        Self::from(Vec::new())
    }

    pub fn filled(value: T, count: usize) -> Self
    where
        T: Clone,
    {
        Self::from(vec![value; count])
    }

    pub fn len(&self) -> usize {
        self.items.len()
    }

    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    pub fn push(&mut self, value: T) -> I {
        self.items.push(value);
        I::from_index(self.items.len() - 1)
    }

    pub fn get(&self, id: I) -> Option<&T> {
        self.items.get(id.index())
    }

    pub fn ids(&self) -> impl DoubleEndedIterator<Item = I> + ExactSizeIterator + use<I, T> {
        (0..self.items.len()).map(I::from_index)
    }

    pub fn iter(&self) -> std::slice::Iter<'_, T> {
        self.items.iter()
    }

    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, T> {
        self.items.iter_mut()
    }

    pub fn enumerate(&self) -> impl Iterator<Item = (I, &T)> {
        self.items.iter().enumerate().map(|(i, t)| (I::from_index(i), t))
    }

    pub fn as_slice(&self) -> &[T] {
        &self.items
    }

    pub fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.items
    }

    pub fn into_vec(self) -> Vec<T> {
        self.items
    }

    /// The items changed one by one.
    pub fn map<U>(self, change: impl FnMut(T) -> U) -> IdVec<I, U> {
        self.items.into_iter().map(change).collect()
    }

    /// Drops the items for which `keep` is false, the order of the others unchanged.
    pub fn retain_by(&mut self, keep: impl Fn(I) -> bool) {
        let mut index = 0;
        self.items.retain(|_| {
            index += 1;
            keep(I::from_index(index - 1))
        });
    }
}

impl<I: Id, T> Default for IdVec<I, T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<I, T> From<Vec<T>> for IdVec<I, T> {
    fn from(items: Vec<T>) -> Self {
        Self { items, kind: PhantomData }
    }
}

impl<I, T> FromIterator<T> for IdVec<I, T> {
    fn from_iter<A: IntoIterator<Item = T>>(iter: A) -> Self {
        Self::from(Vec::from_iter(iter))
    }
}

impl<'a, I, T> IntoIterator for &'a IdVec<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.items.iter()
    }
}

impl<I: Id, T> Index<I> for IdVec<I, T> {
    type Output = T;
    fn index(&self, id: I) -> &T {
        &self.items[id.index()]
    }
}

impl<I: Id, T> IndexMut<I> for IdVec<I, T> {
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.items[id.index()]
    }
}

impl<I, T: fmt::Debug> fmt::Debug for IdVec<I, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.items.fmt(f)
    }
}
