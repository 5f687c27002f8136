//! Once a frame: how fine must each garment be, and the remeshing to it.

use super::clock::{Stage, StageClock};
use super::frame::FrameReport;
use super::{PerFace, Simulation, SizingMode};
use crate::collision::{ClothGuard, ObstacleGuard, ObstacleMotion, nearest_planes};
use crate::math::SymTensor2;
use crate::mesh::{IdVec, Mesh, NodeId};
use crate::remesh::{Change, EditGuard, RemeshReport, RemeshSettings, remesh};
use crate::sizing::{Plane, base_metric, faces_to_vertices};
use crate::view::{ViewerWindow, buckling_alphas, view_field};

/// Obstacles farther away than this many contact thicknesses do not refine the cloth
/// ([`NSO12`](crate::papers::NSO12)).
const OBSTACLE_RANGE_IN_THICKNESSES: f64 = 10.0;

/// Keeps faces out of obstacles, and out of other cloth.
struct SurfaceGuard<'a> {
    obstacles: ObstacleGuard<'a>,
    cloth: Option<ClothGuard>,
}

impl EditGuard for SurfaceGuard<'_> {
    fn allows(&self, change: &Change) -> bool {
        self.obstacles.allows(change) && self.cloth.as_ref().is_none_or(|c| c.allows(change))
    }

    fn note(&self, change: &Change) {
        if let Some(cloth) = &self.cloth {
            cloth.note(change);
        }
    }
}

impl Simulation {
    /// Sizes and remeshes every garment at the current frame, then renews the moving cloth.
    pub(super) fn refine(&mut self, clock: &mut StageClock, report: &mut FrameReport) {
        let obstacles = self.obstacles_at_rest();
        let cloth = clock.time(Stage::Remesh, || self.cloth_guard());
        let guard = SurfaceGuard { obstacles: ObstacleGuard { obstacles: &obstacles }, cloth };
        let mut edits = 0;
        for index in 0..self.garments.len() {
            let planes = clock.time(Stage::Sizing, || self.planes(index, &obstacles));
            let base = clock.time(Stage::Sizing, || self.base_metric(index, &planes));
            clock.time(Stage::View, || self.set_metric(index, base));
            let done = clock.time(Stage::Remesh, || self.remesh(index, &guard));
            edits += done.edit_count();
            self.note(index, done, report);
        }
        if edits > 0 {
            clock.time(Stage::Remesh, || self.cloth.renew(&self.scene, &self.garments));
            self.warn_of_bending(report);
        }
    }

    /// Names the garments that do not bend by the model they are to bend by.
    pub(super) fn warn_of_bending(&self, report: &mut FrameReport) {
        for index in self.cloth.system.bending_fallbacks() {
            let name = &self.scene.garments[index].name;
            let warning = format!(
                "garment {name:?} bends by mid-edge normals: the compliance of its moments cannot be factorised"
            );
            // Rounds of refinement before frame 0 would repeat it.
            if !report.warnings.contains(&warning) {
                report.warnings.push(warning);
            }
        }
    }

    fn note(&self, index: usize, done: RemeshReport, report: &mut FrameReport) {
        let counts = &mut report.counts;
        counts.splits += done.splits as u64;
        counts.collapses += done.collapses as u64;
        counts.flips += done.flips as u64;
        counts.vetoes += done.vetoes as u64;
        if done.invalid_edges > 0 {
            report.warnings.push(format!(
                "garment {:?}: {} edges stay too long at the limit of {} faces",
                self.scene.garments[index].name,
                done.invalid_edges,
                RemeshSettings::default().face_count_max
            ));
        }
    }

    /// Remeshes every garment to edges of one length: that asked for, or its sizing's finest.
    pub(super) fn make_uniform(
        &mut self,
        edge_length: Option<f64>,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) {
        let obstacles = self.obstacles_at_rest();
        let cloth = clock.time(Stage::Remesh, || self.cloth_guard());
        let guard = SurfaceGuard { obstacles: ObstacleGuard { obstacles: &obstacles }, cloth };
        for index in 0..self.garments.len() {
            let length = edge_length.unwrap_or(self.scene.garments[index].sizing.edge_length_min);
            let metric = SymTensor2::isotropic(1.0 / (length * length));
            let mesh = &mut self.garments[index];
            mesh.metric = IdVec::filled(metric, mesh.vertex_count());
            let done = clock.time(Stage::Remesh, || self.remesh(index, &guard));
            self.note(index, done, report);
        }
        clock.time(Stage::Remesh, || self.cloth.renew(&self.scene, &self.garments));
    }

    fn planes(&self, index: usize, obstacles: &[ObstacleMotion]) -> IdVec<NodeId, Option<Plane>> {
        let range = OBSTACLE_RANGE_IN_THICKNESSES * self.scene.contact.thickness;
        nearest_planes(self.garments[index].position.as_slice(), obstacles, range).into()
    }

    fn base_metric(
        &self,
        index: usize,
        planes: &IdVec<NodeId, Option<Plane>>,
    ) -> PerFace<SymTensor2> {
        base_metric(&self.garments[index], &self.scene.garments[index].sizing, planes)
    }

    /// Whom a garment is to please at the current frame.
    fn windows(&self, index: usize) -> Vec<ViewerWindow> {
        match self.settings.sizing {
            SizingMode::View => {
                let ahead = self.scene.garments[index].view.anticipation_frames;
                let window = |path| ViewerWindow::new(path, f64::from(self.frame), ahead);
                self.scene.viewers.iter().map(window).collect()
            }
            SizingMode::Adaptive | SizingMode::Uniform { .. } => Vec::new(),
        }
    }

    /// Takes what nobody sees for buckled, as it is now, over the frame that begins.
    pub(super) fn compensate_buckling(&mut self) {
        let of_garment = |index: usize| {
            let settings = &self.scene.garments[index].view;
            buckling_alphas(&self.garments[index], &self.windows(index), settings).into_vec()
        };
        let alphas: Vec<f64> = (0..self.garments.len()).flat_map(of_garment).collect();
        self.cloth.system.set_compensation(&alphas);
    }

    /// The view-dependent metric at the vertices, and the view factor of every face.
    fn set_metric(&mut self, index: usize, base: PerFace<SymTensor2>) {
        let garment = &self.scene.garments[index];
        let windows = self.windows(index);
        let mesh = &mut self.garments[index];
        let field =
            view_field(mesh, &base, &windows, &garment.view, garment.two_sided, &garment.sizing);
        mesh.metric = faces_to_vertices(mesh, &field.metric);
        mesh.view_factor = field.factor;
    }

    /// Of all garments as they are; `None` where cloth may pass through cloth.
    fn cloth_guard(&self) -> Option<ClothGuard> {
        let stages = &self.scene.stages;
        let faces =
            |mesh: &Mesh| mesh.face_ids().map(|f| mesh.face_positions(f)).collect::<Vec<_>>();
        (stages.self_contact && stages.collision)
            .then(|| ClothGuard::new(self.garments.iter().flat_map(faces).collect()))
    }

    fn remesh(&mut self, index: usize, guard: &SurfaceGuard<'_>) -> RemeshReport {
        let garment = &self.scene.garments[index];
        let aspect_min = garment.sizing.aspect_min;
        let mut settings = RemeshSettings { aspect_min, ..RemeshSettings::default() };
        if self.scene.stages.strain_limiting
            && let Some(ratios) = garment.fabric.strain_limits()
        {
            settings = settings.within(ratios);
        }
        let mesh = std::mem::take(&mut self.garments[index]);
        let (mesh, report) = remesh(mesh, &settings, guard);
        self.garments[index] = mesh;
        report
    }
}
