//! What a viewer sees now and over the frames to come, with how much each moment weighs.

use crate::shot::{CameraPath, Frustum, View};

/// One moment of a viewer's window.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewSample {
    /// Frames from now.
    pub tau: f64,
    /// w(tau), above 0 and at most 1.
    pub weight: f64,
    pub view: View,
    pub frustum: Frustum,
}

/// The moments of one viewer's look-ahead, [t, t + T], in order of time; the first is the present.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewerWindow {
    samples: Vec<ViewSample>,
}

impl ViewerWindow {
    /// Samples the path at `frame`, at every whole frame after it and on both sides of each cut,
    /// `anticipation_frames` ahead. A view seen before in the window is left out: it would weigh
    /// less. So are moments after the first whole frame at which the path has ended, which see what
    /// that one does.
    ///
    /// # Panics
    /// If the path has no keys.
    pub fn new(path: &CameraPath, frame: f64, anticipation_frames: f64) -> Self {
        let mut window = Self { samples: Vec::new() };
        window.add(path.view(frame), 0.0, anticipation_frames);
        let mut cuts = path.cuts();
        let end = frame + anticipation_frames;
        cuts.retain(|&cut| frame < cut && cut < end);
        let [_, last_key] = path.frame_range();
        let last = end.min(last_key.ceil() + 1.0);
        let mut moments: Vec<f64> = whole_frames_between(frame, last).collect();
        moments.extend(&cuts);
        moments.sort_by(f64::total_cmp);
        moments.dedup();
        for moment in moments {
            let tau = moment - frame;
            if cuts.contains(&moment) {
                window.add(path.view_before(moment), tau, anticipation_frames);
            }
            window.add(path.view(moment), tau, anticipation_frames);
        }
        window
    }

    pub fn samples(&self) -> &[ViewSample] {
        &self.samples
    }

    pub fn present(&self) -> &ViewSample {
        &self.samples[0]
    }

    fn add(&mut self, view: View, tau: f64, anticipation_frames: f64) {
        let weight = window_weight(tau, anticipation_frames);
        if weight > 0.0 && !self.samples.iter().any(|s| s.view == view) {
            self.samples.push(ViewSample { tau, weight, view, frustum: Frustum::of(&view) });
        }
    }
}

/// w(tau) = 1 - tau / T, and w(0) = 1 whatever T ([`VD15`](crate::papers::VD15) 3.1.2).
fn window_weight(tau: f64, anticipation_frames: f64) -> f64 {
    if tau == 0.0 { 1.0 } else { 1.0 - tau / anticipation_frames }
}

/// Those strictly between two times.
fn whole_frames_between(start: f64, end: f64) -> impl Iterator<Item = f64> {
    let first = start.floor() + 1.0;
    (0u32..).map(move |i| first + f64::from(i)).take_while(move |&frame| frame < end)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::shot::tests::{key, path, still};

    fn moving() -> CameraPath {
        path(vec![key(0.0, DVec3::X, DVec3::ZERO), key(100.0, DVec3::X * 9.0, DVec3::ZERO)])
    }

    fn taus_and_weights(window: &ViewerWindow) -> Vec<(f64, f64)> {
        window.samples().iter().map(|s| (s.tau, s.weight)).collect()
    }

    #[test]
    fn every_frame_ahead_weighs_less_and_the_last_nothing() {
        let window = ViewerWindow::new(&moving(), 10.0, 4.0);
        assert_eq!(taus_and_weights(&window), [(0.0, 1.0), (1.0, 0.75), (2.0, 0.5), (3.0, 0.25)]);
        assert_eq!(window.present().view, moving().view(10.0));
    }

    #[test]
    fn nothing_is_looked_at_after_the_path_has_ended_however_far_ahead() {
        let keys = [0.0, 30.0, 90.3].map(|at| key(at, DVec3::X * (1.0 + at), DVec3::ZERO));
        for path in [path(keys.to_vec()), path(keys[..1].to_vec())] {
            for (now, whole) in
                [(-2.5, -2.0), (88.0, 89.0), (90.0, 91.0), (90.7, 91.0), (3e6, 3e6 + 1.0)]
            {
                let window = ViewerWindow::new(&path, now, 3e7);
                let mut seen = vec![path.view(now)];
                for moment in (0..200).map(|i| path.view(whole + f64::from(i))) {
                    if !seen.contains(&moment) {
                        seen.push(moment);
                    }
                }
                let views: Vec<View> = window.samples().iter().map(|s| s.view).collect();
                assert_eq!(views, seen, "at {now}");
            }
        }
    }

    #[test]
    fn a_time_between_frames_looks_at_whole_frames_ahead() {
        let window = ViewerWindow::new(&moving(), 10.5, 2.0);
        assert_eq!(taus_and_weights(&window), [(0.0, 1.0), (0.5, 0.75), (1.5, 0.25)]);
    }

    #[test]
    fn without_anticipation_only_the_present_counts() {
        let window = ViewerWindow::new(&moving(), 10.0, 0.0);
        assert_eq!(taus_and_weights(&window), [(0.0, 1.0)]);
    }

    #[test]
    fn a_still_camera_is_looked_through_once() {
        let window = ViewerWindow::new(&still(DVec3::X, DVec3::ZERO), 3.0, 5.0);
        assert_eq!(taus_and_weights(&window), [(0.0, 1.0)]);
    }

    #[test]
    fn a_cut_is_seen_from_both_sides() {
        let mut keys = vec![
            key(0.0, DVec3::X, DVec3::ZERO),
            key(10.0, DVec3::X * 2.0, DVec3::ZERO),
            key(12.5, DVec3::Y, DVec3::ZERO),
            key(20.0, DVec3::Y * 5.0, DVec3::ZERO),
        ];
        keys[2].cut = true;
        let shot = path(keys);
        let window = ViewerWindow::new(&shot, 9.5, 5.0);
        let taus: Vec<f64> = window.samples().iter().map(|s| s.tau).collect();
        // The view held until the cut is that of frame 10.
        assert_eq!(taus, [0.0, 0.5, 3.0, 3.5, 4.5]);
        let at_cut = ViewerWindow::new(&shot, 12.5, 1.0);
        assert_eq!(at_cut.present().view.eye, DVec3::Y);
    }
}
