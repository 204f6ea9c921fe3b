//! Trouble codes of a drive: when each was active, how often, what driver and ADS were told (RPT-1).
//!
//! The report is the shipped one of `supervisor::report`. A log of our link carries no feedback of lamps and wipers,
//! so their codes (RSP-1h) cannot occur in a replay.

use serde_json::{Value, json};
use supervisor::Millis;
use supervisor::report::{BodyFaults, Fmi, Lamp, Lamps, TROUBLE_CODES, TroubleCode};

use crate::cycle::CYCLE;
use crate::number::seconds;

/// One stretch in which a code was active.
#[derive(Clone, Copy, Debug)]
pub struct Episode {
    /// The row of the table.
    pub code: &'static TroubleCode,
    /// Which occurrence it is, as DM1 counts.
    pub count: u8,
    /// When it became active, in microseconds on the axis.
    pub from: u64,
    /// When it healed, or the end of the log.
    pub to: u64,
    /// It healed; otherwise the log ended first.
    pub healed: bool,
}

impl Episode {
    /// For people: numbers, lamp, what does not work, why, and how it ended.
    #[must_use]
    pub fn text(&self) -> String {
        let TroubleCode { driver, why, .. } = self.code;
        let end = if self.healed { "healed" } else { "still active at the end" };
        format!("{} ×{}, {}: {driver} {why} ({end}) [RPT-1]", name(self.code), self.count, lamp(self.code.lamp))
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let code = self.code;
        json!({
            "type": "trouble", "t": seconds(self.from), "until": seconds(self.to), "healed": self.healed,
            "fault": code.name(), "spn": code.spn.raw(), "fmi": code.fmi.code(), "count": self.count,
            "lamp": lamp(code.lamp), "ads_code": code.ads_code(), "system": format!("{:?}", code.system),
            "driver": code.driver, "why": code.why,
        })
    }
}

/// "SPN 84 FMI 2".
#[must_use]
pub fn name(code: &TroubleCode) -> String {
    format!("SPN {} FMI {}", code.spn.raw(), code.fmi.code())
}

/// The lamp, for people and machines.
#[must_use]
pub const fn lamp(lamp: Lamp) -> &'static str {
    match lamp {
        Lamp::None => "no lamp",
        Lamp::AmberWarning => "amber warning",
        Lamp::RedStop => "red stop",
    }
}

/// What J1939-73 calls the failure mode.
#[must_use]
pub const fn mode(fmi: Fmi) -> &'static str {
    match fmi {
        Fmi::AboveNormal => "above normal, most severe",
        Fmi::Erratic => "erratic or incorrect",
        Fmi::NotResponding => "not responding",
        Fmi::UpdateRate => "abnormal update rate",
        Fmi::BadDevice => "bad device",
        Fmi::Calibration => "out of calibration",
        Fmi::AboveNormalModerate => "above normal, moderately severe",
        Fmi::NetworkData => "network data in error",
        Fmi::ConditionExists => "condition exists",
    }
}

/// What the lane of DM1 shows: how many codes are active, and 256 × the gravest lamp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Active(pub u16);

impl Active {
    fn of(count: usize, lamps: Lamps) -> Self {
        let lamp = if lamps.red_stop { 2 } else { u16::from(lamps.amber_warning) };
        Self(u16::try_from(count).unwrap_or(255).min(255) + 256 * lamp)
    }
    /// How many codes.
    #[must_use]
    pub const fn count(self) -> u16 {
        self.0 % 256
    }
    /// The gravest lamp.
    #[must_use]
    pub const fn lamp(self) -> Lamp {
        match self.0 / 256 {
            0 => Lamp::None,
            1 => Lamp::AmberWarning,
            _ => Lamp::RedStop,
        }
    }
}

/// Follows the shipped report through a drive.
#[derive(Debug, Default)]
pub struct Troubles {
    report: supervisor::report::FaultReport,
    open: Vec<Episode>,
    /// For each code that ever was active, in the order of the first time: its first and its last episode.
    seen: Vec<(Episode, Episode)>,
}

impl Troubles {
    /// Takes a cycle; gives the episodes that it ended.
    pub fn cycle(&mut self, at: u64, now: Millis, decision: &supervisor::Decision) -> Vec<Episode> {
        self.report.observe(now, decision, BodyFaults::NONE);
        let mut ended = Vec::new();
        self.open.retain_mut(|episode| {
            let on = self.report.active().any(|trouble| trouble.code.source == episode.code.source);
            (episode.to, episode.healed) = (if on { at.saturating_add(CYCLE) } else { at }, !on);
            if !on {
                ended.push(*episode);
            }
            on
        });
        for trouble in self.report.active() {
            if !self.open.iter().any(|episode| episode.code.source == trouble.code.source) {
                let (code, count) = (trouble.code, trouble.occurrences);
                self.open.push(Episode { code, count, from: at, to: at.saturating_add(CYCLE), healed: false });
            }
        }
        for episode in &ended {
            self.keep(episode);
        }
        ended
    }

    /// What is active now.
    #[must_use]
    pub fn active(&self) -> Active {
        Active::of(self.open.len(), self.report.lamps())
    }

    /// The episodes that the log cut off.
    pub fn finish(&mut self) -> Vec<Episode> {
        let open = std::mem::take(&mut self.open);
        for episode in &open {
            self.keep(episode);
        }
        open
    }

    /// One row per code that was ever active, in the order of the table.
    #[must_use]
    pub fn rows(&self) -> Vec<Value> {
        let episodes = |code: &TroubleCode| self.seen.iter().find(|(first, _)| first.code.source == code.source);
        let row = |(first, last): &(Episode, Episode)| {
            let mut row = last.json();
            if let Some(fields) = row.as_object_mut() {
                fields.remove("type");
                fields.insert("t".to_owned(), seconds(first.from).into());
                fields.insert("mode".to_owned(), mode(last.code.fmi).into());
            }
            row
        };
        TROUBLE_CODES.iter().filter_map(|code| episodes(code).map(row)).collect()
    }

    fn keep(&mut self, episode: &Episode) {
        match self.seen.iter_mut().find(|(first, _)| first.code.source == episode.code.source) {
            Some((_, last)) => *last = *episode,
            None => self.seen.push((*episode, *episode)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Active, Troubles};
    use supervisor::report::Lamp;
    use supervisor::{Commands, Faults, Inputs, Millis, Record, ResetCause, Scene, Sealed, Supervisor};

    /// RPT-1c: an episode begins with the report and ends when it heals; a code is one row however often it comes.
    #[test]
    fn episodes_are_those_of_the_report() -> Result<(), supervisor::ConfigError> {
        let mut supervisor = Supervisor::new(Sealed::from_default()?, ResetCause::PowerOn, Some(Record::None));
        let mut decision = supervisor.step(Millis::new(0), &Inputs::NEVER, &Scene::default(), &Commands::ABSENT);
        let mut troubles = Troubles::default();
        let mut ended = Vec::new();
        for cycle in 0..4000_u32 {
            let faulty = (400..500).contains(&cycle) || cycle >= 2000;
            decision.status.faults = if faulty { Faults::EBS_RED } else { Faults::NONE };
            ended.extend(troubles.cycle(u64::from(cycle) * 10_000, Millis::new(cycle * 10), &decision));
            let expected =
                if (450..1500).contains(&cycle) || cycle >= 2050 { (1, Lamp::RedStop) } else { (0, Lamp::None) };
            assert_eq!((troubles.active().count(), troubles.active().lamp()), expected, "{cycle}");
        }
        ended.extend(troubles.finish());
        let spans: Vec<_> = ended.iter().map(|each| (each.from, each.to, each.count, each.healed)).collect();
        assert_eq!(spans, [(4_500_000, 15_000_000, 1, true), (20_500_000, 40_000_000, 2, false)]);
        let rows = troubles.rows();
        assert_eq!(rows.len(), 1);
        let row = rows.first().cloned().unwrap_or_default();
        assert_eq!((&row["spn"], &row["fmi"], &row["count"]), (&1439.into(), &31.into(), &2.into()));
        assert_eq!((&row["t"], &row["until"], &row["healed"]), (&4.5.into(), &40.0.into(), &false.into()));
        assert_eq!(
            ended.first().map(super::Episode::text).as_deref(),
            Some(
                "SPN 1439 FMI 31 ×1, red stop: Brake failure. Stop safely. The brake system gives its red warning. \
                 (healed) [RPT-1]"
            )
        );
        assert_eq!(Active(2 * 256 + 3).count(), 3);
        Ok(())
    }
}
