//! Drawing panes: only what has changed since it was drawn last.

use std::sync::Arc;

use glam::DVec3;

use super::{CachedList, Drawn, Eye, FoundWitness, Pane, Same, Side, Viewports, index, shot_view};
use crate::app::export::seen_in_shape;
use crate::preview::{ColourMode, EyeAndTarget, ImagePlane, Look, Previewer, Scenery};
use crate::render::{
    Bounds, CameraTrail, ColourBy, CrossingMarks, DrawList, Gpu, PictureOptions, RenderError,
    Renderer, STRAIN_LIMIT, ShotCamera, TargetTexture, UiPainter, WITNESS_FOV_Y, WitnessSubject,
    witness_view,
};
use crate::shot::{CameraPath, Lens, View};
use crate::sim::Frame;

/// Size of the picture for which the witness's place is found (px).
const USUAL_SIZE: [u32; 2] = [1280, 720];

impl Viewports {
    /// Builds the lists of what has changed: which panes are to be drawn, and what.
    pub fn prepare(&mut self, previewer: &Previewer) -> Vec<(usize, Wanted)> {
        let Some(scenery) = previewer.scenery().cloned() else { return Vec::new() };
        // One legend is for both sides: their colours wait until both have been seen.
        let frames = [Side::B, Side::A].map(|side| self.frame_to_draw(side, previewer));
        self.ranges.see(frames.iter().flatten(), &scenery);
        let mut wanted = Vec::new();
        for (eye, side) in [
            (Eye::Shot, Side::B),
            (Eye::Witness, Side::B),
            (Eye::Shot, Side::A),
            (Eye::Witness, Side::A),
        ] {
            let Some(size) = self.panes[index(eye, side)].wanted else { continue };
            // Without a frame there is still the camera to be seen.
            let frame = frames[side as usize].clone().unwrap_or_else(|| self.no_frame.clone());
            let camera = camera_of(side, previewer, &scenery);
            let place = index(eye, side);
            let Some(drawn) = self.wanted((eye, side), size, &frame, previewer, &scenery) else {
                self.panes[place].drawn = None;
                continue;
            };
            if self.panes[place].drawn.as_ref() != Some(&drawn) {
                let list = self.list(eye, &frame, &drawn, (&scenery, camera.as_ref()));
                wanted.push((place, Wanted { list, drawn }));
            }
        }
        wanted
    }

    /// A side's frame, if it has one and the layout a place for it.
    fn frame_to_draw(&self, side: Side, previewer: &Previewer) -> Option<Arc<Frame>> {
        let is_wanted = |eye| self.panes[index(eye, side)].wanted.is_some();
        let is_shown = is_wanted(Eye::Shot) || is_wanted(Eye::Witness);
        let frame = match side {
            Side::B => previewer.shown().map(|shown| &shown.frame),
            Side::A => previewer.shown_of_a(),
        };
        frame.filter(|_| is_shown).cloned()
    }

    /// Draws what [`Viewports::prepare`] has prepared.
    ///
    /// # Errors
    /// If the device reports one.
    pub fn draw(
        &mut self,
        wanted: Vec<(usize, Wanted)>,
        gpu: &Gpu,
        renderer: &mut Renderer,
        painter: &mut UiPainter,
    ) -> Result<(), RenderError> {
        for (place, Wanted { list, drawn }) in wanted {
            let pane = &mut self.panes[place];
            pane.resize(gpu, painter, drawn.size);
            let (texture, _) = pane.texture.as_ref().expect("made just now");
            renderer.draw(gpu, &list, &drawn.view, texture.target())?;
            pane.drawn = Some(drawn);
        }
        Ok(())
    }

    /// Where the witness stands and what it looks at; `None` while nothing is known of the cloth.
    pub fn witness_place(&self, previewer: &Previewer) -> Option<EyeAndTarget> {
        previewer.state().witness.or(self.found_witness.as_ref().map(|found| found.place))
    }

    /// The witness's view of a size (px).
    pub fn witness_view(&self, previewer: &Previewer, size: [u32; 2]) -> Option<View> {
        Some(witness(self.witness_place(previewer)?, size))
    }

    /// A place from which the cloth of the current frame fills the witness's view.
    pub fn framed(&self, previewer: &Previewer) -> Option<EyeAndTarget> {
        let bounds = Bounds::of_cloth(&previewer.shown()?.frame);
        let size = self.panes[index(Eye::Witness, Side::B)].wanted.unwrap_or(USUAL_SIZE);
        let place = self.witness_place(previewer)?;
        Some(place.framed([bounds.min, bounds.max], &image_plane(size), 0.1))
    }

    /// How frames are drawn now, for exports.
    pub fn picture_options(&self, previewer: &Previewer) -> Option<PictureOptions> {
        let look = previewer.state().look;
        let scenery = previewer.scenery()?;
        let usual = PictureOptions::default();
        Some(PictureOptions {
            colour_by: self.colour_by(&look, scenery),
            wire_strength: if look.wireframe { usual.wire_strength } else { 0.0 },
            ground_height: self
                .found_witness
                .as_ref()
                .map(|found| found.ground)
                .filter(|_| look.ground),
            crossings: match look.intersections {
                true => CrossingMarks::Magenta,
                false => CrossingMarks::None,
            },
            ..usual
        })
    }

    /// What the colours stand for now.
    pub fn colour_by(&self, look: &Look, scenery: &Scenery) -> ColourBy {
        match look.colour {
            ColourMode::ViewFactor => self.ranges.view_factor(scenery),
            ColourMode::EdgeSize => self.ranges.edge_size(),
            ColourMode::Strain => ColourBy::Strain { limit: STRAIN_LIMIT },
            ColourMode::Velocity => self.ranges.speed(),
            ColourMode::Plain => ColourBy::Plain,
        }
    }

    fn wanted(
        &mut self,
        (eye, side): (Eye, Side),
        size: [u32; 2],
        frame: &Arc<Frame>,
        previewer: &Previewer,
        scenery: &Arc<Scenery>,
    ) -> Option<Drawn> {
        self.find_witness(frame, previewer, scenery);
        let look = Look {
            // What concerns the layout alone changes no picture.
            layout: Default::default(),
            parameters_panel: false,
            cost_panel: false,
            help_panel: false,
            files_panel: false,
            save_panel: false,
            export_panel: false,
            legend: false,
            safe_areas: false,
            ..previewer.state().look
        };
        let camera = camera_of(side, previewer, scenery);
        let current = f64::from(previewer.state().playback.current);
        let shot = match side {
            Side::B => shot_view(previewer, scenery),
            Side::A => camera.as_ref().map(|path| path.view(current)),
        };
        let view = match eye {
            // A's picture stands where B's does, whatever the shape of its gate.
            Eye::Shot if side == Side::A => seen_in_shape(shot?, size),
            Eye::Shot => shot?,
            Eye::Witness => witness(self.witness_place(previewer)?, size),
        };
        let ahead = current + anticipation_of(side, previewer, scenery);
        let ghost = camera.as_ref().filter(|_| look.ghost).map(|path| path.view(ahead));
        Some(Drawn {
            frame: Same(frame.clone()),
            scenery: Same(scenery.clone()),
            view,
            shot: shot.filter(|_| eye == Eye::Witness),
            ghost: ghost.filter(|_| eye == Eye::Witness),
            look,
            colour: self.colour_by(&look, scenery),
            marked: look.intersections && self.crossings.of(frame, scenery).is_some(),
            size,
        })
    }

    fn list(
        &mut self,
        eye: Eye,
        frame: &Arc<Frame>,
        drawn: &Drawn,
        (scenery, camera): (&Arc<Scenery>, Option<&Arc<CameraPath>>),
    ) -> DrawList {
        let mut list = self.base_list(frame, drawn, scenery).clone();
        if drawn.marked
            && let Some(crossings) = self.crossings.of(frame, scenery)
        {
            list.push_crossings(&crossings, &frame.garments, drawn.view.eye);
        }
        match (eye, &drawn.shot) {
            (Eye::Shot, _) => list.ground_lines.clear(),
            (Eye::Witness, Some(shot)) => {
                let no_trail = CameraTrail::default();
                let camera = ShotCamera {
                    view: shot,
                    trail: camera.map_or(&no_trail, |camera| self.trail(camera, scenery.last)),
                    frustum_depth: ShotCamera::frustum_depth_past(shot, Bounds::of_cloth(frame)),
                    ghost: drawn.ghost.as_ref(),
                };
                list.push_shot_camera(&camera, drawn.view.eye);
            }
            (Eye::Witness, None) => {}
        }
        list
    }

    /// What both eyes see of a frame.
    fn base_list(&mut self, frame: &Arc<Frame>, drawn: &Drawn, scenery: &Scenery) -> &DrawList {
        /// Of A and of B.
        const LISTS_KEPT: usize = 2;
        let fits = |cached: &CachedList| {
            (&cached.frame, &cached.scenery) == (&drawn.frame, &drawn.scenery)
                && (cached.look, cached.colour) == (drawn.look, drawn.colour)
        };
        if let Some(place) = self.lists.iter().position(fits) {
            return &self.lists[place].list;
        }
        let ground = self.found_witness.as_ref().map(|found| found.ground);
        let options = PictureOptions {
            colour_by: drawn.colour,
            wire_strength: if drawn.look.wireframe {
                PictureOptions::default().wire_strength
            } else {
                0.0
            },
            ground_height: ground.filter(|_| drawn.look.ground),
            ..PictureOptions::default()
        };
        let list = DrawList::new(frame, &scenery.surfaces, &options);
        if self.lists.len() == LISTS_KEPT {
            self.lists.remove(0);
        }
        self.lists.push(CachedList {
            frame: drawn.frame.clone(),
            scenery: drawn.scenery.clone(),
            look: drawn.look,
            colour: drawn.colour,
            list,
        });
        &self.lists.last().expect("pushed just now").list
    }

    fn trail(&mut self, path: &Arc<CameraPath>, last: u32) -> &CameraTrail {
        /// Of A and of B.
        const TRAILS_KEPT: usize = 2;
        if let Some(place) = self.trails.iter().position(|(of, _)| Arc::ptr_eq(of, path)) {
            return &self.trails[place].1;
        }
        if self.trails.len() == TRAILS_KEPT {
            self.trails.remove(0);
        }
        self.trails.push((path.clone(), CameraTrail::of(path, last)));
        &self.trails.last().expect("pushed just now").1
    }

    /// Finds the witness's place from the first cloth that is there; it stays while the shot is open.
    fn find_witness(&mut self, frame: &Frame, previewer: &Previewer, scenery: &Scenery) {
        if self.found_witness.is_some() || previewer.shown().is_none() {
            return;
        }
        let cloth = Bounds::of_cloth(frame);
        let frames = scenery.last as usize + 1;
        let frames = (0..frames).map(|frame| frame as u32);
        let subject = WitnessSubject::of(cloth, scenery.camera.as_deref(), frames)
            .with_obstacles(frame, &scenery.surfaces);
        let size = self.panes[index(Eye::Witness, Side::B)].wanted.unwrap_or(USUAL_SIZE);
        let view = witness_view(&subject, size);
        let distance = view.eye.distance(subject.cloth.centre());
        self.found_witness = Some(FoundWitness {
            place: EyeAndTarget::of_view(&view, distance),
            ground: subject.cloth.min.z,
        });
    }
}

/// A picture to be drawn.
pub struct Wanted {
    list: DrawList,
    drawn: Drawn,
}

impl Pane {
    fn resize(&mut self, gpu: &Gpu, painter: &mut UiPainter, size: [u32; 2]) {
        match &mut self.texture {
            Some((texture, _)) if texture.size() == size => {}
            Some((texture, id)) => {
                *texture = TargetTexture::new(gpu, size);
                painter.replace(gpu, *id, texture);
            }
            None => {
                let texture = TargetTexture::new(gpu, size);
                let id = painter.register(gpu, &texture);
                self.texture = Some((texture, id));
            }
        }
    }
}

/// The camera that a side's frames were simulated for: their detail is right through no other.
fn camera_of(side: Side, previewer: &Previewer, scenery: &Scenery) -> Option<Arc<CameraPath>> {
    let of_a = previewer.state().a.as_ref().filter(|_| side == Side::A);
    of_a.map_or_else(|| scenery.camera.clone(), |a| a.camera.clone())
}

/// The longest look-ahead that a side's frames were simulated with (frames).
fn anticipation_of(side: Side, previewer: &Previewer, scenery: &Scenery) -> f64 {
    let of_a = previewer.state().a.as_ref().filter(|_| side == Side::A);
    of_a.map_or_else(|| scenery.anticipation(), |a| a.anticipation)
}

/// What the witness sees from a place.
pub(super) fn witness(place: EyeAndTarget, size: [u32; 2]) -> View {
    place.view(&image_plane(size))
}

fn image_plane(size: [u32; 2]) -> ImagePlane {
    let lens = Lens::FieldOfView { fov_y: WITNESS_FOV_Y };
    ImagePlane { lens, resolution: size, pixel_aspect: 1.0 }
}

/// A view through the same lens from another place.
pub(super) fn placed(view: &View, place: EyeAndTarget) -> View {
    let back = (place.eye - place.target).try_normalize().unwrap_or(view.back);
    let right = DVec3::Z.cross(back).try_normalize().unwrap_or(view.right);
    View { eye: place.eye, right, up: back.cross(right), back, ..*view }
}

/// The shot camera as a place: it looks at the cloth's distance.
pub(super) fn place_of(view: &View, previewer: &Previewer) -> EyeAndTarget {
    if let Some(place) = previewer.state().dragged_camera {
        return place;
    }
    let centre = previewer.shown().map(|shown| Bounds::of_cloth(&shown.frame).centre());
    let distance = centre.map_or(1.0, |centre| -view.point_in_camera(centre).z);
    EyeAndTarget::of_view(view, if distance > view.near { distance } else { 1.0 })
}
