//! What drawing and captions need to know of what is open, be it a shot or a run.

use std::sync::Arc;

use super::Plan;
use crate::run::RunReader;
use crate::scene::{Surface, ViewSettings, recorded_viewers};
use crate::shot::CameraPath;

/// See the module.
#[derive(Clone, Debug)]
pub struct Scenery {
    pub name: String,
    /// Frames per second.
    pub fps: f64,
    /// What frame 0 is called.
    pub first_frame: i64,
    /// Number of the last frame.
    pub last: u32,
    /// The shot camera, where there is one.
    pub camera: Option<Arc<CameraPath>>,
    /// The obstacles at rest.
    pub surfaces: Vec<Arc<Surface>>,
    /// One for each garment.
    pub view_settings: Vec<ViewSettings>,
    /// The hash that a run with the settings in force carries.
    pub settings_hash: String,
}

impl Scenery {
    pub fn of_plan(plan: &Plan) -> Self {
        let scene = &plan.requested.scene;
        Self {
            name: scene.name.clone(),
            fps: scene.fps,
            first_frame: scene.first_frame,
            last: plan.last(),
            camera: plan.camera().cloned().map(Arc::new),
            surfaces: plan.surfaces(),
            view_settings: plan.view_settings(),
            settings_hash: plan.settings_hash().to_owned(),
        }
    }

    /// A run without a camera that can be read has none.
    pub fn of_run(run: &RunReader) -> Self {
        let info = run.info();
        let viewers = recorded_viewers(&info.settings).unwrap_or_default();
        let garments = info.settings["garments"].as_array();
        let view = |g: &serde_json::Value| serde_json::from_value(g["view"].clone()).ok();
        Self {
            name: info.shot.clone(),
            fps: info.fps,
            first_frame: info.first_frame,
            last: run.last_frame().unwrap_or(0),
            camera: viewers.into_iter().next().map(Arc::new),
            surfaces: run.obstacles(),
            view_settings: garments.into_iter().flatten().filter_map(view).collect(),
            settings_hash: info.input_hash.clone(),
        }
    }

    /// A frame's number as captions show it.
    pub fn shown(&self, frame: u32) -> i64 {
        self.first_frame + i64::from(frame)
    }

    /// The longest look-ahead of the garments (frames).
    pub fn anticipation(&self) -> f64 {
        self.view_settings.iter().map(|v| v.anticipation_frames).fold(0.0, f64::max)
    }
}
