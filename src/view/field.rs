//! The view-dependent metric of a garment, for all who look, now and soon.

use super::{
    Sight, ViewSample, ViewerWindow, Visibility, resampled, screen_clamped, screen_jacobian,
};
use crate::math::{SymTensor2, tensor_max};
use crate::mesh::{FaceId, IdVec, Mesh};
use crate::scene::{SizingSettings, ViewRule, ViewSettings};

/// What the viewers make of each face of a garment.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewField {
    /// M_vd (1/m^2).
    pub metric: IdVec<FaceId, SymTensor2>,
    /// nu(t) of eq. 4 after resampling, the largest of all viewers; 0..1, to be shown.
    pub factor: IdVec<FaceId, f64>,
}

/// The sizing field for those who look ([`VD15`](crate::papers::VD15) 3.1 to 3.3).
///
/// By [`ViewRule::WholeMetric`], M_vd(t) is the tensor maximum over viewers and tau of
/// w(tau)^2 C(nu~(t+tau)^2 M), with nu~ (resampled at silhouettes) and the clamp C of the camera at
/// t + tau. By [`ViewRule::Papers`], the clamp of the first viewer's present camera on nu(t)^2 M.
/// Without viewers the base metric stands.
pub fn view_field(
    mesh: &Mesh,
    base: &IdVec<FaceId, SymTensor2>,
    windows: &[ViewerWindow],
    settings: &ViewSettings,
    two_sided: bool,
    sizing: &SizingSettings,
) -> ViewField {
    assert_eq!(base.len(), mesh.face_count(), "there is a base metric for every face");
    let Some(first) = windows.first() else { return unseen(base) };
    let look = Look { mesh, base, settings, two_sided, aspect_min: sizing.aspect_min };
    match settings.rule {
        ViewRule::WholeMetric => look.whole_metric(windows),
        ViewRule::Papers => look.as_in_the_papers(first),
    }
}

/// The field of a garment at which nobody looks.
fn unseen(base: &IdVec<FaceId, SymTensor2>) -> ViewField {
    ViewField { metric: base.clone(), factor: IdVec::filled(1.0, base.len()) }
}

/// Carries nu(t) = max over tau of w(tau) nu~(t+tau) on by one tau
/// ([`VD15`](crate::papers::VD15) eq. 4).
fn anticipate(nu: &mut IdVec<FaceId, f64>, weight: f64, sights: &IdVec<FaceId, Sight>) {
    for (nu, sight) in nu.iter_mut().zip(sights) {
        *nu = nu.max(weight * sight.factor);
    }
}

/// All that does not change from view to view.
struct Look<'a> {
    mesh: &'a Mesh,
    base: &'a IdVec<FaceId, SymTensor2>,
    settings: &'a ViewSettings,
    two_sided: bool,
    aspect_min: f64,
}

impl Look<'_> {
    fn whole_metric(&self, windows: &[ViewerWindow]) -> ViewField {
        let mut field = self.nothing_seen();
        // Per face the largest s for which the metric is known to be at least s M.
        let mut full_scale = IdVec::filled(0.0, self.mesh.face_count());
        for sample in windows.iter().flat_map(ViewerWindow::samples) {
            let sights = self.sights(sample);
            let factors = self.resampled(&sights.iter().map(|s| s.factor).collect(), &sights);
            for face in self.mesh.face_ids() {
                let nu = factors[face];
                let weighted = sample.weight * nu;
                field.factor[face] = field.factor[face].max(weighted);
                let scale = weighted * weighted;
                if scale <= full_scale[face] {
                    continue;
                }
                let wanted = self.base[face] * (nu * nu);
                let shown = self.clamped(wanted, face, sample, sights[face].visibility);
                if shown == wanted {
                    full_scale[face] = scale;
                }
                let shown = shown * (sample.weight * sample.weight);
                field.metric[face] = tensor_max(field.metric[face], shown);
            }
        }
        for metric in field.metric.iter_mut() {
            *metric = metric.with_aspect_at_least(self.aspect_min);
        }
        field
    }

    /// nu(t) of eq. 4, resampled (3.3); M~ = nu^2 M (eq. 2); then the clamp (eqs. 5 to 8)
    /// ([`VD15`](crate::papers::VD15)).
    fn as_in_the_papers(&self, window: &ViewerWindow) -> ViewField {
        let mut field = self.nothing_seen();
        let present = window.present();
        let now = self.sights(present);
        let mut nu: IdVec<FaceId, f64> = now.iter().map(|s| s.factor).collect();
        for sample in &window.samples()[1..] {
            anticipate(&mut nu, sample.weight, &self.sights(sample));
        }
        field.factor = self.resampled(&nu, &now);
        for face in self.mesh.face_ids() {
            let wanted = self.base[face] * field.factor[face].powi(2);
            field.metric[face] = self.clamped(wanted, face, present, now[face].visibility);
        }
        field
    }

    /// What the maximum over views starts from.
    fn nothing_seen(&self) -> ViewField {
        let count = self.mesh.face_count();
        ViewField {
            metric: IdVec::filled(SymTensor2::ZERO, count),
            factor: IdVec::filled(0.0, count),
        }
    }

    /// Every face in one view.
    fn sights(&self, sample: &ViewSample) -> IdVec<FaceId, Sight> {
        let see = |face: FaceId| {
            let triangle = self.mesh.face_positions(face);
            Sight::of(triangle, sample, self.settings, self.two_sided)
        };
        self.mesh.face_ids().map(see).collect()
    }

    fn resampled(
        &self,
        factor: &IdVec<FaceId, f64>,
        sights: &IdVec<FaceId, Sight>,
    ) -> IdVec<FaceId, f64> {
        let is_visible = |face: FaceId| sights[face].visibility != Visibility::Hidden;
        resampled(self.mesh, factor, is_visible, self.settings.silhouette_threshold)
    }

    /// C: the screen clamp where it applies, and the least aspect restored after it.
    fn clamped(
        &self,
        metric: SymTensor2,
        face: FaceId,
        sample: &ViewSample,
        visibility: Visibility,
    ) -> SymTensor2 {
        if visibility != Visibility::Visible {
            return metric;
        }
        let corners = self.mesh.face_positions(face);
        let shapes = self.mesh.shape_gradients(face);
        let Some(jacobian) = screen_jacobian(&sample.view, corners, shapes) else { return metric };
        let shown = screen_clamped(metric, jacobian, self.settings.min_screen_edge_px);
        if shown == metric { metric } else { shown.with_aspect_at_least(self.aspect_min) }
    }
}

#[cfg(test)]
#[path = "field_tests.rs"]
mod tests;
