//! Where the simulator fails under growing stress: as a map, and as tables.

mod map;

use crate::stability::{Record, Verdict};

/// One stress, from mild to severe.
#[derive(Clone, Debug, PartialEq)]
pub struct StressRow {
    pub name: String,
    /// What is done, in a few words.
    pub about: String,
    pub records: Vec<Record>,
}

/// All stresses that were tried.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StabilityMap {
    pub rows: Vec<StressRow>,
}

impl StressRow {
    /// The first record that is called so or worse, with its number.
    fn first(&self, verdict: Verdict) -> Option<(usize, &Record)> {
        self.records.iter().enumerate().find(|(_, record)| record.verdict() >= verdict)
    }

    /// The share of its values before it fails; 1 if it never does.
    fn held_share(&self) -> f64 {
        match self.first(Verdict::Failed) {
            Some((held, _)) => held as f64 / self.records.len() as f64,
            None => 1.0,
        }
    }
}

impl StabilityMap {
    /// A line a record.
    pub fn csv(&self) -> String {
        let header = "stress,value,label,verdict,flaws,frames_asked,frames_done,faces,energy_gain,kick,\
                      speed_share,crossings,crossings_at_end,cuts,cuts_at_end,trapped,\
                      largest_stretch,fall,fall_min,extra_steps,unconverged_steps,warnings,cpu_seconds";
        let all = self.rows.iter().flat_map(|row| &row.records);
        let lines = std::iter::once(header.to_owned()).chain(all.map(csv_line));
        lines.collect::<Vec<_>>().join("\n") + "\n"
    }

    /// A list of what breaks first, and a table of all stresses; Markdown.
    pub fn markdown(&self) -> String {
        let list = self.breaking().into_iter().map(|(row, record)| {
            let held = row.records[..].iter().take_while(|r| r.verdict() < Verdict::Failed).last();
            let held = held.map_or("nothing".to_owned(), |r| r.label.clone());
            format!(
                "- **{}** at {} ({}): {}; holds {held}",
                row.name,
                record.label,
                row.about,
                said(record)
            )
        });
        let mut lines = vec!["What breaks, what breaks first above:".to_owned(), String::new()];
        lines.extend(list);
        lines.extend([
            "".into(),
            "| stress | what is done | values | degraded from | fails from |".into(),
        ]);
        lines.push("| --- | --- | --- | --- | --- |".into());
        lines.extend(self.rows.iter().map(StressRow::table_line));
        lines.join("\n") + "\n"
    }

    /// Where each stress that fails does so for the first time, those first that hold the smallest
    /// share of their values.
    fn breaking(&self) -> Vec<(&StressRow, &Record)> {
        let of = |row| Some((row, StressRow::first(row, Verdict::Failed)?.1));
        let mut all: Vec<(&StressRow, &Record)> = self.rows.iter().filter_map(of).collect();
        all.sort_by(|(a, _), (b, _)| a.held_share().total_cmp(&b.held_share()));
        all
    }
}

impl StressRow {
    fn table_line(&self) -> String {
        let values: Vec<&str> = self.records.iter().map(|r| r.label.as_str()).collect();
        let from = |verdict: Verdict| match self.first(verdict) {
            Some((_, record)) if record.verdict() == verdict => {
                format!("{}: {}", record.label, said(record))
            }
            _ => "-".to_owned(),
        };
        format!(
            "| {} | {} | {} | {} | {} |",
            self.name,
            self.about,
            values.join(", "),
            from(Verdict::Degraded),
            from(Verdict::Failed)
        )
    }
}

/// All flaws of a record.
fn said(record: &Record) -> String {
    let texts: Vec<String> = record.flaws().into_iter().map(|flaw| flaw.text).collect();
    texts.join(", ")
}

fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Ok => "ok",
        Verdict::Degraded => "degraded",
        Verdict::Failed => "failed",
    }
}

fn csv_line(record: &Record) -> String {
    // Exhaustive, so that nothing new is forgotten; what ended it is among the flaws.
    let Record {
        stress,
        value,
        label,
        frames_asked,
        frames_done,
        faces,
        broken: _,
        is_too_slow: _,
        energy_gain,
        kick,
        speed_share,
        crossings,
        crossings_at_end,
        cuts,
        cuts_at_end,
        trapped,
        largest_stretch,
        fall,
        fall_min,
        extra_steps,
        unconverged_steps,
        warnings,
        cpu_seconds,
    } = record;
    let text = |text: &str| format!("\"{}\"", text.replace('"', "'").replace('\n', " "));
    [
        text(stress),
        value.to_string(),
        text(label),
        verdict_name(record.verdict()).to_owned(),
        text(&said(record)),
        frames_asked.to_string(),
        frames_done.to_string(),
        faces.to_string(),
        format!("{energy_gain:.3e}"),
        kick.map_or(String::new(), |kick| format!("{kick:.3e}")),
        format!("{speed_share:.3e}"),
        crossings.to_string(),
        crossings_at_end.to_string(),
        cuts.to_string(),
        cuts_at_end.to_string(),
        trapped.to_string(),
        format!("{largest_stretch:.4}"),
        format!("{fall:.4}"),
        format!("{fall_min:.4}"),
        extra_steps.to_string(),
        unconverged_steps.to_string(),
        warnings.to_string(),
        format!("{cpu_seconds:.2}"),
    ]
    .join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(value: f64, crossings_at_end: usize, trapped: usize) -> Record {
        Record {
            label: format!("x{value}"),
            value,
            crossings: crossings_at_end,
            crossings_at_end,
            trapped,
            speed_share: 0.1,
            ..Record::default()
        }
    }

    fn row(name: &str, records: Vec<Record>) -> StressRow {
        let of_row = |record| Record { stress: name.into(), ..record };
        let records = records.into_iter().map(of_row).collect();
        StressRow { name: name.into(), about: "done so".into(), records }
    }

    fn map() -> StabilityMap {
        let holds = row("holds", vec![record(1.0, 0, 0), record(2.0, 0, 0)]);
        let late = row("late", vec![record(1.0, 0, 0), record(2.0, 0, 3), record(3.0, 4, 0)]);
        let early = row("early", vec![record(1.0, 2, 0), record(2.0, 5, 0)]);
        StabilityMap { rows: vec![holds, late, early] }
    }

    #[test]
    fn what_breaks_first_is_named_first_with_its_setting_and_reason() {
        let text = map().markdown();
        let list: Vec<&str> = text.lines().filter(|line| line.starts_with("- ")).collect();
        assert_eq!(list.len(), 2, "{text}");
        assert!(list[0].starts_with("- **early** at x1") && list[0].contains("2 crossings"));
        assert!(list[1].starts_with("- **late** at x3") && list[1].ends_with("holds x2"));
        assert!(
            text.contains(
                "| late | done so | x1, x2, x3 | x2: 3 nodes trapped | x3: 4 crossings |"
            )
        );
        assert!(text.contains("| holds | done so | x1, x2 | - | - |"), "{text}");
    }

    #[test]
    fn the_csv_has_a_line_a_record_and_as_many_fields_as_its_header() {
        let csv = map().csv();
        let fields: Vec<usize> = csv.lines().map(|line| line.split(',').count()).collect();
        assert_eq!(fields, [23; 8]);
        assert!(csv.contains("\"late\",3,\"x3\",failed,\"4 crossings\""), "{csv}");
    }

    #[test]
    fn the_map_shows_every_value_with_its_verdict_and_time() {
        let svg = map().svg().unwrap();
        for text in ["late", "x3", "3 nodes trapped", "4 crossings", "0.0 s"] {
            assert!(svg.contains(text), "{text}: {svg}");
        }
        assert!(StabilityMap::default().svg().unwrap().starts_with("<svg"));
    }
}
