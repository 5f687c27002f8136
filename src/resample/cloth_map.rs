//! A frame in which points of the flat cloth can be found.

use std::sync::Arc;

use glam::DVec3;
use thiserror::Error;

use super::locate::{Locator, MaterialPoint};
use crate::mesh::FaceId;
use crate::sim::Frame;

/// A point of a garment's flat cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClothPoint {
    pub garment: usize,
    pub material: MaterialPoint,
}

/// A frame, and where in its garments' meshes the flat cloth is.
#[derive(Debug)]
pub struct ClothMap {
    frame: Frame,
    locators: Vec<Locator>,
}

/// Why the points of one frame are not to be found in another.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ClothMismatch {
    #[error("one has {reference} garments, the other {other}")]
    GarmentCount { reference: usize, other: usize },
    #[error(
        "garment {garment} is cut from {reference} pieces in one, from {other} others in the other"
    )]
    Panels { garment: usize, reference: usize, other: usize },
}

impl ClothMap {
    pub fn new(frame: Frame) -> Self {
        let locators = frame.garments.iter().map(|mesh| Locator::new(Arc::clone(mesh))).collect();
        Self { frame, locators }
    }

    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    pub fn locators(&self) -> &[Locator] {
        &self.locators
    }

    /// # Errors
    /// If the garments are not the same.
    pub fn check_same_cloth(&self, other: &Self) -> Result<(), ClothMismatch> {
        let counts = [self.locators.len(), other.locators.len()];
        if let [reference, other] = counts
            && reference != other
        {
            return Err(ClothMismatch::GarmentCount { reference, other });
        }
        for (garment, (a, b)) in self.locators.iter().zip(&other.locators).enumerate() {
            let (a, b) = (a.panels(), b.panels());
            if !a.agree_with(b) {
                let (reference, other) = (a.count(), b.count());
                return Err(ClothMismatch::Panels { garment, reference, other });
            }
        }
        Ok(())
    }

    /// The point of the flat cloth at a place of a garment's face.
    ///
    /// # Panics
    /// If there is no such garment or face.
    pub fn cloth_point(&self, garment: usize, face: FaceId, barycentric: [f64; 3]) -> ClothPoint {
        ClothPoint { garment, material: self.locators[garment].material_point(face, barycentric) }
    }

    /// Where in the world a point of the flat cloth is (m).
    ///
    /// # Panics
    /// If there is no such garment or panel; see [`ClothMap::check_same_cloth`].
    pub fn point_in_world(&self, point: ClothPoint) -> DVec3 {
        self.locators[point.garment].point_in_world(point.material)
    }
}
