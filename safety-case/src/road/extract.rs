//! From the bits of a frame to the bits, or the code, of a field.

use std::collections::BTreeMap;

use supervisor::{Cause, Signal};

use super::bits::Layout;
use super::mapping::{Ids, SignalEntry};
use super::value::Kind;
use crate::number;

/// How a field is filled from a frame. Made once, used for every frame.
#[derive(Clone, Debug)]
pub struct Extraction {
    layout: Layout,
    factor: f64,
    offset: f64,
    /// Physical range of the DBC, if it says one.
    range: Option<(f64, f64)>,
    /// Raw values from here on say "error" or "not available".
    reserved: u64,
    target: Target,
}

#[derive(Clone, Debug)]
enum Target {
    /// Multiply, add, multiply by the bits per unit.
    Number { factor: f64, offset: f64, per_unit: f64 },
    /// Physical values, both ends included, to codes.
    Names(Vec<(f64, f64, i32)>),
}

impl Extraction {
    /// Checks an entry of the mapping against its signal and the field's kind.
    ///
    /// # Errors
    /// What is wrong, without the place.
    pub fn new(entry: &SignalEntry, signal: &can_dbc::Signal, kind: &Kind, ids: Ids) -> Result<Self, String> {
        let name = &signal.name;
        if signal.multiplexer_indicator != can_dbc::MultiplexIndicator::Plain {
            return Err(format!("signal `{name}` is multiplexed, which a mapping cannot read"));
        }
        let layout = Layout::new(signal.start_bit, signal.size, signal.byte_order, signal.value_type)
            .ok_or_else(|| format!("signal `{name}` does not fit into the 8 bytes of a frame"))?;
        let target = match (kind, &entry.values) {
            (Kind::Number { per_unit, .. }, None) => {
                Target::Number { factor: entry.factor, offset: entry.offset, per_unit: *per_unit }
            }
            (Kind::Number { unit, .. }, Some(_)) => {
                return Err(format!("signal `{name}` becomes a number in {unit}: `values` has no place here"));
            }
            (Kind::Names(_), Some(values)) => Target::Names(names(values, kind, name)?),
            (Kind::Names(_), None) => {
                return Err(format!(
                    "signal `{name}` needs `values`, for example {{ 0 = … }}, with {}",
                    kind.expected()
                ));
            }
        };
        let (least, greatest) = (limit(signal.min), limit(signal.max));
        Ok(Self {
            layout,
            factor: signal.factor,
            offset: signal.offset,
            range: (least < greatest).then_some((least, greatest)),
            reserved: reserved(&layout, ids),
            target,
        })
    }

    /// The field's bits or code; `None` if the frame is too short.
    #[must_use]
    pub fn read(&self, data: [u8; 8], length: u8) -> Option<Signal<i32>> {
        let raw = self.layout.raw(data, length)?;
        if raw >= self.reserved {
            return Some(Signal::Unknown(Cause::NotAvailable));
        }
        let physical = self.layout.number(raw) * self.factor + self.offset;
        if self.range.is_some_and(|(least, greatest)| physical < least || physical > greatest) {
            return Some(Signal::Unknown(Cause::OutOfRange));
        }
        Some(match &self.target {
            Target::Number { factor, offset, per_unit } => number::rounded((physical * factor + offset) * per_unit)
                .map_or(Signal::Unknown(Cause::OutOfRange), Signal::Known),
            Target::Names(names) => names
                .iter()
                .find(|(from, to, _)| (*from..=*to).contains(&physical))
                .map_or(Signal::Unknown(Cause::NotAvailable), |(.., code)| Signal::Known(*code)),
        })
    }
}

fn limit(value: can_dbc::NumericValue) -> f64 {
    match value {
        can_dbc::NumericValue::Uint(value) => number::float(value),
        can_dbc::NumericValue::Int(value) => number::signed(value),
        can_dbc::NumericValue::Double(value) => value,
    }
}

/// J1939-71: the uppermost values of a number of 8, 16 or 32 bits are reserved, down to 0xFB; of 2 bits, 2 is
/// "error" and 3 "not available". Elsewhere every value counts, unless the DBC's range or the table of values says
/// otherwise.
fn reserved(layout: &Layout, ids: Ids) -> u64 {
    match (ids, layout.size()) {
        (Ids::J1939, size @ (8 | 16 | 24 | 32)) => 0xFB << (size - 8),
        (Ids::J1939, 2) => 2,
        (Ids::J1939, size) if size < 64 => layout.ones(),
        (Ids::J1939 | Ids::Exact, _) => u64::MAX,
    }
}

fn names(values: &BTreeMap<String, String>, kind: &Kind, signal: &str) -> Result<Vec<(f64, f64, i32)>, String> {
    values
        .iter()
        .map(|(key, name)| {
            let (from, to) = key.split_once("..").unwrap_or((key, key));
            let bound = |text: &str| {
                text.trim()
                    .parse::<f64>()
                    .map_err(|_| format!("signal `{signal}`: value `{key}` is no number and no range `a..b`"))
            };
            let code = kind.code(name).ok_or_else(|| {
                format!("signal `{signal}`: value {key} is given the name `{name}`; possible are {}", kind.expected())
            })?;
            Ok((bound(from)?, bound(to)?, code))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::mapping::{Ids, SignalEntry};
    use super::super::value::Value;
    use super::Extraction;
    use supervisor::{Cause, Gear, Signal, SpeedKmhQ8};

    fn dbc_signal(text: &str) -> Result<can_dbc::Signal, String> {
        let text = format!("VERSION \"\"\nNS_ :\nBS_:\nBU_: A\nBO_ 291 M: 8 A\n SG_ {text}\n");
        let dbc = can_dbc::Dbc::try_from(text.as_str()).map_err(|error| error.to_string())?;
        dbc.messages.into_iter().flat_map(|message| message.signals).next().ok_or_else(|| "none".to_owned())
    }

    fn entry(values: &[(&str, &str)]) -> SignalEntry {
        let table = values.iter().map(|(key, name)| ((*key).to_owned(), (*name).to_owned())).collect();
        SignalEntry { signal: "S".to_owned(), factor: 1.0, offset: 0.0, values: (!values.is_empty()).then_some(table) }
    }

    #[test]
    fn numbers_are_scaled_and_their_reserved_values_are_not_available() -> Result<(), String> {
        let signal = dbc_signal("S : 8|16@1+ (0.00390625,0) [0|250.99609375] \"km/h\" A")?;
        let read = |ids, data| Extraction::new(&entry(&[]), &signal, &SpeedKmhQ8::kind(), ids).ok()?.read(data, 8);
        assert_eq!(read(Ids::J1939, [0, 0, 40, 0, 0, 0, 0, 0]), Some(Signal::Known(40 * 256)));
        assert_eq!(read(Ids::J1939, [0, 0xFF, 0xFA, 0, 0, 0, 0, 0]), Some(Signal::Known(0xFAFF)));
        assert_eq!(read(Ids::J1939, [0, 0, 0xFB, 0, 0, 0, 0, 0]), Some(Signal::Unknown(Cause::NotAvailable)));
        assert_eq!(read(Ids::J1939, [0, 0xFF, 0xFF, 0, 0, 0, 0, 0]), Some(Signal::Unknown(Cause::NotAvailable)));
        assert_eq!(read(Ids::Exact, [0, 0xFF, 0xFF, 0, 0, 0, 0, 0]), Some(Signal::Unknown(Cause::OutOfRange)));
        Ok(())
    }

    #[test]
    fn names_take_values_and_ranges() -> Result<(), String> {
        let signal = dbc_signal("S : 24|8@1+ (1,-125) [-125|125] \"\" A")?;
        let entry = entry(&[("0", "neutral"), ("1..100", "drive"), ("-125..-1", "reverse")]);
        let extraction = Extraction::new(&entry, &signal, &Gear::kind(), Ids::J1939)?;
        let gear = |raw| extraction.read([0, 0, 0, raw, 0, 0, 0, 0], 8);
        assert_eq!(gear(125), Some(Signal::Known(0)));
        assert_eq!(gear(126), Some(Signal::Known(1)));
        assert_eq!(gear(124), Some(Signal::Known(2)));
        assert_eq!(gear(250), Some(Signal::Unknown(Cause::NotAvailable)));
        assert_eq!(extraction.read([0; 8], 3), None);
        Ok(())
    }

    #[test]
    fn what_cannot_be_read_is_refused_with_the_signal() -> Result<(), String> {
        let plain = dbc_signal("S : 0|2@1+ (1,0) [0|3] \"\" A")?;
        let muxed = dbc_signal("S m1 : 0|2@1+ (1,0) [0|3] \"\" A")?;
        let wide = dbc_signal("S : 60|8@1+ (1,0) [0|3] \"\" A")?;
        let refused = |entry: &SignalEntry, signal| Extraction::new(entry, signal, &Gear::kind(), Ids::Exact).err();
        let says = |error: Option<String>, text: &str| {
            error.is_some_and(|error| error.contains("`S`") && error.contains(text))
        };
        let neutral = entry(&[("0", "neutral")]);
        assert!(says(refused(&neutral, &muxed), "multiplexed"));
        assert!(says(refused(&neutral, &wide), "does not fit"));
        assert!(says(refused(&entry(&[]), &plain), "needs `values`"));
        assert!(says(refused(&entry(&[("0", "nought")]), &plain), "`nought`"));
        assert!(says(refused(&entry(&[("x", "neutral")]), &plain), "`x`"));
        Ok(())
    }
}
