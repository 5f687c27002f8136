//! The shot camera: dragged, keyed, cut.

use std::num::NonZeroU32;

use glam::DVec3;

use super::Previewer;
use crate::preview::Plan;
use crate::preview::action::Action;
use crate::preview::camera_edit::{
    CameraEdit, CameraEditError, Cut, LensScope, LensValue, Placement, camera_setting,
};
use crate::preview::navigate::EyeAndTarget;
use crate::preview::state::Level;
use crate::shot::View;

/// How far in front of a baked camera its targets are put (m); it looks the same at any distance.
const TARGET_DISTANCE: f64 = 2.0;

impl Previewer {
    pub(super) fn act_on_camera(&mut self, action: Action) {
        match action {
            Action::UnlockCamera { on: true } if self.open.plan.is_none() => self.say_finished(),
            Action::UnlockCamera { on } => {
                self.state.camera_unlocked = on;
                self.state.dragged_camera = None;
            }
            Action::MoveCamera { eye, target } => {
                self.state.dragged_camera = Some(EyeAndTarget { eye, target });
            }
            Action::MakeKeys { every } => {
                let every = NonZeroU32::new(every).unwrap_or(NonZeroU32::MIN);
                self.edit_camera_of(|plan| {
                    let scene = &plan.requested.scene;
                    CameraEdit::keyed(plan.resolved(), scene, every, TARGET_DISTANCE)
                });
            }
            action => {
                let (frame, place) = (self.state.playback.current, self.state.dragged_camera);
                self.edit_camera_of(|plan| edited(plan, &action, frame, place));
            }
        }
    }

    fn say_finished(&mut self) {
        self.state.say(Level::Note, "this is a finished run: open its shot to move the camera");
    }

    /// Puts an edited camera into force, or says why it cannot be so.
    fn edit_camera_of(&mut self, edit: impl FnOnce(&Plan) -> Result<CameraEdit, CameraEditError>) {
        let Some(plan) = self.open.plan.clone() else {
            self.state.dragged_camera = None;
            return self.say_finished();
        };
        match edit(&plan) {
            Ok(camera) => {
                let path = camera_setting(&plan.requested.written);
                let before = CameraEdit::of_shot(plan.resolved(), &plan.requested.scene);
                if before.as_ref() != Ok(&camera) {
                    if self.state.version.edits.get(path).is_none() {
                        self.planning.unedited_camera = before.ok().map(|camera| camera.json());
                    }
                    self.edit_camera(path, camera.json());
                }
            }
            Err(error) => {
                self.state.dragged_camera = None;
                self.say_until_planned(Level::Warning, error.to_string());
            }
        }
    }
}

fn edited(
    plan: &Plan,
    action: &Action,
    current: u32,
    dragged: Option<EyeAndTarget>,
) -> Result<CameraEdit, CameraEditError> {
    let camera = CameraEdit::of_shot(plan.resolved(), &plan.requested.scene)?;
    match *action {
        Action::SetKey => {
            let frame = f64::from(current);
            if dragged.is_none() && camera.keys().iter().any(|key| key.frame == frame) {
                // It stands where the camera is.
                return Ok(camera);
            }
            camera.set_key(frame, placement(&camera, frame, dragged), None)
        }
        Action::DeleteKey { frame } => camera.delete_key(frame),
        Action::MoveKey { from, to } => camera.move_key(from, to),
        Action::SetCut { frame, cut } => {
            camera.set_cut(frame, if cut { Cut::Yes } else { Cut::No })
        }
        Action::SetFocalLength { frame, focal_mm } => {
            with_lens(&camera, frame, LensValue::FocalMm(focal_mm))
        }
        Action::SetFieldOfView { frame, degrees } => {
            with_lens(&camera, frame, LensValue::FovYDeg(degrees))
        }
        ref other => unreachable!("{other:?} is about other things"),
    }
}

/// At a frame without a key there is one then.
fn with_lens(
    camera: &CameraEdit,
    frame: Option<f64>,
    lens: LensValue,
) -> Result<CameraEdit, CameraEditError> {
    match frame {
        None => camera.set_lens(LensScope::WholePath, lens),
        Some(frame) if camera.keys().iter().any(|key| key.frame == frame) => {
            camera.set_lens(LensScope::Key(frame), lens)
        }
        Some(frame) => camera.set_key(frame, placement(camera, frame, None), Some(lens)),
    }
}

/// Where a key is to stand: where the camera has been dragged to, else where it is on its path.
fn placement(camera: &CameraEdit, frame: f64, dragged: Option<EyeAndTarget>) -> Placement {
    match dragged {
        Some(EyeAndTarget { eye, target }) => Placement { eye, target, up: DVec3::Z },
        None => {
            let view = camera.path().view(frame);
            // As far as the nearest key looks, so that the targets move evenly.
            let nearest = camera
                .keys()
                .iter()
                .min_by(|a, b| (a.frame - frame).abs().total_cmp(&(b.frame - frame).abs()));
            let distance = nearest.map_or(TARGET_DISTANCE, |key| {
                DVec3::from_array(key.eye).distance(DVec3::from_array(key.target))
            });
            let target = view.eye - view.back * distance;
            Placement { eye: view.eye, target, up: up_of(&view) }
        }
    }
}

/// Straight up, where the camera does not roll: then the key says nothing of it.
fn up_of(view: &View) -> DVec3 {
    /// Cosine of a roll that is none.
    const UPRIGHT: f64 = 1.0 - 1e-9;
    let level = DVec3::Z.cross(view.back).normalize_or_zero();
    if level.dot(view.right) > UPRIGHT { DVec3::Z } else { view.up }
}
