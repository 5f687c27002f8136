//! How fine each part of a garment must be, whoever looks.
#[allow(missing_docs)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    pub point: glam::DVec3,
    pub normal: glam::DVec3,
}
