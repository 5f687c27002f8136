//! How fine each part of a garment must be, whoever looks.
