//! Numbers that are joined into sets.

/// Disjoint sets of the numbers from 0, each known by its smallest member, whatever the order of
/// joining.
#[derive(Clone, Debug)]
pub struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    /// Every number by itself.
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    /// The smallest member of a number's set. Halves the way there for the next time.
    pub fn root(&mut self, number: usize) -> usize {
        let mut at = number;
        while self.parent[at] as usize != at {
            self.parent[at] = self.parent[self.parent[at] as usize];
            at = self.parent[at] as usize;
        }
        at
    }

    /// Makes one set of two numbers' sets: the roots of what stays and of what went into it; `None` if
    /// they were one already.
    pub fn join(&mut self, a: usize, b: usize) -> Option<[usize; 2]> {
        let (a, b) = (self.root(a), self.root(b));
        let (kept, other) = (a.min(b), a.max(b));
        self.parent[other] = kept as u32;
        (kept != other).then_some([kept, other])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_known_by_their_smallest_member_whatever_the_order() {
        for pairs in [[(5, 3), (1, 5), (4, 2)], [(4, 2), (5, 1), (3, 1)]] {
            let mut sets = DisjointSets::new(6);
            let joined = pairs.map(|(a, b)| sets.join(a, b).is_some());
            assert_eq!(joined, [true; 3]);
            assert_eq!([0, 1, 2, 3, 4, 5].map(|n| sets.root(n)), [0, 1, 2, 1, 2, 1]);
            assert_eq!(sets.join(3, 5), None);
        }
    }
}
