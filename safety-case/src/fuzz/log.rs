//! What libFuzzer says.

/// What was heard of a running target so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Heard {
    /// Coverage: edges and counters that the inputs reach.
    pub edges: u64,
    /// The corpus that it began with has been read.
    pub began: bool,
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
            if self.began {
                self.grew = second.max(1);
            }
        }
        // Up to here it reads the corpus, with pulses between.
        self.began |= line.contains("INITED");
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
        let mut heard = Heard::default();
        heard.line("#256\tpulse  cov: 8001 ft: 40000 corp: 250/50Kb exec/s: 30 rss: 400Mb", 9);
        assert_eq!(heard, Heard { edges: 8_001, began: false, grew: 0, inputs: None }, "it still reads");
        heard.line("#361\tINITED cov: 8123 ft: 40120 corp: 340/60Kb exec/s: 30 rss: 400Mb", 12);
        assert_eq!(heard, Heard { edges: 8_123, began: true, grew: 0, inputs: None });
        heard.line("#512\tpulse  cov: 8123 ft: 40120 corp: 340/60Kb lim: 400 exec/s: 30 rss: 400Mb", 20);
        assert_eq!(heard.grew, 0, "a pulse is no growth");
        heard.line(
            "#600\tREDUCE cov: 8123 ft: 40121 corp: 341/60Kb lim: 400 exec/s: 30 rss: 400Mb L: 3/9 MS: 1 ChangeBit-",
            21,
        );
        assert_eq!(heard.grew, 0, "another input for the same edges is no growth");
        heard.line(
            "#700\tNEW    cov: 8125 ft: 40123 corp: 342/60Kb lim: 400 exec/s: 30 rss: 400Mb L: 3/9 MS: 1 ChangeBit-",
            30,
        );
        assert_eq!(heard, Heard { edges: 8_125, began: true, grew: 30, inputs: None });
        heard.line("stat::number_of_executed_units: 701", 60);
        assert_eq!(heard.inputs, Some(701));
    }

    #[test]
    fn other_lines_say_nothing() {
        let mut heard = Heard::default();
        for line in [
            "",
            "INFO: Running with entropic power schedule (0xFF, 100).",
            "cov:",
            "cov: many",
            "stat::number_of_executed_units:",
        ] {
            heard.line(line, 5);
        }
        assert_eq!(heard, Heard::default());
    }
}
