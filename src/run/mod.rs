//! The folder a simulation writes: settings, exact states, statistics.
