//! A comparison as a table, as CSV, JSON and JUnit XML.

use serde_json::{Map, Value as Json, json};

use super::metric::Metric;
use super::report::{Comparison, Item, Verdict, short};

impl Comparison {
    /// Columns of even width, a line an item, and the largest values last.
    pub fn table(&self) -> String {
        let metrics = self.metrics();
        let mut rows = vec![self.header(&metrics)];
        rows.extend(self.items.iter().map(|item| self.row(item, &metrics)));
        let largest = metrics.iter().map(|&m| cell(self.largest(m)));
        let failed = match self.failed().count() {
            0 if !self.is_judged() => NOTHING_JUDGED.to_owned(),
            0 => String::new(),
            count => format!("{count} of {} failed", self.items.len()),
        };
        rows.push(["largest".to_owned()].into_iter().chain(largest).chain([failed]).collect());
        aligned(&rows)
    }

    fn header(&self, metrics: &[Metric]) -> Vec<String> {
        let names = metrics.iter().map(|m| m.name());
        let columns = [self.kind.item_name()].into_iter().chain(names).chain([""]);
        columns.map(str::to_owned).collect()
    }

    fn row(&self, item: &Item, metrics: &[Metric]) -> Vec<String> {
        let verdict = match self.verdict(item) {
            Verdict::Within => String::new(),
            Verdict::Faulty(fault) => fault.to_string(),
            Verdict::NotJudged => "chaos, not judged".to_owned(),
            Verdict::Exceeded(all) => listed(&all),
        };
        let values = metrics.iter().map(|&m| cell(item.value(m)));
        [item.name.clone()].into_iter().chain(values).chain([verdict]).collect()
    }

    /// A row an item; numbers in the shortest form that reads back to the same bits. Empty where
    /// there is no value, `inf` where there is no bound.
    pub fn csv(&self) -> String {
        let metrics = self.metrics();
        let mut header = vec![self.kind.item_name(), "judged"];
        header.extend(metrics.iter().map(|m| m.name()));
        header.extend(["floor_rms_px", "fault"]);
        let mut lines = vec![header.join(",")];
        for item in &self.items {
            let number = |value: Option<f64>| value.map_or(String::new(), |v| v.to_string());
            let value = |&m: &Metric| match item.value(m) {
                Some(None) => "inf".to_owned(),
                other => number(other.flatten()),
            };
            let mut row = vec![quoted(&item.name), (!item.is_chaos).to_string()];
            row.extend(metrics.iter().map(value));
            row.push(number(item.floor_rms_px));
            row.push(quoted(&item.fault.map_or(String::new(), |fault| fault.to_string())));
            lines.push(row.join(","));
        }
        lines.join("\n") + "\n"
    }

    /// See `docs/compare.md`; what is without bound is null.
    pub fn json(&self) -> String {
        let largest: Map<String, Json> = self
            .metrics()
            .into_iter()
            .map(|m| (m.name().to_owned(), json!(self.largest(m).flatten())))
            .collect();
        let value = json!({
            "kind": self.kind.name(),
            "a": self.a,
            "b": self.b,
            "passed": self.has_passed(),
            "tolerance": self.tolerance,
            "largest": largest,
            "items": self.items.iter().map(|item| self.item_json(item)).collect::<Vec<_>>(),
        });
        serde_json::to_string_pretty(&value).expect("a comparison is plain data") + "\n"
    }

    fn item_json(&self, item: &Item) -> Json {
        let mut entry = Map::new();
        entry.insert("name".into(), json!(item.name));
        entry.insert("judged".into(), json!(!item.is_chaos));
        for (metric, value) in &item.values {
            entry.insert(metric.name().into(), json!(value));
        }
        if let Some(floor) = item.floor_rms_px {
            entry.insert("floor_rms_px".into(), json!(floor));
        }
        match self.verdict(item) {
            Verdict::Faulty(fault) => {
                entry.insert("fault".into(), json!(fault.to_string()));
            }
            Verdict::Exceeded(all) => {
                let names: Vec<&str> = all.iter().map(|excess| excess.metric.name()).collect();
                entry.insert("exceeded".into(), json!(names));
            }
            Verdict::Within | Verdict::NotJudged => {}
        }
        Json::Object(entry)
    }

    /// A test case an item, as continuous integration reads it.
    pub fn junit(&self) -> String {
        let skipped = self.items.iter().filter(|i| self.verdict(i) == Verdict::NotJudged).count();
        // Where all is skipped, a case of its own fails.
        let unjudged = usize::from(!self.is_judged());
        let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        text += &format!(
            "<testsuites>\n  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{skipped}\" errors=\"0\">\n",
            escaped(&format!("{} against {}", self.b, self.a)),
            self.items.len() + unjudged,
            self.failed().count() + unjudged,
        );
        for item in &self.items {
            let name = escaped(&format!("{} {}", self.kind.item_name(), item.name));
            let outcome = match self.verdict(item) {
                Verdict::Within => None,
                Verdict::NotJudged => Some(("skipped", "chaos, not judged".to_owned())),
                Verdict::Faulty(fault) => Some(("failure", fault.to_string())),
                Verdict::Exceeded(all) => Some(("failure", listed(&all))),
            };
            let case = format!("    <testcase classname=\"shotsilk.compare\" name=\"{name}\"");
            text += &match outcome {
                None => format!("{case}/>\n"),
                Some((element, why)) => {
                    format!("{case}><{element} message=\"{}\"/></testcase>\n", escaped(&why))
                }
            };
        }
        if unjudged > 0 {
            text += &format!(
                "    <testcase classname=\"shotsilk.compare\" name=\"judged\"><failure message=\"{NOTHING_JUDGED}\"/></testcase>\n"
            );
        }
        text + "  </testsuite>\n</testsuites>\n"
    }
}

/// Of a comparison that is neither passed nor exceeds a limit.
const NOTHING_JUDGED: &str = "nothing was judged";

fn listed(all: &[super::report::Excess]) -> String {
    all.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

fn cell(value: Option<Option<f64>>) -> String {
    match value {
        None => "-".to_owned(),
        Some(None) => "unbounded".to_owned(),
        Some(Some(value)) => short(value),
    }
}

/// The first and the last column to the left, numbers to the right.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().enumerate().map(|(k, text)| match k {
            0 => format!("{text:<width$}", width = widths[k]),
            k if k + 1 == columns => text.clone(),
            k => format!("{text:>width$}", width = widths[k]),
        });
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// For XML; characters that it cannot hold are left out.
fn escaped(text: &str) -> String {
    let is_allowed = |c: &char| *c >= ' ' || matches!(c, '\t' | '\n' | '\r');
    let escape = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        c => c.to_string(),
    };
    text.chars().filter(is_allowed).map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::super::report::{Fault, Kind};
    use super::super::tolerance::Tolerance;
    use super::*;

    fn comparison() -> Comparison {
        let of = |name: &str, rms| Item {
            name: name.to_owned(),
            values: vec![(Metric::RmsPx, Some(rms)), (Metric::SilhouettePx, None)],
            ..Item::default()
        };
        Comparison {
            a: "ref".into(),
            b: "<new> & \"odd\"".into(),
            kind: Kind::Runs,
            tolerance: Some(Tolerance { rms_px: Some(1.0), ..Tolerance::default() }),
            items: vec![
                of("1", 0.5),
                of("2", 1.5),
                Item { is_chaos: true, floor_rms_px: Some(3.0), ..of("3", 9.0) },
                Item { name: "4".into(), fault: Some(Fault::OnlyInA), ..Item::default() },
            ],
        }
    }

    #[test]
    fn the_table_has_a_line_an_item_and_says_what_is_wrong() {
        let table = comparison().table();
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(lines.len(), 6);
        assert!(lines[2].ends_with("rms_px is 1.500, allowed is 1.000"), "{table}");
        assert!(lines[3].ends_with("chaos, not judged") && lines[4].ends_with("only in A"));
        assert!(lines[5].starts_with("largest") && lines[5].ends_with("2 of 4 failed"), "{table}");
    }

    #[test]
    fn json_is_read_back_with_the_verdict() {
        let json: Json = serde_json::from_str(&comparison().json()).unwrap();
        assert_eq!((&json["passed"], &json["largest"]["rms_px"]), (&json!(false), &json!(1.5)));
        assert_eq!(json["items"][1]["exceeded"], json!(["rms_px"]));
        assert_eq!(json["items"][0]["silhouette_px"], Json::Null);
        assert_eq!(json["items"][2]["judged"], json!(false));
    }

    #[test]
    fn csv_has_as_many_cells_in_every_row() {
        let csv = comparison().csv();
        assert!(csv.lines().all(|line| line.split(',').count() == 6), "{csv}");
        assert!(csv.lines().nth(3).unwrap().starts_with("3,false,9,inf,3"), "{csv}");
    }

    #[test]
    fn junit_counts_failures_and_escapes_names() {
        let xml = comparison().junit();
        assert!(xml.contains("tests=\"4\" failures=\"2\" skipped=\"1\""), "{xml}");
        assert!(xml.contains("&lt;new&gt; &amp; &quot;odd&quot; against ref"), "{xml}");
        assert_eq!(xml.matches("<failure").count(), 2);
    }

    #[test]
    fn where_all_is_chaos_every_form_says_that_nothing_was_judged() {
        let mut comparison = comparison();
        comparison.items.retain(|item| item.is_chaos);
        assert!(comparison.table().ends_with("nothing was judged"), "{}", comparison.table());
        let json: Json = serde_json::from_str(&comparison.json()).unwrap();
        assert_eq!(json["passed"], json!(false));
        let xml = comparison.junit();
        assert!(xml.contains("tests=\"2\" failures=\"1\" skipped=\"1\""), "{xml}");
        assert_eq!(xml.matches("<failure").count(), 1);
    }
}
