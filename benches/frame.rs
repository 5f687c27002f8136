//! What a whole frame costs: steps, contacts, sizing, remeshing, from the same frame every time.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use shotsilk::own_shot::own_shot;
use shotsilk::scene::{LoadOptions, Scene, load};
use shotsilk::sim::{Frame, SimSettings, Simulation, SizingMode};

/// The figure moves by then, and the skirt has met it.
const START: u32 = 20;

fn scene() -> Arc<Scene> {
    let (shot, files) = own_shot();
    let options = LoadOptions { shot, ..LoadOptions::default() };
    Arc::new(load(&options, &files).expect("the shot can be loaded").scene)
}

/// The frame that is gone on from.
fn start(scene: &Arc<Scene>, settings: SimSettings) -> Frame {
    let (mut simulation, mut frame) =
        Simulation::start(scene.clone(), settings).expect("the shot can be started");
    for _ in 0..START {
        frame = simulation.advance().expect("the shot can be simulated");
    }
    frame
}

fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(10);
    let scene = scene();
    for (name, sizing) in [("adaptive", SizingMode::Adaptive), ("view", SizingMode::View)] {
        let settings = SimSettings { sizing };
        let frame = start(&scene, settings);
        let taken_up =
            || Simulation::from_frame(scene.clone(), settings, &frame).expect("its own frame");
        group.bench_function(BenchmarkId::new("own_shot", name), |b| {
            b.iter_batched_ref(
                taken_up,
                |simulation| black_box(simulation.advance().expect("the frame is simulated")),
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, frames);
criterion_main!(benches);
