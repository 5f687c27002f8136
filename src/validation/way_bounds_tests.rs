use glam::DVec2;

use super::*;
use crate::dynamics::StepState;
use crate::mesh::Id;
use crate::validation::sheet::{Layout, Sheet};

const DURATION: f64 = 5e-3;

/// Two sheets of 0.2 m that lie 5 mm apart; the upper one goes down by a way (m).
fn falling(way: f64) -> (TrialStep, Vec<Mesh>) {
    let sheet = |height: f64, cell: f64| {
        let size = DVec2::splat(0.2);
        Sheet { origin: DVec2::ZERO, size, cell, layout: Layout::Irregular, columns: Vec::new() }
            .mesh(|u| u.extend(height))
    };
    let garments = vec![sheet(0.0, 0.02), sheet(5e-3, 0.023)];
    let refs: Vec<&Mesh> = garments.iter().collect();
    let start = StepState::gathered(&refs);
    let (mut end, mut faces, mut first) = (start.clone(), Vec::new(), 0);
    for mesh in &garments {
        let global = |f| mesh.face_nodes(f).map(|n| (first + n.index()) as u32);
        faces.extend(mesh.face_ids().map(global));
        first += mesh.node_count();
    }
    for n in garments[0].node_count()..first {
        end.position[n].z -= way;
        end.velocity[n].z -= way / DURATION;
    }
    let area: Vec<f64> = garments.iter().flat_map(|m| m.node_areas().into_vec()).collect();
    let (mass, thickness) = (area.clone(), vec![5e-3; first]);
    (TrialStep { start, end, duration: DURATION, area, mass, thickness, faces }, garments)
}

#[test]
fn a_sheet_that_would_fall_through_another_stays_above_it_either_way() {
    let (trial, garments) = falling(0.02);
    let made = Comparison::of(&trial, &garments, &Contact::default(), &[2.0]).unwrap();
    let bounded = &made.bounded[0];
    assert_eq!([made.searched.crossings, bounded.crossings], [0, 0]);
    assert!(made.searched.impacts > 0);
    assert_eq!(bounded.rounds.len(), ROUNDS_MAX);
    for kept in [made.searched.motion_kept, bounded.rounds[ROUNDS_MAX - 1].motion_kept] {
        assert!((0.05..0.9).contains(&kept), "{kept}");
    }
    // Nodes of the upper sheet, fewer than those of the lower, go farther beyond the mean way.
    let share = garments[0].node_count() as f64 / made.node_count as f64;
    assert!((made.speed - share * 0.02 / 5e-3).abs() < 1e-9, "{}", made.speed);
}

#[test]
fn a_sheet_that_comes_nearer_without_touching_arrives_and_takes_more_rounds_the_nearer_it_comes() {
    let settings = Contact::default();
    let rounds = [1e-3, 4e-3, 4.9e-3].map(|way| {
        let (trial, garments) = falling(way);
        let made = Comparison::of(&trial, &garments, &settings, &[2.0]).unwrap();
        assert_eq!((made.searched.motion_kept, made.searched.impacts), (1.0, 0));
        let rounds = &made.bounded[0].rounds;
        assert_eq!(rounds.last().map(|r| (r.held_share, r.motion_kept)), Some((0.0, 1.0)));
        rounds.len()
    });
    assert!(rounds[0] == 1 && rounds[1] < rounds[2], "{rounds:?}");
}

#[test]
fn steps_that_begin_with_crossings_are_not_compared() {
    let (mut trial, garments) = falling(0.0);
    let last = trial.start.position.len() - 1;
    trial.start.position[last].z = -0.01;
    assert!(Comparison::of(&trial, &garments, &Contact::default(), &[2.0]).is_none());
}
