//! What `render` and `sheet` share: the two views of a frame.

use anyhow::{Result, anyhow};
use clap::{Args, ValueEnum};
use glam::DVec3;
use image::RgbaImage;

use super::failure::Failure;
use super::footage::Footage;
use crate::preview::{EyeAndTarget, ImagePlane};
use crate::render::{
    AdapterChoice, Bounds, CameraTrail, ColourBy, CrossingMarks, Edges, Headless, PictureOptions,
    STRAIN_LIMIT, SeenRanges, ShotCamera, WITNESS_FOV_Y, WitnessSubject, size_of_width,
    witness_view,
};
use crate::shot::{CameraPath, Lens, View};
use crate::sim::Frame;

/// How frames are drawn.
#[derive(Args, Clone, Debug)]
pub struct PictureArgs {
    /// What the colour of the cloth shows
    #[arg(long, value_enum, default_value_t = Colour::ViewFactor)]
    pub colour: Colour,
    /// The graphics adapter: software, hardware, or part of a name
    #[arg(long, default_value = "software")]
    pub adapter: AdapterChoice,
    /// Place of the witness camera and what it looks at, in metres; without it one is found
    #[arg(long, value_name = "X,Y,Z:X,Y,Z", value_parser = parse_witness, allow_hyphen_values = true)]
    pub witness: Option<EyeAndTarget>,
    /// How the edges of the mesh are coloured
    #[arg(long, value_enum, default_value_t = EdgeColour::Dark)]
    pub edges: EdgeColour,
    /// Mark faces that pass through other cloth or obstacles in magenta
    #[arg(long)]
    pub crossings: bool,
    /// Leave out the edges of the mesh
    #[arg(long)]
    pub no_wireframe: bool,
}

/// `--colour`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Colour {
    /// The view factor, blue where the camera looks to red where it cannot see
    ViewFactor,
    /// The mean edge length of each face
    EdgeSize,
    /// Stretch and compression
    Strain,
    /// How fast the cloth moves
    Velocity,
    /// The fabric
    Plain,
}

/// `--edges`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum EdgeColour {
    /// Darker than the cloth
    Dark,
    /// By the shot camera's frame: visible blue, turned away grey, within the margin cyan, farther
    /// green
    Frame,
}

/// Draws both views of the frames of a footage.
pub struct Studio<'a> {
    footage: &'a Footage,
    camera: CameraPath,
    gpu: Headless,
    witness: View,
    trail: CameraTrail,
    cloth: Bounds,
    options: PictureOptions,
}

impl<'a> Studio<'a> {
    /// Pictures will be `width` wide (px); `None` takes the shot's own resolution.
    ///
    /// # Errors
    /// If a frame cannot be read.
    pub fn new(
        footage: &'a Footage,
        gpu: Headless,
        args: &PictureArgs,
        width: Option<u32>,
    ) -> Result<Self> {
        let camera = footage.camera().clone();
        let first_view = camera.view(f64::from(footage.frames()[0]));
        let size = width.map_or(first_view.resolution, |w| size_of_width(&first_view, w));
        let subject = subject(footage, &camera)?;
        let witness = match args.witness {
            Some(place) => placed_witness(place, size),
            None => witness_view(&subject, size),
        };
        let defaults = PictureOptions::default();
        let options = PictureOptions {
            size: Some(size),
            colour_by: colour_by(args.colour, footage)?,
            edges: match args.edges {
                EdgeColour::Dark => Edges::Dark,
                EdgeColour::Frame => Edges::ByFrame(footage.view_settings()),
            },
            crossings: match args.crossings {
                true => CrossingMarks::Magenta,
                false => CrossingMarks::None,
            },
            wire_strength: if args.no_wireframe { 0.0 } else { defaults.wire_strength },
            ground_height: Some(subject.cloth.min.z),
            ..defaults
        };
        let trail = CameraTrail::of(&camera, *footage.frames().last().unwrap_or(&0));
        Ok(Self { footage, camera, gpu, witness, trail, cloth: subject.cloth, options })
    }

    pub fn options_mut(&mut self) -> &mut PictureOptions {
        &mut self.options
    }

    pub fn colour_by(&self) -> ColourBy {
        self.options.colour_by
    }

    /// What the shot camera sees.
    ///
    /// # Errors
    /// If the device fails.
    pub fn shot(&mut self, frame: &Frame) -> Result<RgbaImage> {
        let view = self.camera.view(f64::from(frame.number));
        let surfaces = self.footage.surfaces();
        // The ground is the witness's: the shot shows what is in the scene.
        let options = PictureOptions { ground_height: None, ..self.options.clone() };
        Ok(self.gpu.picture(frame, &surfaces, &view, &options).map_err(Failure::from)?)
    }

    /// What the witness sees, the shot camera with it.
    ///
    /// # Errors
    /// If the device fails.
    pub fn witness(&mut self, frame: &Frame) -> Result<RgbaImage> {
        let view = self.camera.view(f64::from(frame.number));
        let camera = ShotCamera {
            view: &view,
            trail: &self.trail,
            frustum_depth: ShotCamera::frustum_depth_past(&view, self.cloth),
            ghost: None,
        };
        let surfaces = self.footage.surfaces();
        let picture =
            self.gpu.witness_picture(frame, &surfaces, &self.witness, &camera, &self.options);
        Ok(picture.map_err(Failure::from)?)
    }
}

/// The cloth over all frames with the obstacles near it, and the shot camera's views.
fn subject(footage: &Footage, camera: &CameraPath) -> Result<WitnessSubject> {
    let (mut cloth, mut last) = (Bounds::EMPTY, None);
    for &number in footage.frames() {
        let frame = footage.frame(number)?;
        cloth = cloth.union(Bounds::of_cloth(&frame));
        last = Some(frame);
    }
    let subject = WitnessSubject::of(cloth, Some(camera), footage.frames().iter().copied());
    Ok(match last {
        Some(frame) => subject.with_obstacles(&frame, &footage.surfaces()),
        None => subject,
    })
}

fn colour_by(colour: Colour, footage: &Footage) -> Result<ColourBy> {
    Ok(match colour {
        Colour::ViewFactor => ColourBy::view_factor(&footage.view_settings()),
        Colour::EdgeSize => seen_ranges(footage)?.edge_size(),
        Colour::Strain => ColourBy::Strain { limit: STRAIN_LIMIT },
        Colour::Velocity => seen_ranges(footage)?.speed(),
        Colour::Plain => ColourBy::Plain,
    })
}

/// Over all frames.
fn seen_ranges(footage: &Footage) -> Result<SeenRanges> {
    let mut seen = SeenRanges::default();
    for &number in footage.frames() {
        seen.see(&footage.frame(number)?);
    }
    Ok(seen)
}

fn placed_witness(place: EyeAndTarget, size: [u32; 2]) -> View {
    let lens = Lens::FieldOfView { fov_y: WITNESS_FOV_Y };
    place.view(&ImagePlane { lens, resolution: size, pixel_aspect: 1.0 })
}

fn parse_witness(text: &str) -> Result<EyeAndTarget> {
    let point = |part: &str| -> Result<DVec3> {
        let numbers: Vec<f64> = part
            .split(',')
            .map(|n| n.trim().parse::<f64>().ok().filter(|n| n.is_finite()))
            .collect::<Option<_>>()
            .ok_or_else(|| anyhow!("{part:?} is not three numbers X,Y,Z"))?;
        <[f64; 3]>::try_from(numbers)
            .map(DVec3::from_array)
            .map_err(|n| anyhow!("{part:?} has {} numbers, not three", n.len()))
    };
    let (eye, target) = text
        .split_once(':')
        .ok_or_else(|| anyhow!("{text:?} has no ':' between the place and what it looks at"))?;
    let place = EyeAndTarget { eye: point(eye)?, target: point(target)? };
    if (place.target - place.eye).truncate() == glam::DVec2::ZERO {
        return Err(anyhow!("{text:?} looks straight up or down, or nowhere"));
    }
    Ok(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_witness_is_two_points() {
        let place = parse_witness("1,-2,3:0,0,0.5").unwrap();
        assert_eq!(place.eye, DVec3::new(1.0, -2.0, 3.0));
        assert_eq!(place.target, DVec3::new(0.0, 0.0, 0.5));
        for text in ["1,2,3", "1,2:3,4,5", "1,2,x:0,0,0", "1,2,3:1,2,3", "0,0,4:0,0,0"] {
            assert!(parse_witness(text).is_err(), "{text:?}");
        }
    }
}
