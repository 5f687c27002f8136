//! How fine each part of a garment must be for those who look.
