//! One viewer at one time: a pinhole camera, resolved.

use glam::{DMat4, DVec2, DVec3};

/// The lens as files give it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Vertical field of view (rad); centred, the image's own aspect.
    FieldOfView { fov_y: f64 },
    /// Focal length, film back and its offset (mm).
    FilmBack { focal_mm: f64, aperture_mm: DVec2, offset_mm: DVec2 },
}

impl Lens {
    /// The film gate on the plane one metre in front of the eye, minimum and maximum (m). The film
    /// back is fitted horizontally: its height follows from the image's aspect, width over height.
    /// A positive offset moves the gate to the right and up.
    pub fn gate(&self, image_aspect: f64) -> [DVec2; 2] {
        let (centre, half) = match *self {
            Lens::FieldOfView { fov_y } => {
                let half_height = (0.5 * fov_y).tan();
                (DVec2::ZERO, DVec2::new(half_height * image_aspect, half_height))
            }
            Lens::FilmBack { focal_mm, aperture_mm, offset_mm } => {
                let half_width = 0.5 * aperture_mm.x / focal_mm;
                (offset_mm / focal_mm, DVec2::new(half_width, half_width / image_aspect))
            }
        };
        [centre - half, centre + half]
    }

    pub(super) fn is_same_kind(&self, other: &Lens) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }

    /// The numbers that move along a path, in a fixed order; those the kind has no use for are 0.
    pub(super) fn components(&self) -> [f64; 5] {
        match *self {
            Lens::FieldOfView { fov_y } => [fov_y, 0.0, 0.0, 0.0, 0.0],
            Lens::FilmBack { focal_mm, aperture_mm: a, offset_mm: o } => {
                [focal_mm, a.x, a.y, o.x, o.y]
            }
        }
    }

    /// A lens of this kind from its numbers; the reverse of `components`.
    pub(super) fn with_components(self, [first, ax, ay, ox, oy]: [f64; 5]) -> Lens {
        match self {
            Lens::FieldOfView { .. } => Lens::FieldOfView { fov_y: first },
            Lens::FilmBack { .. } => Lens::FilmBack {
                focal_mm: first,
                aperture_mm: DVec2::new(ax, ay),
                offset_mm: DVec2::new(ox, oy),
            },
        }
    }
}

/// A pinhole camera at one time. Camera space: x right, y up, looking along -z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// In the world (m).
    pub eye: DVec3,
    /// Unit axes in the world; `back` points from the scene to the eye.
    pub right: DVec3,
    pub up: DVec3,
    pub back: DVec3,
    /// The film gate on the plane one metre in front of the eye: left, bottom and right, top (m).
    pub gate_min: DVec2,
    pub gate_max: DVec2,
    /// Distances of the near and the far plane (m).
    pub near: f64,
    pub far: f64,
    /// Width and height (px).
    pub resolution: [u32; 2],
}

impl View {
    /// In camera space (m).
    pub fn point_in_camera(&self, point_in_world: DVec3) -> DVec3 {
        let d = point_in_world - self.eye;
        DVec3::new(d.dot(self.right), d.dot(self.up), d.dot(self.back))
    }

    /// Pixel coordinates, x to the right and y down from the top left corner; `None` for a point
    /// that is not in front of the near plane. Points outside the frame are projected as well.
    pub fn point_in_image(&self, point_in_world: DVec3) -> Option<DVec2> {
        let p = self.point_in_camera(point_in_world);
        let depth = -p.z;
        (depth >= self.near).then(|| {
            let on_gate = (p.truncate() / depth - self.gate_min) / (self.gate_max - self.gate_min);
            let [width, height] = self.resolution.map(f64::from);
            DVec2::new(on_gate.x * width, (1.0 - on_gate.y) * height)
        })
    }

    /// The clip transform of wgpu: x, y in -1..1, depth in 0..1 from near to far.
    pub fn clip_from_world(&self) -> DMat4 {
        let camera_from_world = DMat4::from_cols(
            DVec3::new(self.right.x, self.up.x, self.back.x).extend(0.0),
            DVec3::new(self.right.y, self.up.y, self.back.y).extend(0.0),
            DVec3::new(self.right.z, self.up.z, self.back.z).extend(0.0),
            DVec3::new(-self.eye.dot(self.right), -self.eye.dot(self.up), -self.eye.dot(self.back))
                .extend(1.0),
        );
        let size = self.gate_max - self.gate_min;
        let centre = (self.gate_max + self.gate_min) / size;
        let depth = self.far / (self.near - self.far);
        let clip_from_camera = DMat4::from_cols_array(&[
            2.0 / size.x,
            0.0,
            0.0,
            0.0,
            0.0,
            2.0 / size.y,
            0.0,
            0.0,
            centre.x,
            centre.y,
            depth,
            -1.0,
            0.0,
            0.0,
            self.near * depth,
            0.0,
        ]);
        clip_from_camera * camera_from_world
    }
}
