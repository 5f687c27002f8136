//! Motions, obstacles and handles.

use std::path::Path;

use super::Import;
use super::fields::{Fields, array, json, list, object};
use crate::scene::document::{Node, Value};
use crate::scene::error::{LoadError, Problem};
use crate::scene::mot::bodies_from_mot;
use crate::scene::numbered::numbered;
use crate::scene::source::joined;

impl Import<'_> {
    /// Motions by number, and how many there are.
    pub(super) fn motions(&mut self, scene: &mut Fields<'_>) -> Result<(Node, usize), LoadError> {
        let place = scene.place();
        let motions = match scene.take("motions") {
            None => Vec::new(),
            Some(node) if matches!(node.value, Value::Object(_)) => self.motion_file(node)?,
            Some(node) => {
                list(node).iter().map(|keys| self.keys(keys)).collect::<Result<_, _>>()?
            }
        };
        let names: Vec<String> = (0..motions.len()).map(|k| k.to_string()).collect();
        let count = motions.len();
        Ok((object(&place, names.iter().map(String::as_str).zip(motions)), count))
    }

    fn keys(&mut self, keys: &Node) -> Result<Node, LoadError> {
        let mut translated = Vec::new();
        for key in list(keys) {
            let mut fields = Fields::new(key, "a keyframe")?;
            let mut parts = Vec::new();
            parts.extend(fields.take("time").map(|time| ("time", time.clone())));
            for name in ["transform", "velocity"] {
                if let Some(node) = fields.take(name) {
                    parts.push((name, self.transform(node)?));
                }
            }
            fields.finish(self.warnings);
            translated.push(object(&key.place, parts));
        }
        Ok(object(&keys.place, [("keys", array(&keys.place, translated))]))
    }

    /// One motion for each body of a file.
    fn motion_file(&mut self, node: &Node) -> Result<Vec<Node>, LoadError> {
        let mut fields = Fields::new(node, "motions")?;
        let Some(file) = fields.take("motfile").map(|file| self.path(file)) else {
            let (thing, needed) = ("motions".into(), "a list of keyframes, or a motfile");
            return Err(Problem::Missing { thing, needed }.at(node.place.clone()));
        };
        let mut parts = vec![("file", file.clone())];
        parts.extend(fields.take("fps").map(|fps| ("fps", fps.clone())));
        if let Some(transform) = fields.take("transform") {
            parts.push(("transform", self.transform(transform)?));
        }
        fields.finish(self.warnings);
        let path = joined(self.folder, Path::new(&file.deserialize::<String>()?));
        let text = self.reader.text(&path).map_err(|e| e.or_at(&file.place))?;
        let count = bodies_from_mot(&path.to_string_lossy(), &text)?.len();
        let of_body = |body: usize| {
            let body = [("body", json(&node.place, body))];
            object(&node.place, parts.iter().cloned().chain(body))
        };
        Ok((0..count).map(of_body).collect())
    }

    pub(super) fn obstacles(
        &mut self,
        scene: &mut Fields<'_>,
        motion_count: usize,
    ) -> Result<Node, LoadError> {
        let place = scene.place();
        let Some(node) = scene.take("obstacles") else { return Ok(array(&place, Vec::new())) };
        if let Some(pattern) = node.as_str() {
            return self.numbered_obstacles(node, pattern, motion_count);
        }
        let mut obstacles = Vec::new();
        for obstacle in list(node) {
            let mut fields = Fields::new(obstacle, "an obstacle")?;
            let mut parts = Vec::new();
            parts.extend(fields.take("mesh").map(|mesh| ("mesh", self.path(mesh))));
            if let Some(transform) = fields.take("transform") {
                parts.push(("transform", self.transform(transform)?));
            }
            parts.extend(motion(&mut fields)?);
            fields.finish(self.warnings);
            obstacles.push(object(&obstacle.place, parts));
        }
        Ok(array(&node.place, obstacles))
    }

    /// As many parts as files exist from 0; part i follows motion i.
    fn numbered_obstacles(
        &self,
        node: &Node,
        pattern: &str,
        motion_count: usize,
    ) -> Result<Node, LoadError> {
        let mut obstacles = Vec::new();
        loop {
            let index = obstacles.len();
            let Some(name) = numbered(pattern, index) else { break };
            let mesh = self.path(&json(&node.place, name));
            let path = joined(self.folder, Path::new(mesh.as_str().unwrap_or_default()));
            if !self.reader.is_file(&path) {
                break;
            }
            let mut parts = vec![("mesh", mesh)];
            if index < motion_count {
                parts.push(("motion", json(&node.place, index.to_string())));
            }
            obstacles.push(object(&node.place, parts));
        }
        if obstacles.is_empty() {
            let thing = format!("the pattern {pattern:?}");
            let needed = "one %d, as in part%04d.obj, and a file with the number 0";
            return Err(Problem::Missing { thing, needed }.at(node.place.clone()));
        }
        Ok(array(&node.place, obstacles))
    }

    pub(super) fn handles(&mut self, scene: &mut Fields<'_>) -> Result<Node, LoadError> {
        let place = scene.place();
        let nothing = array(&place, Vec::new());
        let mut handles = Vec::new();
        for handle in list(scene.take("handles").unwrap_or(&nothing)) {
            let mut fields = Fields::new(handle, "a handle")?;
            let nodes = fields.take("nodes").or(fields.take("vertices"));
            let mut parts = Vec::new();
            parts.extend(nodes.map(|nodes| ("nodes", nodes.clone())));
            parts.extend(fields.take("cloth").map(|cloth| ("garment", cloth.clone())));
            parts.extend(motion(&mut fields)?);
            for name in ["start_time", "end_time"] {
                parts.extend(fields.take(name).map(|time| (name, time.clone())));
            }
            fields.finish(self.warnings);
            handles.push(object(&handle.place, parts));
        }
        Ok(array(&place, handles))
    }
}

/// The name of a motion given by number.
fn motion(fields: &mut Fields<'_>) -> Result<Option<(&'static str, Node)>, LoadError> {
    let Some(node) = fields.take("motion") else { return Ok(None) };
    let index: u32 = node.deserialize()?;
    let name = json(&node.place, index.to_string());
    Ok(Some(("motion", name)))
}
