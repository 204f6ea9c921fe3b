//! What libFuzzer says.

/// What was heard of a running target so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Heard {
    /// Coverage: edges and counters that the inputs reach.
    pub edges: u64,
    /// In which second of the run it started, after it was built.
    pub started: Option<u64>,
    /// In which second the corpus that it began with had been read.
    pub began: Option<u64>,
    /// In which second of the run coverage last grew beyond that of the corpus it began with; 0 if it did not.
    pub grew: u64,
    /// Inputs that ran, once it has ended in time.
    pub inputs: Option<u64>,
}

impl Heard {
    /// Takes in one line, heard in this second of the run.
    pub fn line(&mut self, line: &str, second: u64) {
        if let Some(inputs) = after(line, "stat::number_of_executed_units:") {
            self.inputs = Some(inputs);
        }
        if let Some(edges) = after(line, "cov:").filter(|edges| *edges > self.edges) {
            self.edges = edges;
            if self.began.is_some() {
                self.grew = second.max(1);
            }
        }
        if line.starts_with("INFO:") {
            self.started.get_or_insert(second);
        }
        // Up to here it reads the corpus, with pulses between.
        if line.contains("INITED") {
            self.began.get_or_insert(second);
        }
    }

    /// For how long it has run by this second, for how long of that it read its corpus, and for how long it has found no new edge since.
    #[must_use]
    pub fn times(&self, second: u64) -> [u64; 3] {
        let since = |from: Option<u64>| from.map_or(0, |from| second.saturating_sub(from));
        let (ran, tried) = (since(self.started), since(self.began));
        [ran, ran.saturating_sub(tried), tried.min(second.saturating_sub(self.grew))]
    }
}

/// The number that follows a word.
fn after(line: &str, word: &str) -> Option<u64> {
    let (_, rest) = line.split_once(word)?;
    rest.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::Heard;

    #[test]
    fn coverage_of_the_corpus_is_no_growth() {
        let (mut heard, started) = (Heard::default(), Heard { started: Some(3), ..Heard::default() });
        heard.line("INFO: Seed: 7", 3);
        heard.line("#256\tpulse  cov: 8001 ft: 40000 corp: 250/50Kb exec/s: 30 rss: 400Mb", 9);
        assert_eq!(heard, Heard { edges: 8_001, ..started }, "it still reads");
        assert_eq!(heard.times(9), [6, 6, 0], "to read is to try nothing new");
        heard.line("#361\tINITED cov: 8123 ft: 40120 corp: 340/60Kb exec/s: 30 rss: 400Mb", 12);
        assert_eq!(heard, Heard { edges: 8_123, began: Some(12), ..started });
        heard.line("#512\tpulse  cov: 8123 ft: 40120 corp: 340/60Kb lim: 400 exec/s: 30 rss: 400Mb", 20);
        assert_eq!(heard.grew, 0, "a pulse is no growth");
        heard.line(
            "#600\tREDUCE cov: 8123 ft: 40121 corp: 341/60Kb lim: 400 exec/s: 30 rss: 400Mb L: 3/9 MS: 1 ChangeBit-",
            21,
        );
        assert_eq!(heard.times(21), [18, 9, 9]);
        assert_eq!(heard.grew, 0, "another input for the same edges is no growth");
        heard.line(
            "#700\tNEW    cov: 8125 ft: 40123 corp: 342/60Kb lim: 400 exec/s: 30 rss: 400Mb L: 3/9 MS: 1 ChangeBit-",
            30,
        );
        assert_eq!(heard, Heard { edges: 8_125, began: Some(12), grew: 30, ..started });
        assert_eq!(heard.times(60), [57, 9, 30]);
        heard.line("stat::number_of_executed_units: 701", 60);
        assert_eq!(heard.inputs, Some(701));
    }

    #[test]
    fn other_lines_say_nothing() {
        let mut heard = Heard::default();
        for line in [
            "",
            "    Finished `release` profile [optimized + debuginfo] target(s) in 0.09s",
            "cov:",
            "cov: many",
            "stat::number_of_executed_units:",
        ] {
            heard.line(line, 5);
        }
        assert_eq!(heard, Heard::default());
    }
}
