//! Cost of remeshing per edit, from a thousand to two hundred thousand faces: it must not grow.

use std::hint::black_box;
use std::time::Instant;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec2, DVec3};
use shotsilk::math::SymTensor2;
use shotsilk::mesh::{Mesh, RawMesh};
use shotsilk::remesh::{NoGuard, RemeshSettings, remesh};

const FACE_COUNTS: [usize; 5] = [1_000, 4_000, 16_000, 64_000, 200_000];

/// A square of two faces; the metric does the rest.
fn square() -> Mesh {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
    let raw = RawMesh {
        positions: corners.iter().map(|u| DVec3::new(u.x, u.y, 0.0)).collect(),
        vertices: corners.iter().enumerate().map(|(n, u)| (n as u32, *u)).collect(),
        faces: vec![[0, 1, 2], [0, 2, 3]],
        ..RawMesh::default()
    };
    Mesh::from_raw(&raw, &[]).expect("a square is a mesh")
}

/// A metric that varies over the square by a factor of 4 and gives about `faces` faces in all.
fn with_metric(mut mesh: Mesh, faces: usize) -> Mesh {
    // Longest-edge splitting makes about 6.4 faces per unit of metric area before the doubling below.
    let density = faces as f64 / 6.4 / 3.6;
    for v in mesh.vertex_ids() {
        let u = mesh.material(v);
        mesh.metric[v] = SymTensor2::isotropic(density * (1.0 + 3.0 * u.x * u.y)) * 2.0;
    }
    mesh
}

fn cost_per_edit(c: &mut Criterion) {
    let settings = RemeshSettings::default();
    let mut group = c.benchmark_group("remesh");
    group.sample_size(10);
    for faces in FACE_COUNTS {
        let coarse = with_metric(square(), faces);
        let (fine, refined) = remesh(coarse.clone(), &settings, &NoGuard);
        let mut loose = fine.clone();
        loose.metric.iter_mut().for_each(|m| *m = *m * 0.25);
        let (_, coarsened) = remesh(loose.clone(), &settings, &NoGuard);
        println!(
            "{} faces: {} splits and {} flips up, {} collapses down",
            fine.face_count(),
            refined.splits,
            refined.flips,
            coarsened.collapses
        );
        for (name, mesh, edits) in
            [("refine", coarse, refined.splits), ("coarsen", loose, coarsened.collapses)]
        {
            group.throughput(Throughput::Elements(edits as u64));
            group.bench_with_input(BenchmarkId::new(name, fine.face_count()), &mesh, |b, mesh| {
                b.iter_custom(|rounds| {
                    let mut copies = vec![mesh.clone(); rounds as usize];
                    let started = Instant::now();
                    for copy in copies.drain(..) {
                        black_box(remesh(copy, &settings, &NoGuard));
                    }
                    started.elapsed()
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, cost_per_edit);
criterion_main!(benches);
