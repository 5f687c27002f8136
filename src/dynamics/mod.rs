//! How cloth moves: energies, their derivatives, and one implicit step.
