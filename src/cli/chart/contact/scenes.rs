//! What is simulated to have steps: slow and fast, with few contacts and with many.

use glam::DVec3;

use super::super::super::args::ShotArgs;
use super::super::super::failure::Failure;
use super::super::super::shot::Shot;
use crate::scene::{Preset, Scene};
use crate::sim::SimSettings;
use crate::stability::{stage, stresses};

/// A scene, and which of its steps are looked at.
pub struct Subject {
    pub name: String,
    pub scene: Scene,
    pub settings: SimSettings,
    /// Simulated after the start.
    pub frames: u32,
    /// The first step after every so many of these.
    pub every: u32,
}

/// Of the stresses, by what they do to contact of cloth with cloth: many layers pressed, small folds
/// drawn through a ring, and a sheet struck by a ball that goes 20 thicknesses a step.
const STRESSES: [(&str, f64); 3] = [("folds", 8.0), ("ring", 0.1), ("obstacle speed", 20.0)];

/// The sheet that is dropped: its side (m), cells along it, how far above the ball's centre, and the
/// ball's radius (m). 39,762 faces.
const SIDE: f64 = 1.0;
const CELLS: u32 = 141;
const HEIGHT: f64 = 0.3;
const RADIUS: f64 = 0.25;
const DROP_FRAMES: u32 = 24;

/// Steps that a scene is looked at in, about.
const STEPS: u32 = 15;

/// The scenes whose name contains the pattern, and the shot if one is given.
pub fn chosen(shot: &ShotArgs, only: Option<&str>) -> anyhow::Result<Vec<Subject>> {
    let is_chosen = |name: &str| only.is_none_or(|pattern| name.contains(pattern));
    let mut chosen = Vec::new();
    if is_chosen("drop") {
        chosen.push(subject("drop", drop(), stage::FIXED, DROP_FRAMES));
    }
    for (name, value) in STRESSES.into_iter().filter(|(name, _)| is_chosen(name)) {
        let stress = stresses().into_iter().find(|s| s.name == name);
        let trial = (stress.expect("it is in the list").trial)(value);
        chosen.push(subject(name, trial.scene, trial.settings, trial.frames));
    }
    if shot.shot.is_some() {
        let shot = Shot::open(shot)?;
        let scene = (*shot.scene).clone();
        if is_chosen(&scene.name) {
            chosen.push(subject(&scene.name.clone(), scene, shot.settings, shot.frames.last));
        }
    }
    if chosen.is_empty() {
        let why = format!("no scene has {:?} in its name", only.unwrap_or_default());
        return Err(Failure::Usage(why).into());
    }
    Ok(chosen)
}

fn subject(name: &str, scene: Scene, settings: SimSettings, frames: u32) -> Subject {
    let every = frames.div_ceil(STEPS).max(1);
    Subject { name: name.to_owned(), scene, settings, frames, every }
}

/// A fine grid of thin, soft cloth that falls on a ball, folds and hangs from it.
fn drop() -> Scene {
    let lines = stage::lines(SIDE, SIDE / f64::from(CELLS));
    let centre = DVec3::new(0.5 * SIDE, 0.5 * SIDE, -HEIGHT);
    let mesh = stage::grid(&lines, &lines, |u| u.extend(0.0));
    let fabric = Preset::named("silk").expect("there is such a preset").fabric();
    let mut scene = stage::scene(mesh, fabric);
    scene.obstacles = vec![stage::obstacle(stage::ball(RADIUS), stage::at(centre))];
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_contact_of_cloth_with_cloth_and_about_as_many_steps() {
        let all = chosen(&ShotArgs::default(), None).unwrap();
        assert_eq!(all.len(), 1 + STRESSES.len());
        for subject in &all {
            assert!(subject.scene.stages.self_contact, "{}", subject.name);
            let steps = subject.frames.div_ceil(subject.every);
            assert!((STEPS / 2..=STEPS).contains(&steps), "{}: {steps}", subject.name);
        }
        assert_eq!(all[0].scene.garments[0].mesh.face_count(), 39_762);
        assert_eq!(chosen(&ShotArgs::default(), Some("ring")).unwrap().len(), 1);
        assert!(chosen(&ShotArgs::default(), Some("no such")).is_err());
    }
}
