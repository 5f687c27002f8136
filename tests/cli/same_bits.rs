//! The same shot and settings give the same bits, every time and for any number of threads.

use shotsilk::run::RunReader;
use shotsilk::sim::Frame;

use super::small_shot::SmallShot;

/// Positions and velocities of all nodes; the rest of a state holds timings.
fn bits(frame: &Frame) -> Vec<u64> {
    let meshes = frame.garments.iter();
    let vectors = meshes.flat_map(|m| m.node_ids().flat_map(|n| [m.position[n], m.velocity[n]]));
    vectors.flat_map(|v| v.to_array().map(f64::to_bits)).collect()
}

#[track_caller]
fn assert_same(a: &RunReader, b: &RunReader) {
    assert_eq!(a.frames(), b.frames());
    assert_eq!(a.info().input_hash, b.info().input_hash);
    for &number in a.frames() {
        let (a, b) = (a.frame(number).unwrap(), b.frame(number).unwrap());
        assert_eq!(a.garments, b.garments, "frame {number}");
        assert_eq!(a.obstacle_poses, b.obstacle_poses, "frame {number}");
        assert_eq!(bits(&a), bits(&b), "frame {number}");
    }
}

#[test]
fn a_second_run_and_other_thread_counts_give_the_same_bits() {
    let shot = SmallShot::new();
    for (run, threads) in [("once", 2), ("again", 2), ("one", 1), ("seven", 7)] {
        let line = format!("simulate shot.json --out {run} --threads {threads} --frames 8");
        shot.run(&line).succeeds();
    }
    let reader = |run| shot.reader(run);
    assert!(bits(&reader("once").frame(8).unwrap()) != bits(&reader("once").frame(0).unwrap()));
    for run in ["again", "one", "seven"] {
        assert_same(&reader("once"), &reader(run));
    }
}

#[test]
fn settings_and_file_contents_change_the_hash_and_the_place_of_the_shot_does_not() {
    let (here, there) = (SmallShot::new(), SmallShot::new());
    let hash = |shot: &SmallShot, run: &str, arguments: &str| {
        shot.run(&format!("simulate shot.json --out {run} --frames 0 {arguments}")).succeeds();
        shot.reader(run).info().input_hash.clone()
    };
    let original = hash(&here, "a", "");
    assert_eq!(hash(&there, "a", ""), original);
    assert_ne!(hash(&here, "b", "--set view.nu_out=0.02"), original);
    assert_ne!(hash(&here, "c", "--sizing adaptive"), original);
    here.replace("cloth.obj", "v 0.5 0.5 1", "v 0.5 0.5 1.01");
    assert_ne!(hash(&here, "d", ""), original);
}
