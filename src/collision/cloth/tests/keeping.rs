//! Pairs that are kept from step to step.

use super::*;

const REACH: f64 = 3e-3;
const ROOM: f64 = 1e-3;

/// Two sheets near one another, their nodes on the way for some steps: all together, and each for
/// itself.
fn steps(together: DVec3, apart: f64, count: u32) -> (Scene, Vec<Vec<DVec3>>) {
    let mut scene = approaching(0.0, 1);
    scene.position.iter_mut().for_each(|x| x.z = if x.z > 0.025 { 5e-3 } else { 0.0 });
    let mut random = Random::new(3);
    let ways: Vec<DVec3> = (0..scene.position.len())
        .map(|_| together + DVec3::from_array([(); 3].map(|()| random.number())) * apart)
        .collect();
    let at = |step: u32| {
        let places = scene.position.iter().zip(&ways);
        places.map(|(x, way)| *x + *way * f64::from(step)).collect()
    };
    let places = (0..=count).map(at).collect();
    (scene, places)
}

/// The pairs at each step, as they are found or kept, and as they are found anew.
fn pairs(scene: &mut Scene, places: &[Vec<DVec3>]) -> Vec<[Vec<ClothPair>; 2]> {
    let topology = scene.tree.topology().clone();
    let mut fresh = ClothPairs::new(&scene.position, &topology);
    let of_step = |ends: &[Vec<DVec3>]| {
        let way = |n: usize| ends[1][n] - ends[0][n];
        scene.own.pairs.find_or_keep(&topology, &ends[0], way, REACH, ROOM);
        fresh.find(&topology, &ends[0], way, REACH);
        [scene.own.pairs.found().to_vec(), fresh.found().to_vec()]
    };
    places.windows(2).map(of_step).collect()
}

fn assert_all_of([held, fresh]: &[Vec<ClothPair>; 2]) {
    let held: BTreeSet<_> = held.iter().copied().collect();
    assert!(fresh.len() > 50 && fresh.iter().all(|pair| held.contains(pair)));
}

#[test]
fn slow_cloth_keeps_its_pairs_however_fast_it_moves_as_a_whole() {
    let (mut scene, places) = steps(DVec3::new(0.3, -0.2, 0.1), 1e-4, 5);
    let steps = pairs(&mut scene, &places);
    for step in &steps {
        assert_all_of(step);
        assert!(step[0] == steps[0][0], "nothing is looked up again");
    }
}

#[test]
fn pairs_of_a_few_nodes_that_leave_their_boxes_are_added() {
    let (mut scene, mut places) = steps(DVec3::ZERO, 1e-4, 4);
    for (step, places) in places.iter_mut().enumerate() {
        places[5] += DVec3::new(0.1, 0.2, 0.0) * step as f64;
        places[20] -= DVec3::new(0.1, 0.2, 0.0) * step as f64;
    }
    let steps = pairs(&mut scene, &places);
    steps.iter().for_each(assert_all_of);
    assert!(steps[3][0].len() > steps[0][0].len());
    let last: BTreeSet<_> = steps[3][0].iter().copied().collect();
    assert!(steps[0][0].iter().all(|pair| last.contains(pair)), "what was found is kept");
    assert!(last.len() == steps[3][0].len(), "no pair twice");
}

#[test]
fn fast_cloth_is_looked_up_in_every_step_with_nothing_to_spare() {
    let (mut scene, places) = steps(DVec3::ZERO, 5e-3, 4);
    for [held, fresh] in pairs(&mut scene, &places) {
        assert!(held.len() == fresh.len());
        assert_all_of(&[held, fresh]);
    }
}
