//! The quick experiments, each as a test.

use super::*;

/// Runs the experiments of which a claim's name begins so; all their claims must hold.
#[track_caller]
fn assert_holds(name: &str) {
    let all = experiments();
    let begins = |e: &&Experiment| e.claims().iter().any(|claim| claim.name.starts_with(name));
    let chosen: Vec<&Experiment> = all.iter().filter(begins).collect();
    assert!(!chosen.is_empty(), "no experiment is called {name:?}");
    for outcome in chosen.iter().map(|e| e.run()) {
        assert!(outcome.error.is_none(), "{}", outcome.error.expect("it is there"));
        for row in outcome.rows {
            assert!(row.holds(), "{row:?}");
        }
    }
}

#[test]
fn no_two_claims_have_the_same_name() {
    let all = experiments();
    let mut names: Vec<&str> =
        all.iter().flat_map(|e| e.claims()).map(|claim| claim.name.as_str()).collect();
    names.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
}

#[test]
fn an_affine_map_gives_constant_stress_on_any_mesh() {
    assert_holds("patch-test");
}

#[test]
fn a_hanging_strip_stretches_as_its_weight_asks() {
    assert_holds("hanging-strip");
}

#[test]
fn free_fall_is_exact() {
    assert_holds("free-fall");
}

#[test]
fn linear_momentum_is_conserved() {
    assert_holds("momentum");
}

#[test]
fn energy_is_not_made() {
    assert_holds("energy");
}

#[test]
fn errors_shrink_with_the_step() {
    assert_holds("order");
}

#[test]
fn a_split_that_is_collapsed_again_changes_nothing() {
    assert_holds("remesh-only/mass");
}

#[test]
fn a_patch_on_an_incline_sticks_and_slides_as_coulomb_says() {
    assert_holds("incline/mu-0.3");
}

#[test]
fn a_cantilever_droops_as_the_elastica_does() {
    assert_holds("cantilever/gamma-5/aligned/fixed");
}

#[test]
fn a_strip_rolled_up_to_a_circle_is_held_by_the_couple_of_an_arc() {
    assert_holds("roll-up");
}

#[test]
fn wrinkles_have_the_length_that_costs_least() {
    assert_holds("wrinkle-wavelength/aligned");
}

#[test]
fn a_strip_swings_with_its_first_mode() {
    assert_holds("first-mode");
}

#[test]
fn a_strip_pressed_on_a_rough_plane_slips_when_it_must() {
    assert_holds("stick-slip/mu-0.1");
}

#[test]
fn a_strip_that_slips_over_a_drum_is_pulled_harder_on_one_side() {
    assert_holds("capstan/mu-0.3");
}

#[test]
fn a_strip_clamped_upright_buckles_under_the_load_of_michell_and_prandtl() {
    assert_holds("buckling-onset/nu-0.3/aligned");
}
