//! ARCSim 0.2 scenes, translated to the native shot file: from there on there is one way, with one
//! set of checks. Values keep the place where the scene wrote them.

mod bodies;
mod cloth;
mod fields;

use std::path::{Path, PathBuf};

use super::document::Node;
use super::error::{LoadError, Problem};
use super::native::SHOT_VERSION;
use super::source::{Reader, joined};
use fields::{Fields, json, list, object};

/// What the format assumes for a scene that does not say.
mod default {
    pub const FRICTION_CLOTH: f64 = 0.6;
    pub const FRICTION_OBSTACLE: f64 = 0.3;
    /// (m).
    pub const REPULSION_THICKNESS: f64 = 1e-3;
    /// (N/m per m^2).
    pub const COLLISION_STIFFNESS: f64 = 1e9;
    /// (N/m).
    pub const HANDLE_STIFFNESS: f64 = 1e3;
}

/// Stages by their names here and there.
const STAGES: [(&str, &str); 6] = [
    ("proximity", "proximity"),
    ("physics", "dynamics"),
    ("strainlimiting", "strain_limiting"),
    ("collision", "collision"),
    ("remeshing", "remeshing"),
    ("separation", "untangling"),
];

/// A scene on its way to a shot file.
pub(super) struct Import<'a> {
    pub reader: &'a Reader<'a>,
    /// The shot's folder.
    pub folder: &'a Path,
    /// The folder the scene's paths start from, seen from the shot's folder.
    pub base: PathBuf,
    pub warnings: &'a mut Vec<String>,
}

impl<'a> Import<'a> {
    /// `scene_path` is seen from the shot's `folder`. The scene's own paths start above its folder
    /// (`conf`), or in it if the first mesh is only found there.
    pub fn new(
        scene: &Node,
        scene_path: &Path,
        folder: &'a Path,
        reader: &'a Reader<'a>,
        warnings: &'a mut Vec<String>,
    ) -> Self {
        let inside = scene_path.parent().unwrap_or(Path::new("")).to_path_buf();
        let above = joined(&inside, Path::new(".."));
        let mesh = scene.at("cloths.0.mesh").and_then(Node::as_str).unwrap_or_default();
        let is_in = |base: &Path| reader.is_file(&joined(folder, &base.join(mesh)));
        let base = if !is_in(&above) && is_in(&inside) { inside } else { above };
        Self { reader, folder, base, warnings }
    }

    /// # Errors
    /// What has no meaning as a scene; values are checked later, like those of a native shot.
    pub fn shot(&mut self, scene: &Node) -> Result<Node, LoadError> {
        let place = &scene.place;
        let mut fields = Fields::new(scene, "the scene")?;
        let (fps, steps) = timing(&mut fields)?;
        let mut shot = vec![
            ("shotsilk", json(place, SHOT_VERSION)),
            ("fps", fps.clone()),
            ("steps_per_frame", steps),
            ("gravity", fields.take_or("gravity", [0.0; 3])),
        ];
        if let Some(frames) = last_frame(&mut fields, fps.deserialize()?)? {
            shot.push(("frames", frames));
        }
        shot.extend(self.surroundings(&mut fields)?);
        if let Some(disabled) = fields.take("disable") {
            shot.push(("disable", self.disabled(disabled)?));
        }
        let (garments, fabrics) = self.cloths(&mut fields)?;
        shot.push(("garments", garments));
        shot.push(("fabrics", fabrics));
        let (motions, motion_count) = self.motions(&mut fields)?;
        shot.push(("motions", motions));
        shot.push(("obstacles", self.obstacles(&mut fields, motion_count)?));
        shot.push(("handles", self.handles(&mut fields)?));
        fields.finish(self.warnings);
        Ok(object(place, shot))
    }

    /// Air and contact.
    fn surroundings(
        &mut self,
        scene: &mut Fields<'_>,
    ) -> Result<Vec<(&'static str, Node)>, LoadError> {
        let place = scene.place();
        let mut parts = Vec::new();
        if let Some(wind) = scene.take("wind") {
            let mut fields = Fields::new(wind, "wind")?;
            let air = object(
                &wind.place,
                [
                    ("density", fields.take_or("density", 1.0)),
                    ("velocity", fields.take_or("velocity", [0.0; 3])),
                    ("tangential_drag", fields.take_or("drag", 0.0)),
                ],
            );
            fields.finish(self.warnings);
            parts.push(("air", air));
        }
        let friction_cloth = scene.take_or("friction", default::FRICTION_CLOTH);
        let friction_obstacle = scene.take_or("obs_friction", default::FRICTION_OBSTACLE);
        let nothing = object(&place, []);
        let mut magic = Fields::new(scene.take("magic").unwrap_or(&nothing), "magic")?;
        let contact = object(
            &place,
            [
                ("thickness", magic.take_or("repulsion_thickness", default::REPULSION_THICKNESS)),
                ("stiffness", magic.take_or("collision_stiffness", default::COLLISION_STIFFNESS)),
                ("friction_cloth", friction_cloth),
                ("friction_obstacle", friction_obstacle),
            ],
        );
        parts.push(("contact", contact));
        let handle_stiffness = magic.take_or("handle_stiffness", default::HANDLE_STIFFNESS);
        parts.push(("handle_stiffness", handle_stiffness));
        magic.finish(self.warnings);
        Ok(parts)
    }

    fn disabled(&mut self, disabled: &Node) -> Result<Node, LoadError> {
        let mut names = Vec::new();
        for name in list(disabled) {
            match STAGES.iter().find(|(theirs, _)| name.as_str() == Some(theirs)) {
                Some((_, ours)) => names.push(json(&name.place, *ours)),
                None => {
                    let found: serde_json::Value = name.deserialize()?;
                    self.warnings.push(format!("{}: there is no module {found}", name.place));
                }
            }
        }
        Ok(Node { place: disabled.place.clone(), value: super::document::Value::Array(names) })
    }

    /// A path of the scene, seen from the shot's folder; other values stay as they are.
    fn path(&self, node: &Node) -> Node {
        match node.as_str() {
            Some(path) => {
                let path = joined(&self.base, Path::new(path)).to_string_lossy().into_owned();
                json(&node.place, path)
            }
            None => node.clone(),
        }
    }
}

/// Frames per second and steps per frame.
fn timing(scene: &mut Fields<'_>) -> Result<(Node, Node), LoadError> {
    let (frame, step) = (scene.take("frame_time"), scene.take("timestep"));
    let (time, steps) = match (frame, step) {
        (Some(frame), _) => (frame, scene.take_or("frame_steps", 1)),
        (None, Some(step)) => (step, scene.take_or("save_frames", 1)),
        (None, None) => {
            let (thing, needed) = ("the scene".into(), "frame_time, or timestep and save_frames");
            return Err(Problem::Missing { thing, needed }.at(scene.place()));
        }
    };
    let mut seconds: f64 = time.deserialize()?;
    if frame.is_none() {
        seconds *= steps.deserialize::<f64>()?;
    }
    if !(seconds > 0.0) {
        let (thing, limit) = ("the time of a frame".into(), "greater than 0".into());
        let problem = Problem::OutOfRange { thing, value: seconds.to_string(), limit };
        return Err(problem.at(time.place.clone()));
    }
    Ok((json(&time.place, whole_if_close(1.0 / seconds)), steps))
}

/// 25 for 24.999999999999996: the decimal time of a frame was rounded.
fn whole_if_close(number: f64) -> f64 {
    let whole = number.round();
    if (number - whole).abs() < 1e-9 * whole { whole } else { number }
}

/// The earliest of the ends that the scene names.
fn last_frame(scene: &mut Fields<'_>, fps: f64) -> Result<Option<Node>, LoadError> {
    let mut frames: Option<Node> = scene.take("end_frame").cloned();
    for name in ["end_time", "duration"] {
        let Some(node) = scene.take(name) else { continue };
        let by_time = (node.deserialize::<f64>()? * fps).round();
        if !(0.0..=f64::from(u32::MAX)).contains(&by_time) {
            let (thing, limit) = (name.to_owned(), "at least 0 and at most 2^32 frames".to_owned());
            let value = by_time.to_string();
            return Err(Problem::OutOfRange { thing, value, limit }.at(node.place.clone()));
        }
        let earlier = match &frames {
            Some(frames) => by_time < frames.deserialize::<f64>()?,
            None => true,
        };
        if earlier {
            frames = Some(json(&node.place, by_time as u32));
        }
    }
    Ok(frames)
}
