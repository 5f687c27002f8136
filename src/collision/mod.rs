//! Where cloth meets obstacles.
