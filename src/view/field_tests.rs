use glam::{DVec2, DVec3};

use super::*;
use crate::shot::tests::{key, path, still};
use crate::shot::{CameraKey, CameraPath, Frustum};
use crate::sizing::tests::{flat, sheet};
use crate::view::{Facing, NearFrame, facing, near_frame, spatial_view_factor};

/// A square metre in the xz plane around the origin, seen from -y by its front.
fn curtain() -> Mesh {
    sheet(10, 10, 0.1, |u| DVec3::new(u.x - 0.5, 0.0, u.y - 0.5))
}

/// The same, whose columns beyond the middle are folded back behind it, their backs to the viewer.
fn folded() -> Mesh {
    sheet(10, 10, 0.1, |u| {
        let x = u.x - 0.5;
        if x <= 0.0 { DVec3::new(x, 0.0, u.y - 0.5) } else { DVec3::new(-x, 0.5 * x, u.y - 0.5) }
    })
}

fn base(mesh: &Mesh) -> IdVec<FaceId, SymTensor2> {
    IdVec::filled(SymTensor2::new(900.0, 50.0, 400.0), mesh.face_count())
}

struct Case {
    mesh: Mesh,
    settings: ViewSettings,
    two_sided: bool,
}

impl Case {
    fn new(mesh: Mesh) -> Self {
        Self { mesh, settings: ViewSettings::default(), two_sided: false }
    }

    fn field(&self, windows: &[ViewerWindow]) -> ViewField {
        let (mesh, sizing) = (&self.mesh, SizingSettings::default());
        view_field(mesh, &base(mesh), windows, &self.settings, self.two_sided, &sizing)
    }

    fn at(&self, path: &CameraPath, frame: f64) -> ViewField {
        self.field(&[self.window(path, frame)])
    }

    fn near(&self, windows: &[ViewerWindow]) -> IdVec<FaceId, NearFrame> {
        near_frame(&self.mesh, windows, self.settings.margin_m)
    }

    fn near_at(&self, path: &CameraPath, frame: f64) -> IdVec<FaceId, NearFrame> {
        self.near(&[self.window(path, frame)])
    }

    fn window(&self, path: &CameraPath, frame: f64) -> ViewerWindow {
        ViewerWindow::new(path, frame, self.settings.anticipation_frames)
    }
}

fn finer_or_equal(a: SymTensor2, b: SymTensor2) -> bool {
    (a - b).eigen().values[1] >= -1e-9 * (a.trace() + b.trace())
}

fn size(m: SymTensor2) -> f64 {
    m.xx.abs() + m.xy.abs() + m.yy.abs()
}

fn close_up() -> CameraKey {
    key(0.0, DVec3::Y * -2.0, DVec3::ZERO)
}

fn wide() -> CameraKey {
    CameraKey { eye: DVec3::Y * -19.0, ..close_up() }
}

fn looking_away() -> CameraKey {
    CameraKey { eye: DVec3::Y * -5.0, target: DVec3::Y * -10.0, ..close_up() }
}

/// The first view until frame 10, then the second.
fn cut_at_10(first: CameraKey, second: CameraKey) -> CameraPath {
    path(vec![first, CameraKey { frame: 10.0, cut: true, ..second }])
}

#[test]
fn without_viewers_the_base_metric_stands() {
    let case = Case::new(curtain());
    let field = case.field(&[]);
    assert_eq!(field.metric, base(&case.mesh));
    assert!(field.factor.iter().all(|&nu| nu == 1.0));
}

#[test]
fn a_garment_close_by_in_frame_is_not_coarsened() {
    let case = Case::new(curtain());
    let field = case.at(&path(vec![close_up()]), 0.0);
    assert_eq!(field.metric, base(&case.mesh));
    assert!(field.factor.iter().all(|&nu| nu == 1.0));
    let near = case.near_at(&path(vec![close_up()]), 0.0);
    assert!(near.iter().all(|n| n.presence == 1.0));
    assert!(near.iter().all(|n| n.out_of_frame_distance == 0.0));
}

#[test]
fn a_garment_behind_the_camera_has_the_least_factor() {
    let case = Case::new(curtain());
    let field = case.at(&path(vec![looking_away()]), 0.0);
    let near = case.near_at(&path(vec![looking_away()]), 0.0);
    for face in case.mesh.face_ids() {
        assert_eq!(field.factor[face], 0.01);
        assert!(size(field.metric[face] - base(&case.mesh)[face] * 1e-4) < 1e-12);
        assert!(near[face].out_of_frame_distance >= 0.4 && near[face].presence == 0.0);
    }
}

#[test]
fn a_distant_garment_is_cut_to_what_the_image_shows() {
    let case = Case::new(curtain());
    let field = case.at(&path(vec![wide()]), 0.0);
    let px_per_metre = 270.0 / 20f64.to_radians().tan() / 19.0;
    for (m, b) in field.metric.iter().zip(&base(&case.mesh)) {
        let finest = (px_per_metre / 4.0).powi(2);
        assert!((m.eigen().values[0] / finest - 1.0).abs() < 0.01, "{m:?}");
        assert!(finer_or_equal(*b, *m));
    }
}

#[test]
fn edge_on_faces_are_finite_and_keep_the_least_aspect() {
    let mesh = sheet(10, 10, 0.1, |u| DVec3::new(u.x - 0.5, u.y - 0.5, 0.0));
    for height in [0.0, 1e-9, 0.01] {
        let eye = DVec3::new(0.0, -5.0, height);
        let field = Case::new(mesh.clone()).at(&path(vec![CameraKey { eye, ..close_up() }]), 0.0);
        for m in &field.metric {
            let [large, small] = m.eigen().values;
            assert!(m.is_finite() && small >= 0.04 * large * (1.0 - 1e-9), "{m:?}");
        }
    }
}

#[test]
fn faces_across_the_near_plane_keep_the_base_metric() {
    let mut shot = path(vec![wide()]);
    // The whole curtain stands a little before and behind the near plane.
    shot.near = 19.0;
    shot.far = 40.0;
    let mesh = sheet(1, 1, 1.0, |u| DVec3::new(u.x - 0.5, u.y - 0.5, u.y - 0.5));
    let case = Case::new(mesh);
    let field = case.at(&shot, 0.0);
    assert_eq!(field.metric, base(&case.mesh));
}

#[test]
fn a_hard_edge_has_no_values_between() {
    let mut case = Case::new(curtain());
    case.settings.margin_m = 0.0;
    case.settings.silhouette_threshold = 10.0;
    let half = CameraKey { eye: DVec3::new(0.9, -2.0, 0.0), target: DVec3::X * 0.9, ..close_up() };
    let field = case.at(&path(vec![half]), 0.0);
    let count = |nu: f64| field.factor.iter().filter(|&&v| v == nu).count();
    assert!(count(1.0) > 0 && count(0.01) > 0);
    assert_eq!(count(1.0) + count(0.01), case.mesh.face_count());
}

#[test]
fn the_back_of_a_garment_is_coarse_unless_it_is_two_sided() {
    let mut case = Case::new(folded());
    let shot = path(vec![close_up()]);
    let field = case.at(&shot, 0.0);
    let is_back = |f: FaceId| facing(close_up().eye, case.mesh.face_positions(f)) == Facing::Back;
    let backs: Vec<FaceId> = case.mesh.face_ids().filter(|&f| is_back(f)).collect();
    assert_eq!(backs.len(), 100);
    let count = |nu: f64| backs.iter().filter(|&&f| (field.factor[f] - nu).abs() < 1e-12).count();
    // One row of faces along the fold takes the average.
    assert_eq!((count(0.2), count(0.6)), (90, 10));
    case.two_sided = true;
    assert!(case.at(&shot, 0.0).factor.iter().all(|&nu| nu == 1.0));
}

/// Eq. 4 by its definition, over a dense tau and on both sides of every sample.
fn brute_force_factor(case: &Case, shot: &CameraPath, frame: f64, face: FaceId) -> f64 {
    let (s, triangle) = (&case.settings, case.mesh.face_positions(face));
    let nu = |view: crate::shot::View| {
        let d = Frustum::of(&view).distance_to_triangle(triangle);
        let front = facing(view.eye, triangle) == Facing::Front;
        let nu_facing = if front { s.nu_front } else { s.nu_back };
        spatial_view_factor(nu_facing, s.nu_out, s.margin_m, d)
    };
    (0..=500)
        .map(|i| f64::from(i) / 500.0)
        .map(|x| {
            let moment = frame + x * s.anticipation_frames;
            let before = if x > 0.0 { nu(shot.view_before(moment)) } else { 0.0 };
            (1.0 - x) * nu(shot.view(moment)).max(before)
        })
        .fold(0.0, f64::max)
}

#[test]
fn the_factor_is_that_of_a_dense_search_of_the_window() {
    let mut case = Case::new(sheet(4, 4, 0.25, |u| DVec3::new(u.x - 0.5, 0.0, u.y - 0.5)));
    case.settings.silhouette_threshold = 10.0;
    let pan = |frame: f64, x: f64| CameraKey { frame, target: DVec3::X * x, ..close_up() };
    let mut keys = vec![pan(0.0, 4.0), pan(30.0, 1.0), pan(33.0, -3.0), pan(60.0, 0.5)];
    keys[2].cut = true;
    let shot = path(keys);
    for rule in [ViewRule::Papers, ViewRule::WholeMetric] {
        case.settings.rule = rule;
        for frame in [0.0, 12.0, 20.0, 24.0, 28.0, 31.0, 32.0, 33.0, 40.0, 55.0] {
            let field = case.at(&shot, frame);
            for face in case.mesh.face_ids() {
                let brute = brute_force_factor(&case, &shot, frame, face);
                let nu = field.factor[face];
                // Between samples a frame apart the camera turns on a little.
                assert!(nu <= brute + 1e-12 && nu >= brute - 0.02, "{nu} for {brute} at {frame}");
            }
        }
    }
}

#[test]
fn before_a_cut_the_papers_factor_grows_evenly_to_its_new_value() {
    let mut case = Case::new(curtain());
    case.settings.rule = ViewRule::Papers;
    let shot = cut_at_10(looking_away(), close_up());
    let nu: Vec<f64> =
        (4..=10).map(|f| case.at(&shot, f64::from(f)).factor.as_slice()[0]).collect();
    for (nu, expected) in nu.iter().zip([0.01, 0.01, 0.2, 0.4, 0.6, 0.8, 1.0]) {
        assert!((nu - expected).abs() < 1e-12, "{nu} instead of {expected}");
    }
    let between: Vec<f64> =
        (0..=400).map(|i| case.at(&shot, 5.0 + f64::from(i) / 80.0).factor.as_slice()[0]).collect();
    assert!(between.windows(2).all(|w| (w[1] - w[0]).abs() < 0.003));
}

#[test]
fn after_a_cut_away_the_old_view_still_counts_until_the_cut() {
    let case = Case::new(curtain());
    let shot = cut_at_10(close_up(), looking_away());
    assert!(case.at(&shot, 9.0).factor.iter().all(|&nu| nu == 1.0));
    assert!(case.at(&shot, 10.0).factor.iter().all(|&nu| nu == 0.01));
    let pan = path(vec![
        looking_away(),
        CameraKey { frame: 10.0, target: DVec3::ZERO, ..looking_away() },
        CameraKey { frame: 10.5, cut: true, ..looking_away() },
    ]);
    // Only the left limit of the cut at 10.5 sees the curtain from frame 10.25 on.
    let seen = Case::new(curtain()).at(&pan, 10.25);
    assert!(seen.factor.iter().all(|&nu| nu == 1.0));
}

#[test]
fn without_anticipation_a_cut_comes_as_a_surprise() {
    let mut case = Case::new(curtain());
    case.settings.anticipation_frames = 0.0;
    let shot = cut_at_10(looking_away(), close_up());
    for (frame, expected) in [(9.0, 0.01), (9.999, 0.01), (10.0, 1.0)] {
        assert!(case.at(&shot, frame).factor.iter().all(|&nu| nu == expected));
    }
}

#[test]
fn a_cut_from_wide_to_close_up_is_prepared_by_the_whole_metric_alone() {
    let mut case = Case::new(curtain());
    let shot = cut_at_10(wide(), close_up());
    let finest =
        |case: &Case, frame: f64| case.at(&shot, frame).metric.as_slice()[70].eigen().values[0];
    let whole: Vec<f64> = (4..=10).map(|f| finest(&case, f64::from(f))).collect();
    let base_finest = base(&case.mesh).as_slice()[0].eigen().values[0];
    assert!(whole[0] < 0.2 * base_finest);
    // w = 0.8 one frame before.
    assert!((whole[5] - 0.64 * base_finest).abs() < 1e-6 * base_finest);
    assert!((whole[6] - base_finest).abs() < 1e-9 * base_finest);
    case.settings.rule = ViewRule::Papers;
    assert!((finest(&case, 9.0) - whole[0]).abs() < 1e-9 * base_finest);
}

#[test]
fn two_viewers_get_at_least_what_each_asks_for() {
    let case = Case::new(folded());
    let side = CameraKey { eye: DVec3::new(8.0, 12.0, 3.0), target: DVec3::Z * 0.4, ..close_up() };
    let paths = [path(vec![wide()]), path(vec![side])];
    let windows = paths.each_ref().map(|p| ViewerWindow::new(p, 0.0, 5.0));
    let both = case.field(&windows);
    let each = windows.each_ref().map(|w| case.field(std::slice::from_ref(w)));
    let near_both = case.near(&windows);
    let near_each = windows.each_ref().map(|w| case.near(std::slice::from_ref(w)));
    for face in case.mesh.face_ids() {
        for one in &each {
            assert!(finer_or_equal(both.metric[face], one.metric[face]));
            assert!(both.factor[face] >= one.factor[face]);
        }
        let least = near_each.each_ref().map(|near| near[face].out_of_frame_distance);
        assert_eq!(near_both[face].out_of_frame_distance, least[0].min(least[1]));
    }
    let reversed = [windows[1].clone(), windows[0].clone()];
    for (a, b) in both.metric.iter().zip(&case.field(&reversed).metric) {
        assert!(size(*a - *b) < 1e-9 * size(*a));
    }
}

#[test]
fn the_whole_metric_is_at_least_the_one_of_every_moment() {
    let case = Case::new(folded());
    let dolly = path(vec![
        CameraKey { frame: 0.0, ..wide() },
        CameraKey { frame: 8.0, eye: DVec3::new(1.5, -2.0, 0.3), ..close_up() },
    ]);
    let windows = [ViewerWindow::new(&dolly, 3.0, 5.0)];
    let whole = case.field(&windows);
    for sample in windows[0].samples() {
        let only = case.at(&still(sample.view.eye, DVec3::ZERO), 0.0);
        for face in case.mesh.face_ids() {
            let asked = only.metric[face] * (sample.weight * sample.weight);
            assert!(finer_or_equal(whole.metric[face], asked), "{:?}", sample.tau);
            assert!(finer_or_equal(base(&case.mesh)[face] * 1.001, whole.metric[face]));
        }
    }
}

#[test]
fn presence_grows_before_a_face_enters_the_frame() {
    let case = Case::new(curtain());
    let shot = cut_at_10(looking_away(), close_up());
    for (frame, expected) in [(4.0, 0.0), (6.0, 0.2), (9.0, 0.8), (10.0, 1.0)] {
        let near = case.near_at(&shot, frame);
        assert!(near.iter().all(|n| (n.presence - expected).abs() < 1e-12));
        assert_eq!(near.as_slice()[0].out_of_frame_distance == 0.0, frame == 10.0);
    }
}

#[test]
fn a_collapsed_garment_has_finite_metrics() {
    let mesh = sheet(3, 3, 0.1, |_: DVec2| flat(DVec2::ZERO));
    let field = Case::new(mesh).at(&path(vec![wide()]), 0.0);
    assert!(field.metric.iter().all(|m| m.is_finite()));
}
