//! What a continuous test of two features costs: those that stay apart, as most candidates do, those
//! that touch, and those that slide along one another in one plane.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::DVec3;
use shotsilk::collision::{Features, Sweep};

const SWEEPS: usize = 1000;
/// (m).
const TOLERANCE: f64 = 5e-6;

/// Reproducible points in the cube [-1, 1)^3 (a linear congruential generator).
struct Points(u64);

impl Points {
    fn number(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn next(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

/// Features of 1 cm and less, with ways of up to 5 mm.
fn sweeps(kind: &str) -> Vec<Sweep> {
    let mut points = Points(1);
    let sweep = |_| {
        let mut start = [0, 1, 2, 3].map(|_| points.next() * 5e-3);
        let way = [0, 1, 2, 3].map(|_| points.next() * 2e-3);
        match kind {
            "apart" => start[0] += DVec3::Z * 1e-2,
            "in_plane" => start.iter_mut().for_each(|p| p.z = 0.0),
            _ => {}
        }
        let mut end = [0, 1, 2, 3].map(|k| start[k] + way[k]);
        if kind == "in_plane" {
            end.iter_mut().for_each(|p| p.z = 0.0);
        }
        Sweep { start, end }
    };
    (0..SWEEPS).map(sweep).collect()
}

fn first_touches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("1000_first_touches");
    for (name, features) in
        [("vertex_face", Features::VertexFace), ("edge_edge", Features::EdgeEdge)]
    {
        for kind in ["apart", "near", "in_plane"] {
            let sweeps = sweeps(kind);
            group.bench_function(BenchmarkId::new(name, kind), |b| {
                let touches = |s: &&Sweep| s.first_touch(features, TOLERANCE).is_some();
                b.iter(|| black_box(&sweeps).iter().filter(touches).count());
            });
        }
    }
    group.finish();
}

criterion_group!(benches, first_touches);
criterion_main!(benches);
