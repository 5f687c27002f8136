//! Takes cloth apart that passes through cloth: untangling by minimising the length of the contours
//! along which it does ([`VMT06`](crate::papers::VMT06)).
//!
//! Needs no inside and no history. In rounds: what crosses is found, [`point`]s of crossing are
//! ordered to [`contours`], nodes [`moves`] so that contours grow shorter, a little each round and no
//! farther than the fabric stands ([`bounded`]). The best state of all rounds is kept, so that
//! nothing gets worse.
//!
//! Where cloth cuts an obstacle, the obstacle's inside tells: [`cuts`].

mod bounded;
mod contours;
mod cuts;
mod moves;
mod point;
mod regions;
mod rounds;
mod stop;

pub use contours::contour_count;
pub use cuts::{Cut, CutNodes, cuts, lift_cuts};
pub use moves::Method;
pub use rounds::{Limits, Round, TangledCloth, Untangling, untangle};
pub use stop::stop_at_crossings;

#[cfg(test)]
mod tests;
