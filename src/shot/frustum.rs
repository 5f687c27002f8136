//! The solid a camera sees.

/// The convex solid between near and far plane and the four sides of the gate.
#[derive(Clone, Debug, PartialEq)]
pub struct Frustum {}
