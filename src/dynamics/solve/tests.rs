//! Whichever way it is taken, a solution is a solution.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::*;
use crate::dynamics::matrix::Pattern;
use crate::dynamics::testing::Random;

/// A sheet of springs: a grid of nodes of mass 1, each tied to its neighbours with a stiffness.
fn sheet_of_springs(side: u32, stiffness: f64, random: &mut Random) -> BlockMatrix {
    let node = |i: u32, j: u32| j * side + i;
    let mut pairs = Vec::new();
    for j in 0..side {
        for i in 0..side {
            let ahead = [(i + 1, j), (i, j + 1), (i + 1, j + 1)];
            let inside = ahead.into_iter().filter(|&(a, b)| a < side && b < side);
            pairs.extend(inside.map(|(a, b)| [node(i, j), node(a, b)]));
        }
    }
    let pattern = Arc::new(Pattern::from_pairs((side * side) as usize, pairs.iter().copied()));
    let mut matrix = BlockMatrix::zero(pattern.clone());
    for n in 0..side * side {
        matrix.add(pattern.diagonal_slot(n as usize), DMat3::IDENTITY);
    }
    for [a, b] in pairs {
        let axis = random.vector().normalize_or(DVec3::X);
        let spring = crate::math::outer(axis * stiffness, axis);
        matrix.add(pattern.slot(a, b).unwrap(), -spring);
        matrix.add(pattern.diagonal_slot(a as usize), spring);
        matrix.add(pattern.diagonal_slot(b as usize), spring);
    }
    matrix
}

fn vector(count: usize, random: &mut Random) -> Vec<DVec3> {
    (0..count).map(|_| random.vector()).collect()
}

/// The solution's error in the energy norm over that of nothing.
fn error(matrix: &BlockMatrix, x: &[DVec3], exact: &[DVec3]) -> f64 {
    let energy = |v: &[DVec3]| -> f64 {
        matrix.product(v).iter().zip(v).map(|(a, b)| a.dot(*b)).sum::<f64>().sqrt()
    };
    let difference: Vec<DVec3> = x.iter().zip(exact).map(|(a, b)| *a - *b).collect();
    energy(&difference) / energy(exact)
}

#[test]
fn every_way_leads_to_the_solution() {
    let mut random = Random::new(31);
    // Soft enough to iterate, and too stiff for it.
    for (stiffness, factorisations) in [(0.5, 0), (20.0, 0), (1e7, 1)] {
        let matrix = sheet_of_springs(20, stiffness, &mut random);
        let exact = vector(400, &mut random);
        let b = matrix.product(&exact);
        let mut solver = LinearSolver::default();
        let mut x = vec![DVec3::ZERO; 400];
        solver.solve(&matrix, &b, &mut x, Accuracy::FINE).unwrap();
        let off = error(&matrix, &x, &exact);
        assert!(off < 10.0 * Accuracy::FINE.tolerance, "stiffness {stiffness}: off by {off}");
        assert_eq!(solver.counts().factorisations, factorisations, "stiffness {stiffness}");
        solver.set_choice(SolverChoice::Direct);
        solver.solve(&matrix, &b, &mut x, Accuracy::FINE).unwrap();
        assert!(error(&matrix, &x, &exact) < 1e-9);
    }
}

#[test]
fn a_good_guess_saves_iterations() {
    let mut random = Random::new(32);
    let matrix = sheet_of_springs(20, 20.0, &mut random);
    let exact = vector(400, &mut random);
    let b = matrix.product(&exact);
    let mut solver = LinearSolver::default();
    let mut x = vec![DVec3::ZERO; 400];
    solver.solve(&matrix, &b, &mut x, Accuracy::FINE).unwrap();
    let cold = solver.counts().iterations;
    x = exact.iter().map(|v| *v * 1.001).collect();
    solver.solve(&matrix, &b, &mut x, Accuracy::FINE).unwrap();
    let warm = solver.counts().iterations - cold;
    assert!(warm < cold * 3 / 4, "{warm} iterations after {cold}");
    solver.solve(&matrix, &b, &mut x, Accuracy::FINE).unwrap();
    assert_eq!(solver.counts().iterations, cold + warm, "a solution needs none");
}

#[test]
fn a_factor_of_a_similar_matrix_is_used_again_and_one_of_another_is_not() {
    let mut random = Random::new(33);
    let stiff = sheet_of_springs(20, 1e7, &mut random);
    let mut similar = stiff.clone();
    similar.add(stiff.pattern().diagonal_slot(7), DMat3::IDENTITY * 1e4);
    let other = sheet_of_springs(20, 1e7, &mut random);
    let mut solver = LinearSolver::default();
    // Twice too stiff to iterate: then factors are kept.
    for (matrix, factorisations) in [(&stiff, 1), (&stiff, 2), (&similar, 2), (&other, 3)] {
        let exact = vector(400, &mut random);
        let b = matrix.product(&exact);
        let mut x = vec![DVec3::ZERO; 400];
        solver.expect_new_matrix();
        solver.solve(matrix, &b, &mut x, Accuracy::FINE).unwrap();
        assert!(error(matrix, &x, &exact) < 10.0 * Accuracy::FINE.tolerance);
        assert_eq!(solver.counts().factorisations, factorisations);
    }
}

#[test]
fn a_matrix_is_factorised_once_however_often_it_is_solved_directly() {
    let mut random = Random::new(39);
    let mut matrix = sheet_of_springs(12, 1e3, &mut random);
    let sides = [vector(144, &mut random), vector(144, &mut random)];
    let direct = || {
        let mut solver = LinearSolver::default();
        solver.set_choice(SolverChoice::Direct);
        solver
    };
    let solution = |solver: &mut LinearSolver, matrix: &BlockMatrix, b: &[DVec3]| {
        let mut x = vec![DVec3::ZERO; 144];
        solver.solve(matrix, b, &mut x, Accuracy::FINE).unwrap();
        x
    };
    let mut solver = direct();
    for b in &sides {
        let anew = solution(&mut direct(), &matrix, b);
        assert_eq!(solution(&mut solver, &matrix, b), anew, "to the bit");
    }
    assert_eq!(solver.counts().factorisations, 1);
    matrix.add(matrix.pattern().diagonal_slot(7), DMat3::IDENTITY * 1e4);
    solver.expect_new_matrix();
    let anew = solution(&mut direct(), &matrix, &sides[0]);
    assert_eq!(solution(&mut solver, &matrix, &sides[0]), anew);
    assert_eq!(solver.counts().factorisations, 2);
}

#[test]
fn after_a_failure_a_matrix_is_factorised_again() {
    let mut random = Random::new(40);
    let mut matrix = sheet_of_springs(6, 1.0, &mut random);
    let b = vector(36, &mut random);
    let mut solver = LinearSolver::default();
    solver.set_choice(SolverChoice::Direct);
    let mut solve = |matrix: &BlockMatrix| {
        solver.solve(matrix, &b, &mut vec![DVec3::ZERO; 36], Accuracy::FINE).is_ok()
    };
    let slot = matrix.pattern().diagonal_slot(5);
    matrix.add(slot, DMat3::IDENTITY * -100.0);
    assert!(!solve(&matrix) && !solve(&matrix));
    matrix.add(slot, DMat3::IDENTITY * 100.0);
    assert!(solve(&matrix));
}

#[test]
fn a_factor_of_another_pattern_is_not_used() {
    let mut random = Random::new(38);
    let mut solver = LinearSolver::default();
    for (count, side) in [20, 18, 20].into_iter().enumerate() {
        let matrix = sheet_of_springs(side, 1e7, &mut random);
        let exact = vector((side * side) as usize, &mut random);
        let mut x = vec![DVec3::ZERO; exact.len()];
        solver.expect_new_matrix();
        solver.solve(&matrix, &matrix.product(&exact), &mut x, Accuracy::FINE).unwrap();
        assert!(error(&matrix, &x, &exact) < 1e-9);
        assert_eq!(solver.counts().factorisations, count + 1);
    }
}

#[test]
fn after_forgetting_a_solution_has_the_bits_of_a_new_solver() {
    let mut random = Random::new(34);
    let (stiff, soft) =
        (sheet_of_springs(12, 1e7, &mut random), sheet_of_springs(12, 3.0, &mut random));
    let b = vector(144, &mut random);
    let solution = |solver: &mut LinearSolver, matrix: &BlockMatrix| {
        let mut x = vec![DVec3::ZERO; 144];
        solver.solve(matrix, &b, &mut x, Accuracy::FINE).unwrap();
        x
    };
    let mut used = LinearSolver::default();
    solution(&mut used, &stiff);
    used.forget();
    assert_eq!(solution(&mut used, &soft), solution(&mut LinearSolver::default(), &soft));
    used.forget();
    assert_eq!(solution(&mut used, &stiff), solution(&mut LinearSolver::default(), &stiff));
}

#[test]
fn an_indefinite_matrix_is_an_error_whichever_way() {
    let mut random = Random::new(35);
    let mut matrix = sheet_of_springs(6, 1.0, &mut random);
    matrix.add(matrix.pattern().diagonal_slot(5), DMat3::IDENTITY * -100.0);
    for choice in [SolverChoice::Auto, SolverChoice::Direct] {
        let mut solver = LinearSolver::default();
        solver.set_choice(choice);
        let b = vector(36, &mut random);
        let error =
            solver.solve(&matrix, &b, &mut vec![DVec3::ZERO; 36], Accuracy::FINE).unwrap_err();
        assert!(matches!(error, SolveError::NotPositiveDefinite { .. }), "{error}");
    }
}

#[test]
fn an_incomplete_factor_is_positive_definite_even_of_an_indefinite_matrix() {
    let mut random = Random::new(36);
    let mut matrix = sheet_of_springs(8, 50.0, &mut random);
    for node in [3, 20, 40] {
        matrix.add(matrix.pattern().diagonal_slot(node), DMat3::IDENTITY * -40.0);
    }
    let mut factor = IncompleteFactor::default();
    factor.factorize(&matrix);
    for _ in 0..50 {
        let r = vector(64, &mut random);
        let mut z = r.clone();
        factor.apply(&r, &mut z);
        let product: f64 = r.iter().zip(&z).map(|(r, z)| r.dot(*z)).sum();
        assert!(product > 0.0, "{product}");
    }
}

#[test]
fn an_incomplete_factor_of_a_chain_is_complete_but_for_what_it_holds_back() {
    let mut random = Random::new(37);
    let pairs = (0..9).map(|n| [n, n + 1]);
    let pattern = Arc::new(Pattern::from_pairs(10, pairs));
    let mut matrix = BlockMatrix::zero(pattern.clone());
    for n in 0..10 {
        matrix.add(pattern.diagonal_slot(n), DMat3::IDENTITY * 10.0);
    }
    for n in 0..9 {
        let coupling = DMat3::from_cols(random.vector(), random.vector(), random.vector());
        matrix.add(pattern.slot(n, n + 1).unwrap(), coupling * 0.3);
    }
    let exact = vector(10, &mut random);
    let b = matrix.product(&exact);
    let mut factor = IncompleteFactor::default();
    factor.factorize(&matrix);
    let mut z = b.clone();
    factor.apply(&b, &mut z);
    // 7 % of corrections of about 1 % are held back.
    for (z, x) in z.iter().zip(&exact) {
        assert!((*z - *x).length() < 5e-3, "{z} is not {x}");
    }
}
