//! How cloth moves: energies, their derivatives, and one implicit step.
#[allow(missing_docs)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    pub nodes: [(usize, f64); 4],
    pub normal: glam::DVec3,
    pub gap: f64,
    pub surface_velocity: glam::DVec3,
    pub stiffness: f64,
    pub friction: f64,
}
impl ContactPoint {
    #[allow(missing_docs)]
    pub fn weighted(nodes: &[(usize, f64)]) -> [(usize, f64); 4] {
        let mut padded = [(0, 0.0); 4];
        padded[..nodes.len()].copy_from_slice(nodes);
        padded
    }
}
