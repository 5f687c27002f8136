//! Numbers that look random and are the same in every run.

use glam::{DVec2, DVec3};

/// Reproducible numbers (splitmix64, which is public domain).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// In [-1, 1).
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// In the square [-1, 1)^2.
    pub fn in_square(&mut self) -> DVec2 {
        DVec2::new(self.number(), self.number())
    }

    /// In the cube [-1, 1)^3.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_numbers_are_those_of_splitmix64() {
        // Its first two outputs from seed 0.
        let mut random = Random::new(0);
        for output in [0xe220_a839_7b1d_cdaf_u64, 0x6e78_9e6a_a1b9_65f4] {
            assert_eq!(random.number(), (output >> 11) as f64 * 2f64.powi(-52) - 1.0);
        }
    }
}
