//! What a simulation is asked for besides the shot.

use serde::{Deserialize, Serialize};

/// How the resolution of the cloth is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "mode")]
pub enum SizingMode {
    /// A fixed mesh: of the given edge length (m), or of the sizing's finest; the garment's own
    /// where the scene leaves out remeshing.
    Uniform { edge_length: Option<f64> },
    /// As fine as the cloth's shape and motion ask for, whoever looks.
    Adaptive,
    /// As fine as that, where the cameras can see it.
    View,
}

impl SizingMode {
    /// As the command line calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform { .. } => "uniform",
            Self::Adaptive => "adaptive",
            Self::View => "view",
        }
    }
}

/// See the fields.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SimSettings {
    pub sizing: SizingMode,
}

impl Default for SimSettings {
    fn default() -> Self {
        Self { sizing: SizingMode::View }
    }
}
