//! What was measured, as a line a step and as a table.

use super::last;
use crate::validation::way_bounds::{Bounded, Comparison};

/// A scene's steps, with the frames that they begin at.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    pub scene: String,
    pub steps: Vec<(u32, Comparison)>,
    /// Steps that begin with crossings, which are not compared.
    pub left_out: usize,
    /// CPU time of all that a step takes (s).
    pub step_seconds: f64,
}

impl Measured {
    pub fn push(&mut self, step: Option<(u32, Comparison)>) {
        match step {
            Some(step) => self.steps.push(step),
            None => self.left_out += 1,
        }
    }
}

/// Fewer nodes than this share that do not arrive are no reason to look again: the paper's gamma_e.
const HELD_SHARE_MAX: f64 = 0.01;

/// Rounds until hardly any node is held; `None` if there are not as many.
pub fn rounds_to_settle(bounded: &Bounded) -> Option<usize> {
    let is_settled = |held: f64| held < HELD_SHARE_MAX;
    bounded.rounds.iter().position(|r| is_settled(r.held_share)).map(|round| round + 1)
}

/// A line per step and way; of bounds, per round. Times are those of the round, in microseconds.
pub fn csv(measured: &[Measured]) -> String {
    let mut lines = vec![
        "scene,frame,nodes,faces,speed_thicknesses,method,radius_thicknesses,round,cpu_us,\
         finding_us,pairs,impacts,held_share,motion_kept,crossings_at_end"
            .to_owned(),
    ];
    for (scene, (frame, step)) in
        measured.iter().flat_map(|m| m.steps.iter().map(|step| (&m.scene, step)))
    {
        let Comparison { node_count, face_count, speed, searched, bounded } = step;
        let about = format!("{scene},{frame},{node_count},{face_count},{speed:.4}");
        let [us, finding] =
            [searched.seconds.iter().sum::<f64>(), searched.seconds[0]].map(|s| 1e6 * s);
        let (impacts, kept, crossings) =
            (searched.impacts, searched.motion_kept, searched.crossings);
        lines.push(format!(
            "{about},search,,,{us:.1},{finding:.1},,{impacts},,{kept:.6},{crossings}"
        ));
        for Bounded { radius, rounds, crossings } in bounded {
            for (number, round) in (1..).zip(rounds) {
                let us = 1e6 * round.seconds;
                let (pairs, held, kept) = (round.pairs, round.held_share, round.motion_kept);
                lines.push(format!(
                    "{about},bounds,{radius},{number},{us:.1},,{pairs},,{held:.6},{kept:.6},{crossings}"
                ));
            }
        }
    }
    lines.join("\n") + "\n"
}

/// A line per scene and way; means over the steps. Markdown.
pub fn markdown(measured: &[Measured]) -> String {
    let mut lines = vec![
        "| scene | speed (h) | way | CPU (us a node) | held at first | kept at first | rounds to 1 % | \
         CPU until then | kept then | kept at last | CPU in all | crossings |"
            .to_owned(),
        format!("|{}", " --- |".repeat(12)),
    ];
    for scene in measured.iter().filter(|m| !m.steps.is_empty()) {
        lines.extend(lines_of(scene));
    }
    lines.push(String::new());
    lines.extend(measured.iter().filter(|m| !m.steps.is_empty()).map(shares));
    for scene in measured.iter().filter(|m| m.left_out > 0) {
        let (name, count) = (&scene.scene, scene.left_out);
        lines.push(format!("- {name}: {count} steps begin with crossings and are left out."));
    }
    lines.join("\n") + "\n"
}

fn lines_of(scene: &Measured) -> Vec<String> {
    let steps: Vec<&Comparison> = scene.steps.iter().map(|(_, step)| step).collect();
    let mean = |value: &dyn Fn(&Comparison) -> f64| {
        steps.iter().map(|step| value(step)).sum::<f64>() / steps.len().max(1) as f64
    };
    let per_node = |seconds: f64, step: &Comparison| 1e6 * seconds / step.node_count.max(1) as f64;
    let speed = steps.iter().map(|s| s.speed).fold(0.0, f64::max);
    let about = format!("| {} | {:.2}, up to {speed:.1}", scene.scene, mean(&|s| s.speed));
    let cost = mean(&|s| per_node(s.searched.seconds.iter().sum(), s));
    let kept = percent(mean(&|s| s.searched.motion_kept));
    let crossings: usize = steps.iter().map(|s| s.searched.crossings).sum();
    let mut lines = vec![format!(
        "{about} | search | {cost:.2} | | | | | | {kept} | {cost:.2} | {crossings} |"
    )];
    for (index, first) in steps[0].bounded.iter().enumerate() {
        let of = |s: &Comparison| s.bounded[index].clone();
        // What does not settle has made all rounds.
        let settled = |s: &Comparison| rounds_to_settle(&of(s)).unwrap_or(of(s).rounds.len());
        let cost = |s: &Comparison, rounds: usize| {
            per_node(of(s).rounds[..rounds].iter().map(|r| r.seconds).sum(), s)
        };
        let unsettled = steps.iter().filter(|s| rounds_to_settle(&of(s)).is_none()).count();
        let never = match unsettled {
            0 => String::new(),
            count => format!(" ({count} of {} never)", steps.len()),
        };
        lines.push(format!(
            "{about} | bounds, {} h | {:.2} | {} | {} | {:.1}{never} | {:.2} | {} | {} | {:.2} | {} |",
            first.radius,
            mean(&|s| cost(s, 1)),
            percent(mean(&|s| of(s).rounds[0].held_share)),
            percent(mean(&|s| of(s).rounds[0].motion_kept)),
            mean(&|s| settled(s) as f64),
            mean(&|s| cost(s, settled(s))),
            percent(mean(&|s| of(s).rounds[settled(s) - 1].motion_kept)),
            percent(mean(&|s| last(&of(s)).motion_kept)),
            mean(&|s| cost(s, of(s).rounds.len())),
            steps.iter().map(|s| s.bounded[index].crossings).sum::<usize>(),
        ));
    }
    lines
}

/// What the search is of a step.
fn shares(scene: &Measured) -> String {
    let sum = |k: usize| scene.steps.iter().map(|(_, s)| s.searched.seconds[k]).sum::<f64>();
    let [finding, stopping] = [0, 1].map(|k| 1e3 * sum(k) / scene.steps.len().max(1) as f64);
    let (name, step) = (&scene.scene, 1e3 * scene.step_seconds);
    format!(
        "- {name}: of {step:.2} ms that a step takes, finding pairs takes {finding:.2} ms, stopping cloth at \
         cloth {stopping:.2} ms."
    )
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validation::way_bounds::{BoundRound, Searched};

    fn measured() -> Measured {
        let round = |held_share: f64, motion_kept: f64| BoundRound {
            seconds: 1e-3,
            pairs: 7,
            held_share,
            motion_kept,
        };
        let bounded =
            |rounds: Vec<BoundRound>, radius: f64| Bounded { radius, rounds, crossings: 0 };
        let step = Comparison {
            node_count: 1000,
            face_count: 1900,
            speed: 0.5,
            searched: Searched { seconds: [1e-3, 2e-3], motion_kept: 0.9, ..Searched::default() },
            bounded: vec![
                bounded(vec![round(0.5, 0.3), round(0.005, 0.8), round(0.0, 0.9)], 1.0),
                bounded(vec![round(0.5, 0.3)], 2.0),
            ],
        };
        Measured {
            scene: "drop".into(),
            steps: vec![(3, step.clone()), (5, step)],
            left_out: 1,
            step_seconds: 0.01,
        }
    }

    #[test]
    fn every_round_has_a_line_and_every_way_a_row_with_its_means() {
        assert_eq!(csv(&[measured()]).lines().count(), 1 + 2 * (1 + 3 + 1));
        let table = markdown(&[measured()]);
        let rows: Vec<&str> = table.lines().skip(2).collect();
        assert!(rows[0].contains("| search | 3.00 |"), "{}", rows[0]);
        let settled = "| 1.00 | 50.0 % | 30.0 % | 2.0 | 2.00 | 80.0 % | 90.0 % | 3.00 | 0 |";
        assert!(rows[1].ends_with(settled), "{}", rows[1]);
        assert!(rows[2].contains("(2 of 2 never)"), "{}", rows[2]);
        let shares = "- drop: of 10.00 ms that a step takes, finding pairs takes 1.00 ms, stopping cloth \
                      at cloth 2.00 ms.";
        assert!(rows.contains(&shares), "{table}");
        assert_eq!(rows.last(), Some(&"- drop: 1 steps begin with crossings and are left out."));
        let columns = |row: &str| row.matches('|').count();
        assert!(rows[..3].iter().all(|row| columns(row) == columns(table.lines().next().unwrap())));
    }
}
