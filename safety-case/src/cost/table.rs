//! The table: for each stage its greatest count, where it occurred, and the bar.

use super::CostError;

/// The stage that measures the measuring.
const NOTHING: &str = "nothing";
/// The stages that the bar of the core takes together.
const CORE: [&str; 2] = ["decide", "vet"];
/// Their sum, in the same cycle.
const SUM: &str = "decide + vet";
/// The scenario of random cycles.
pub(super) const RANDOM: &str = "random";
/// How the scenarios end that show how the step grows with its objects.
pub(super) const GROWING: &str = " radar objects";

/// One measured call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// In which situation.
    pub scenario: String,
    /// What was called.
    pub stage: String,
    /// Instructions.
    pub count: u64,
}

/// One stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// What was called.
    pub stage: String,
    /// The greatest count of each scenario, in the order in which they ran.
    pub scenarios: Vec<(String, u64)>,
    /// The counts of the random cycles, in order of size.
    random: Vec<u64>,
}

impl Row {
    /// The greatest count of all.
    #[must_use]
    pub fn greatest(&self) -> u64 {
        self.scenarios.iter().map(|(_, count)| *count).max().unwrap_or(0)
    }

    /// The median of the random cycles, if there were any.
    #[must_use]
    pub fn median(&self) -> Option<u64> {
        self.random.get(self.random.len() / 2).copied()
    }

    /// How it grows: the number of objects, and the count.
    pub fn growth(&self) -> impl Iterator<Item = (&str, u64)> {
        self.scenarios.iter().filter_map(|(name, count)| Some((name.strip_suffix(GROWING)?, *count)))
    }
}

/// The greatest count that the design allows for a stage.
#[must_use]
pub fn bar(stage: &str) -> Option<u64> {
    match stage {
        SUM => Some(6_000),
        "whole step" => Some(60_000),
        name if name.starts_with("vet_") => Some(300),
        _ => None,
    }
}

/// Puts the labels that the measured program printed and the counts together.
///
/// # Errors
/// If there is not one count for each label.
pub fn calls(labels: &str, counts: &[u64]) -> Result<Vec<Call>, CostError> {
    let labels: Vec<(&str, &str)> = labels.lines().filter_map(|line| line.split_once('\t')).collect();
    if labels.is_empty() || labels.len() != counts.len() {
        return Err(CostError::Form(format!("{} labels and {} counts", labels.len(), counts.len())));
    }
    let all = labels.iter().zip(counts);
    Ok(all
        .map(|((scenario, stage), count)| Call {
            scenario: (*scenario).to_owned(),
            stage: (*stage).to_owned(),
            count: *count,
        })
        .collect())
}

/// The table: the cost of measuring is taken off, and the sum of the core added.
#[must_use]
pub fn rows(calls: &[Call]) -> Vec<Row> {
    let nothing = calls.iter().filter(|call| call.stage == NOTHING).map(|call| call.count).max().unwrap_or(0);
    let mut rows = Vec::new();
    let mut sum = 0_u64;
    for call in calls.iter().filter(|call| call.stage != NOTHING) {
        let count = call.count.saturating_sub(nothing);
        note(&mut rows, &call.stage, &call.scenario, count);
        if call.stage == CORE[0] {
            sum = count;
        } else if call.stage == CORE[1] {
            note(&mut rows, SUM, &call.scenario, sum.saturating_add(count));
        }
    }
    rows
}

fn note(rows: &mut Vec<Row>, stage: &str, scenario: &str, count: u64) {
    let place = rows.iter().position(|row| row.stage == stage).unwrap_or_else(|| {
        rows.push(Row { stage: stage.to_owned(), scenarios: Vec::new(), random: Vec::new() });
        rows.len().saturating_sub(1)
    });
    let Some(row) = rows.get_mut(place) else { return };
    if scenario == RANDOM {
        let at = row.random.partition_point(|present| *present < count);
        row.random.insert(at, count);
    }
    match row.scenarios.iter_mut().find(|(name, _)| name == scenario) {
        Some((_, greatest)) => *greatest = count.max(*greatest),
        None => row.scenarios.push((scenario.to_owned(), count)),
    }
}

/// The whole table in Markdown: a row for each stage, a column for each scenario.
#[must_use]
pub fn markdown(rows: &[Row]) -> String {
    let mut scenarios: Vec<&str> = Vec::new();
    for (name, _) in rows.iter().flat_map(|row| &row.scenarios) {
        if !scenarios.contains(&name.as_str()) && !name.ends_with(GROWING) {
            scenarios.push(name);
        }
    }
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut head = ["stage", "bar", "greatest", "median of random"].map(str::to_owned).to_vec();
    head.extend(scenarios.iter().map(|name| (*name).to_owned()));
    let mut text = line(&head);
    text.push_str(&"|---".repeat(head.len()));
    text.push_str("|\n");
    let cell = |count: Option<u64>| count.map_or_else(|| "–".to_owned(), |count| count.to_string());
    for row in rows {
        let mut cells = vec![row.stage.clone(), cell(bar(&row.stage)), row.greatest().to_string(), cell(row.median())];
        let of = |name: &str| row.scenarios.iter().find(|(scenario, _)| scenario == name).map(|(_, count)| *count);
        cells.extend(scenarios.iter().map(|name| cell(of(name))));
        text.push_str(&line(&cells));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{Row, calls, markdown, rows};

    const LABELS: &str = "a\tnothing\na\tdecide\na\tvet\nb\tdecide\nb\tvet\nb\tdecide\nb\tvet\n";

    #[test]
    fn the_greatest_counts_less_the_measuring_and_the_sum_of_one_cycle() -> Result<(), super::CostError> {
        let rows = rows(&calls(LABELS, &[5, 105, 15, 205, 25, 105, 95])?);
        let named = |stage: &str| rows.iter().find(|row| row.stage == stage).map(Row::greatest);
        assert_eq!(named("decide"), Some(200));
        assert_eq!(named("vet"), Some(90));
        // Not 290: that decide and that vet were not of one cycle.
        assert_eq!(named("decide + vet"), Some(220));
        assert_eq!(named("nothing"), None);
        assert!(markdown(&rows).contains("| decide + vet | 6000 | 220 | – | 110 | 220 |"), "{}", markdown(&rows));
        Ok(())
    }

    #[test]
    fn the_median_is_of_the_random_cycles_and_growth_stands_apart() -> Result<(), super::CostError> {
        let labels = "random\tstep\nrandom\tstep\nrandom\tstep\n2 radar objects\tstep\n";
        let rows = rows(&calls(labels, &[30, 10, 20, 99])?);
        let Some(row) = rows.first() else { unreachable!("there is a row") };
        assert_eq!((row.median(), row.greatest()), (Some(20), 99));
        assert_eq!(row.growth().collect::<Vec<_>>(), [("2", 99)]);
        assert!(!markdown(&rows).contains("objects"));
        Ok(())
    }

    #[test]
    fn every_label_has_its_count() {
        assert!(calls(LABELS, &[5, 105]).is_err());
        assert!(calls("", &[]).is_err());
    }
}
