//! What becomes of the cloth's energy.

use super::worse;
use crate::scene::Scene;
use crate::sim::Frame;

/// The energy of all cloth at a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// (kg).
    pub mass: f64,
    /// Stretch and bending (J).
    pub elastic: f64,
    /// (J).
    pub kinetic: f64,
    /// In gravity, from the origin (J).
    pub potential: f64,
    /// (N).
    pub weight: f64,
}

/// Three figures.
///
/// The *gain* looks at the frames from which on nothing outside does work on the cloth but gravity.
/// There E = elastic + kinetic + potential can only fall: friction, air at rest and the implicit step
/// take from it. The gain is the largest rise of E above any earlier value in these frames, as a
/// share of the energy there was: the largest kinetic energy, what its fall gave it, and the elastic
/// energy at the first of these frames. What contact layers and pins keep is not in E, and may come
/// back as a rise. The *kick* is the same of kinetic + potential alone: where the mesh changes, so
/// does what the elastic energy is told on, but that only matters once it moves something.
///
/// The *speed share* looks at all frames. With s the speed of what does work on the cloth and d how
/// far the middle of its mass has come down, the root mean square speed of the cloth may be
/// 2 s + sqrt(2 g d): twice the speed of what hits it, as after an elastic impact, and what it gained
/// in its fall. Of cloth that is stretched and let go this says nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    passive_from: Option<u32>,
    drive_speed: f64,
    /// Potential energy at the first frame, and the least (J).
    potential: Option<[f64; 2]>,
    /// The largest (J).
    kinetic: f64,
    /// At the first passive frame (J).
    elastic: Option<f64>,
    /// Of E, and of kinetic + potential, in the passive frames.
    all: Rise,
    motion: Rise,
    speed_share: f64,
    /// (kg), (N).
    mass: f64,
    weight: f64,
}

/// How far a quantity rises above any earlier value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Rise {
    least: Option<f64>,
    largest: f64,
}

impl Rise {
    fn enter(&mut self, now: f64) {
        let least = self.least.map_or(now, |least| least.min(now));
        self.largest = worse(self.largest, now - least);
        self.least = Some(least);
    }
}

/// Speed that counts as none (m/s): a fall of a hundredth of a millimetre.
const SPEED_FLOOR: f64 = 0.014;

/// Energy that there always is, per mass (J/kg): that of a fall of 10 mm, two thicknesses of contact.
const ENERGY_FLOOR: f64 = 0.1;

impl Balance {
    pub fn of(frame: &Frame, scene: &Scene) -> Self {
        let mut balance = Self {
            elastic: frame.report.elastic_energy,
            kinetic: frame.report.kinetic_energy,
            ..Self::default()
        };
        for (mesh, garment) in frame.garments.iter().zip(&scene.garments) {
            let areas = mesh.node_areas();
            for node in mesh.node_ids() {
                let mass = garment.fabric.density() * areas[node];
                balance.mass += mass;
                balance.potential -= mass * scene.gravity.dot(mesh.position[node]);
            }
        }
        balance.weight = balance.mass * scene.gravity.length();
        balance
    }

    fn total(&self) -> f64 {
        self.elastic + self.kinetic + self.potential
    }
}

impl Ledger {
    /// See [`Trial`](crate::stability::Trial) for what they mean.
    pub fn new(passive_from: Option<u32>, drive_speed: f64) -> Self {
        Self {
            passive_from,
            drive_speed,
            potential: None,
            kinetic: 0.0,
            elastic: None,
            all: Rise::default(),
            motion: Rise::default(),
            speed_share: 0.0,
            mass: 0.0,
            weight: 0.0,
        }
    }

    /// The next frame.
    pub fn enter(&mut self, frame: u32, now: Balance) {
        if self.passive_from.is_some_and(|from| frame >= from) {
            self.all.enter(now.total());
            self.motion.enter(now.kinetic + now.potential);
            self.elastic.get_or_insert(now.elastic);
        }
        let [first, least] = self.potential.unwrap_or([now.potential; 2]);
        self.potential = Some([first, least.min(now.potential)]);
        self.kinetic = worse(self.kinetic, now.kinetic);
        (self.mass, self.weight) = (now.mass, now.weight);
        let speed = |energy: f64| (2.0 * energy / now.mass.max(f64::MIN_POSITIVE)).sqrt();
        let fallen = speed((first - now.potential).max(0.0));
        let allowed = 2.0 * self.drive_speed + fallen + SPEED_FLOOR;
        self.speed_share = worse(self.speed_share, speed(now.kinetic) / allowed);
    }

    /// NaN if an energy was.
    pub fn gain(&self) -> f64 {
        self.all.largest / self.there_was()
    }

    /// NaN if an energy was.
    pub fn kick(&self) -> f64 {
        self.motion.largest / self.there_was()
    }

    /// (J).
    fn there_was(&self) -> f64 {
        let energy = self.kinetic + self.fallen_energy() + self.elastic.unwrap_or(0.0);
        energy.max(ENERGY_FLOOR * self.mass).max(f64::MIN_POSITIVE)
    }

    /// How far the middle of the mass has come down at most (m); 0 without gravity.
    pub fn fall(&self) -> f64 {
        if self.weight > 0.0 { self.fallen_energy() / self.weight } else { 0.0 }
    }

    fn fallen_energy(&self) -> f64 {
        self.potential.map_or(0.0, |[first, least]| first - least)
    }

    /// NaN if an energy was.
    pub fn speed_share(&self) -> f64 {
        self.speed_share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn balance([elastic, kinetic, potential]: [f64; 3]) -> Balance {
        Balance { mass: 1.0, weight: 10.0, elastic, kinetic, potential }
    }

    fn after(ledger: Ledger, all: &[[f64; 3]]) -> Ledger {
        let mut ledger = ledger;
        (0..).zip(all).for_each(|(frame, &energies)| ledger.enter(frame, balance(energies)));
        ledger
    }

    #[test]
    fn a_fall_that_ends_on_a_floor_gains_nothing() {
        let fall = [[0.0, 0.0, 2.0], [0.0, 1.0, 1.0], [0.1, 1.5, 0.4], [0.0, 0.0, 0.0]];
        let ledger = after(Ledger::new(Some(0), 0.0), &fall);
        assert_eq!(ledger.gain(), 0.0);
        assert!(ledger.speed_share() <= 1.0, "{ledger:?}");
        assert!((ledger.fall() - 0.2).abs() < 1e-12, "{ledger:?}");
    }

    #[test]
    fn energy_from_nowhere_is_a_gain_and_a_speed() {
        let ledger =
            after(Ledger::new(Some(0), 0.0), &[[0.0, 0.0, 1.0], [0.0, 0.5, 0.0], [3.0, 2.5, 0.0]]);
        assert!((ledger.gain() - 5.0 / 3.5).abs() < 1e-12, "{ledger:?}");
        assert!(ledger.speed_share() > 1.5, "{ledger:?}");
    }

    #[test]
    fn work_from_outside_is_no_gain_but_what_rises_after_it_is() {
        let worked = [[0.0, 0.0, 0.0], [1.0, 3.0, 0.0], [1.0, 2.0, 0.0], [1.0, 2.2, 0.0]];
        assert_eq!(after(Ledger::new(None, 5.0), &worked).gain(), 0.0);
        let ledger = after(Ledger::new(Some(1), 5.0), &worked);
        assert!((ledger.gain() - 0.2 / 4.0).abs() < 1e-12, "{ledger:?}");
    }

    #[test]
    fn strain_from_nowhere_is_no_kick_until_it_moves_something() {
        let strained = [[0.0, 0.0, 1.0], [0.0, 0.5, 0.0], [3.0, 0.5, 0.0], [1.0, 0.9, 0.1]];
        let [still, moved] = [3, 4].map(|n| after(Ledger::new(Some(0), 0.0), &strained[..n]));
        assert!(still.gain() > 1.0 && still.kick() == 0.0, "{still:?}");
        assert!((moved.kick() - 0.5 / 1.9).abs() < 1e-12, "{moved:?}");
    }

    #[test]
    fn what_is_not_a_number_stays_one() {
        let broken = [[0.0, 0.0, 1.0], [f64::NAN, f64::NAN, 0.0], [0.0, 0.0, 0.0]];
        let ledger = after(Ledger::new(Some(0), 0.0), &broken);
        assert!(ledger.gain().is_nan() && ledger.speed_share().is_nan(), "{ledger:?}");
    }
}
