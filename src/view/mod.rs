//! How fine each part of a garment must be for those who look, and what the rest is spared
//! ([`VD15`](crate::papers::VD15) 3).
//!
//! ```text
//! window        whom to please: each viewer now and over the next frames, on both sides of cuts
//! sight         what one view makes of a face: distance, facing, view factor (eq. 3)
//! silhouette    factors carried across edges to hidden faces (3.3)
//! screen        no finer than the image can show (eqs. 5 to 8)
//! field         all of it combined over the window and the viewers (eqs. 2 and 4)
//! near_frame    how near faces are to the frame, now and soon
//! compensation  how far what nobody sees has buckled between its nodes (eq. 11)
//! ```

mod compensation;
mod field;
mod near_frame;
mod screen;
mod sight;
mod silhouette;
mod window;

pub use compensation::buckling_alphas;
pub use field::{ViewField, view_field};
pub use near_frame::{NearFrame, near_frame};
pub use screen::{screen_clamped, screen_jacobian};
pub use sight::{Facing, Sight, Visibility, facing, nearness, spatial_view_factor};
pub use silhouette::resampled;
pub use window::{ViewSample, ViewerWindow};
