//! What one step costs, by part: assembly, solution, and the whole.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::{DVec2, DVec3};
use shotsilk::dynamics::{Accuracy, LinearSolver, StepForces, StepState, System};
use shotsilk::mesh::{Mesh, RawMesh};
use shotsilk::scene::{Air, Fabric, MeasuredFabric, SolverChoice};

const DT: f64 = 5e-3;
const NODE_COUNTS: [u32; 3] = [1_000, 5_000, 20_000];

/// A waving square sheet of 1 m with alternating diagonals and about as many nodes as asked for.
fn sheet(nodes: u32) -> Mesh {
    let cells = f64::from(nodes).sqrt() as u32 - 1;
    let rows = cells + 1;
    let mut raw = RawMesh::default();
    for node in 0..rows * rows {
        let u = DVec2::new(f64::from(node % rows), f64::from(node / rows)) / f64::from(cells);
        let wave = 0.02 * (20.0 * u.x).sin() * (15.0 * u.y).cos();
        raw.positions.push(u.extend(wave));
        raw.velocities.push(DVec3::new(0.1 * u.y, 0.0, 2.0 * wave));
        raw.vertices.push((node, u));
    }
    for cell in 0..cells * cells {
        let (i, j) = (cell % cells, cell / cells);
        let [a, b] = [j * rows + i, j * rows + i + 1];
        let [c, d] = [a + rows, b + rows];
        let halves = if (i + j) % 2 == 0 { [[a, b, d], [a, d, c]] } else { [[a, b, c], [b, d, c]] };
        raw.faces.extend(halves);
    }
    Mesh::from_raw(&raw, &[]).expect("a sheet is a mesh")
}

fn fabric() -> Fabric {
    Fabric::Measured(MeasuredFabric {
        density: 0.2,
        stretching: [[400.0, 80.0, 300.0, 60.0]; 6],
        bending: [[1e-5; 5]; 3],
        damping: 0.0,
        strain_limits: None,
    })
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step");
    group.sample_size(10);
    let forces = StepForces {
        gravity: DVec3::new(0.0, 0.0, -9.81),
        air: Air::default(),
        ..StepForces::NONE
    };
    for nodes in NODE_COUNTS {
        let (mesh, fabric) = (sheet(nodes), fabric());
        let state = StepState::gathered(&[&mesh]);
        group.bench_function(BenchmarkId::new("layout", nodes), |b| {
            b.iter(|| black_box(System::new(&[&mesh], &[&fabric])));
        });
        let mut system = System::new(&[&mesh], &[&fabric]);
        group.bench_function(BenchmarkId::new("freeze_stiffness", nodes), |b| {
            b.iter(|| system.freeze_stiffness(black_box(&state.position)));
        });
        group.bench_function(BenchmarkId::new("assemble", nodes), |b| {
            b.iter(|| system.assemble(black_box(&state), &forces, DT));
        });
        let (matrix, right_side) = system.linear_system();
        for (name, choice) in
            [("solve_auto", SolverChoice::Auto), ("solve_direct", SolverChoice::Direct)]
        {
            let mut solver = LinearSolver::default();
            solver.set_choice(choice);
            group.bench_function(BenchmarkId::new(name, nodes), |b| {
                b.iter(|| {
                    solver.expect_new_matrix();
                    let mut change = vec![DVec3::ZERO; right_side.len()];
                    solver
                        .solve(matrix, black_box(right_side), &mut change, Accuracy::FINE)
                        .expect("it is definite");
                });
            });
        }
        group.bench_function(BenchmarkId::new("whole", nodes), |b| {
            b.iter(|| system.step(&mut state.clone(), &forces, DT).expect("the step is taken"));
        });
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
