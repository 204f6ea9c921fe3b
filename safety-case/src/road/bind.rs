//! A mapping and a DBC are checked against each other and become a decoder; every error names file, line, signal.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use can_dbc::{Dbc, Message, MessageId};
use supervisor::wire::{Qualifier, Timing};
use supervisor::{
    Channel, Class, ClosingCmS, Config, DistanceCm, MAX_CAMERA, MAX_RADAR, Millis, OffsetCm, Outputs, Signal,
};
use toml::Spanned;

use super::extract::Extraction;
use super::field::{COMMANDS, INPUTS};
use super::mapped::{CommandSlot, InputSlot, Last, Mapped, ObjectSlot, Slot, key};
use super::mapping::{CommandEntry, Ids, InputEntry, MapError, Mapping, ObjectEntry, SignalEntry, Text};
use super::value::{Kind, Value, snake};

/// Reads a DBC.
///
/// # Errors
/// If the file cannot be read, or is no DBC.
pub fn dbc(file: &Path) -> Result<(Dbc, PathBuf), MapError> {
    let text = Text::read(file)?;
    dbc_text(&text).map(|dbc| (dbc, text.file))
}

/// Reads the text of a DBC.
///
/// # Errors
/// If it is no DBC.
pub fn dbc_text(text: &Text) -> Result<Dbc, MapError> {
    Dbc::try_from(text.text.as_str()).map_err(|error| text.error(None, format!("not a DBC: {error}")))
}

/// Makes the decoder.
///
/// # Errors
/// The first entry of the mapping that does not fit the DBC or the supervisor.
pub fn bind(mapping: &Mapping, text: &Text, dbc: &(Dbc, PathBuf), config: &Config) -> Result<Mapped, MapError> {
    let mut binder =
        Binder { text, dbc: &dbc.0, dbc_file: &dbc.1, ids: mapping.ids, config, mapped: empty(mapping.ids, config) };
    for entry in &mapping.input {
        binder.input(entry)?;
    }
    for entry in &mapping.command {
        binder.command(entry)?;
    }
    for (camera, entries, most) in [(false, &mapping.radar, MAX_RADAR), (true, &mapping.camera, MAX_CAMERA)] {
        for (index, entry) in entries.iter().enumerate() {
            if index >= most {
                return Err(
                    text.error(Some(entry.message.span().start), format!("more than {most} objects of one sensor"))
                );
            }
            binder.object(entry, camera)?;
        }
    }
    Ok(binder.mapped)
}

fn empty(ids: Ids, config: &Config) -> Mapped {
    Mapped {
        ids,
        slots: HashMap::new(),
        inputs: Vec::new(),
        commands: Vec::new(),
        objects: Vec::new(),
        object_age: config.object_age,
    }
}

struct Binder<'a> {
    text: &'a Text,
    dbc: &'a Dbc,
    dbc_file: &'a Path,
    ids: Ids,
    config: &'a Config,
    mapped: Mapped,
}

impl Binder<'_> {
    fn message(&self, name: &Spanned<String>) -> Result<&Message, MapError> {
        self.dbc.messages.iter().find(|message| message.name == *name.get_ref()).ok_or_else(|| {
            let file = self.dbc_file.display();
            self.error(name, format!("message `{}` is not in {file}", name.get_ref()))
        })
    }

    fn error<T>(&self, at: &Spanned<T>, reason: impl Into<String>) -> MapError {
        self.text.error(Some(at.span().start), reason)
    }

    fn extraction<T>(
        &self,
        at: &Spanned<T>,
        message: &Message,
        entry: &SignalEntry,
        kind: &Kind,
    ) -> Result<Extraction, MapError> {
        let signal = message.signals.iter().find(|signal| signal.name == entry.signal).ok_or_else(|| {
            let names: Vec<&str> = message.signals.iter().map(|signal| signal.name.as_str()).collect();
            let (signal, message, file) = (&entry.signal, &message.name, self.dbc_file.display());
            self.error(
                at,
                format!("message `{message}` of {file} has no signal `{signal}`; it has {}", names.join(", ")),
            )
        })?;
        let float = self.dbc.signal_extended_value_type_list.iter().any(|list| {
            list.message_id == message.id
                && list.signal_name == signal.name
                && list.signal_extended_value_type != can_dbc::SignalExtendedValueType::SignedOrUnsignedInteger
        });
        if float {
            return Err(self.error(
                at,
                format!("signal `{}` is a floating-point number, which a mapping cannot read", signal.name),
            ));
        }
        Extraction::new(entry, signal, kind, self.ids).map_err(|reason| self.error(at, reason))
    }

    fn slot(&mut self, id: MessageId, source: Option<u8>, slot: Slot) {
        let (extended, id) = match id {
            MessageId::Standard(id) => (false, u32::from(id)),
            MessageId::Extended(id) => (true, id),
        };
        self.mapped.slots.entry(key(self.ids, extended, id)).or_default().push((source, slot));
    }

    fn input(&mut self, entry: &InputEntry) -> Result<(), MapError> {
        let field = INPUTS.iter().find(|field| field.name == entry.field.get_ref()).ok_or_else(|| {
            let names: Vec<&str> = INPUTS.iter().map(|field| field.name).collect();
            self.error(
                &entry.field,
                format!("no input is called `{}`; there are {}", entry.field.get_ref(), names.join(", ")),
            )
        })?;
        if self.mapped.inputs.iter().any(|slot| slot.field.name == field.name) {
            return Err(self.error(&entry.field, format!("input `{}` is mapped twice", field.name)));
        }
        let message = self.message(&entry.message)?;
        let id = message.id;
        let signal = SignalEntry {
            signal: entry.signal.get_ref().clone(),
            factor: entry.factor,
            offset: entry.offset,
            values: entry.values.clone(),
        };
        let extraction = self.extraction(&entry.signal, message, &signal, &(field.kind)())?;
        let requalify = entry.requalify_ms.map_or(self.config.requalify, Millis::new);
        let timing = Timing { timeout: Millis::new(entry.timeout_ms), requalify };
        let (qualifier, last) = (Qualifier::NEVER, Signal::NEVER);
        self.slot(id, entry.source, Slot::Input(self.mapped.inputs.len()));
        self.mapped.inputs.push(InputSlot { field: *field, extraction, timing, qualifier, last });
        Ok(())
    }

    fn command(&mut self, entry: &CommandEntry) -> Result<(), MapError> {
        let channel =
            *Channel::ALL.iter().find(|channel| snake(channel) == *entry.channel.get_ref()).ok_or_else(|| {
                let names: Vec<String> = Channel::ALL.iter().map(snake).collect();
                self.error(
                    &entry.channel,
                    format!("no channel is called `{}`; there are {}", entry.channel.get_ref(), names.join(", ")),
                )
            })?;
        if self.mapped.commands.iter().any(|slot| slot.channel == channel) {
            return Err(self.error(&entry.channel, format!("channel `{}` is mapped twice", entry.channel.get_ref())));
        }
        let message = self.message(&entry.message)?;
        let id = message.id;
        let mut template = Outputs::NEUTRAL;
        let mut fields = Vec::new();
        for (name, origin) in &entry.fields {
            let field =
                COMMANDS.iter().find(|field| field.channel == channel && field.name == name).ok_or_else(|| {
                    let names: Vec<&str> =
                        COMMANDS.iter().filter(|field| field.channel == channel).map(|field| field.name).collect();
                    let channel = entry.channel.get_ref();
                    self.error(
                        origin,
                        format!("channel `{channel}` has no field `{name}`; it has {}", names.join(", ")),
                    )
                })?;
            let kind = (field.kind)();
            let wrong = || self.error(origin, format!("field `{name}` takes a signal, or {}", kind.expected()));
            let raw = match (origin.get_ref(), &kind) {
                (toml::Value::Table(table), _) => {
                    let signal: SignalEntry = table
                        .clone()
                        .try_into()
                        .map_err(|error: toml::de::Error| self.error(origin, error.message()))?;
                    fields.push((*field, self.extraction(origin, message, &signal, &kind)?));
                    continue;
                }
                (toml::Value::Float(value), Kind::Number { per_unit, .. }) => crate::number::rounded(value * per_unit),
                (toml::Value::Integer(value), Kind::Number { per_unit, .. }) => {
                    crate::number::rounded(crate::number::signed(*value) * per_unit)
                }
                (toml::Value::Boolean(value), Kind::Names(_)) => kind.code(if *value { "yes" } else { "no" }),
                (toml::Value::String(value), Kind::Names(_)) => kind.code(value),
                (_, Kind::Number { .. } | Kind::Names(_)) => None,
            };
            raw.and_then(|raw| (field.set)(&mut template, raw)).ok_or_else(wrong)?;
        }
        self.slot(id, entry.source, Slot::Command(self.mapped.commands.len()));
        self.mapped.commands.push(CommandSlot { channel, fields, template, last: Last::Never });
        Ok(())
    }

    fn object(&mut self, entry: &ObjectEntry, camera: bool) -> Result<(), MapError> {
        let message = self.message(&entry.message)?;
        let id = message.id;
        let of = |signal: &Spanned<SignalEntry>, kind: Kind| self.extraction(signal, message, signal.get_ref(), &kind);
        let optional = |signal: &Option<Spanned<SignalEntry>>, kind: Kind| {
            signal.as_ref().map(|signal| of(signal, kind)).transpose()
        };
        let slot = ObjectSlot {
            camera,
            distance: of(&entry.distance, DistanceCm::kind())?,
            offset: optional(&entry.offset, OffsetCm::kind())?,
            closing: of(&entry.closing, ClosingCmS::kind())?,
            class: optional(&entry.class, Class::kind())?,
            present: optional(&entry.present, bool::kind())?,
            seen: None,
        };
        self.slot(id, entry.source, Slot::Object(self.mapped.objects.len()));
        self.mapped.objects.push(slot);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::mapping::{Text, parse};
    use super::{Mapped, bind, dbc_text};
    use crate::candump::LogFrame;
    use supervisor::{
        Cause, Command, Commands, Config, EpbRequest, EpbState, Inputs, Millis, Rejection, Scene, Signal, SpeedKmhQ8,
    };

    const DBC: &str = "VERSION \"\"\nNS_ :\nBS_:\nBU_: A\n\
        BO_ 256 Motion: 8 A\n SG_ Speed : 7|16@0+ (0.01,0) [0|250] \"km/h\" A\n SG_ Muxed m1 : 32|8@1+ (1,0) [0|0] \"\" A\n\
        BO_ 512 Parking: 2 A\n SG_ State : 0|2@1+ (1,0) [0|3] \"\" A\n SG_ Wish : 8|2@1+ (1,0) [0|3] \"\" A\n\
        BO_ 2566844926 CCVS1: 8 A\n SG_ Wheel : 8|16@1+ (0.00390625,0) [0|250] \"km/h\" A\n\
        BO_ 768 Object: 8 A\n SG_ Range : 0|16@1+ (0.1,0) [0|200] \"m\" A\n SG_ Rate : 16|16@1- (0.1,0) [-50|50] \"m/s\" A\n";

    fn made(mapping: &str) -> Result<Mapped, String> {
        let text = Text { file: "my.toml".into(), text: mapping.to_owned() };
        let dbc = Text { file: "my.dbc".into(), text: DBC.to_owned() };
        let mapping = parse(&text).map_err(|error| error.to_string())?;
        let dbc = (dbc_text(&dbc).map_err(|error| error.to_string())?, dbc.file);
        bind(&mapping, &text, &dbc, &Config::DEFAULT).map_err(|error| error.to_string())
    }

    fn frame(id: u32, extended: bool, bytes: &[u8]) -> LogFrame {
        let mut data = [0; 8];
        data.iter_mut().zip(bytes).for_each(|(slot, byte)| *slot = *byte);
        LogFrame { micros: 0, id, extended, length: u8::try_from(bytes.len()).unwrap_or(8), data }
    }

    fn sample(mapped: &mut Mapped, now: u32) -> (Inputs, Scene, Commands) {
        let (mut inputs, mut scene, mut commands) = (Inputs::NEVER, Scene::default(), Commands::ABSENT);
        mapped.sample(Millis::new(now), &mut inputs, &mut scene, &mut commands);
        (inputs, scene, commands)
    }

    #[test]
    fn errors_name_file_line_and_signal() {
        for (mapping, wanted) in [
            (
                "[[input]]\nfield = \"spede\"\nmessage = \"Motion\"\nsignal = \"Speed\"",
                "my.toml:2: no input is called `spede`",
            ),
            (
                "[[input]]\nfield = \"wheel_speed\"\nmessage = \"Moton\"\nsignal = \"Speed\"",
                "my.toml:3: message `Moton` is not in my.dbc",
            ),
            (
                "[[input]]\nfield = \"wheel_speed\"\nmessage = \"Motion\"\n\nsignal = \"Sped\"",
                "my.toml:5: message `Motion` of my.dbc has no signal `Sped`; it has Speed, Muxed",
            ),
            (
                "[[input]]\nfield = \"wheel_speed\"\nmessage = \"Motion\"\nsignal = \"Muxed\"",
                "my.toml:4: signal `Muxed` is multiplexed",
            ),
            (
                "[[input]]\nfield = \"epb\"\nmessage = \"Parking\"\nsignal = \"State\"",
                "my.toml:4: signal `State` needs `values`",
            ),
            (
                "[[input]]\nfield = \"epb\"\nmessage = \"Parking\"\nsignal = \"State\"\nvalues = { 0 = \"open\" }",
                "my.toml:4: signal `State`: value 0 is given the name `open`; possible are \"released\", \"applied\"",
            ),
            (
                "[[command]]\nchannel = \"brakes\"\nmessage = \"Parking\"\nfields = {}",
                "my.toml:2: no channel is called `brakes`",
            ),
            (
                "[[command]]\nchannel = \"parking_brake\"\nmessage = \"Parking\"\n[command.fields]\nrequst = \"none\"",
                "my.toml:5: channel `parking_brake` has no field `requst`; it has request, mode",
            ),
            (
                "[[command]]\nchannel = \"parking_brake\"\nmessage = \"Parking\"\n[command.fields]\nrequest = \"aply\"",
                "my.toml:5: field `request` takes a signal, or \"none\", \"apply\", \"release\"",
            ),
            (
                "[[command]]\nchannel = \"parking_brake\"\nmessage = \"Parking\"\n[command.fields]\nrequest = { signl = \"Wish\" }",
                "my.toml:5: unknown field `signl`",
            ),
        ] {
            let error = made(mapping).map_or_else(|error| error, |_| String::new());
            assert!(error.starts_with(wanted), "{error}\n  instead of\n{wanted}");
        }
        let twice = "[[input]]\nfield = \"wheel_speed\"\nmessage = \"Motion\"\nsignal = \"Speed\"\n".repeat(2);
        assert!(made(&twice).is_err_and(|error| error.starts_with("my.toml:6: input `wheel_speed` is mapped twice")));
    }

    #[test]
    fn an_input_is_qualified_and_goes_stale() -> Result<(), String> {
        let mut mapped = made(
            "[[input]]\nfield = \"wheel_speed\"\nmessage = \"Motion\"\nsignal = \"Speed\"\nfactor = 1.0\ntimeout_ms = 100\nrequalify_ms = 50",
        )?;
        assert_eq!(sample(&mut mapped, 0).0.wheel_speed, Signal::Unknown(Cause::NeverReceived));
        // 36.00 km/h, big-endian.
        let forty = frame(256, false, &[0x0E, 0x10, 0, 0, 0, 0, 0, 0]);
        for (now, wanted) in [
            (10, Signal::Unknown(Cause::Requalifying)),
            (40, Signal::Unknown(Cause::Requalifying)),
            (60, Signal::Known(SpeedKmhQ8::new(36 * 256))),
        ] {
            assert_eq!(mapped.accept(Millis::new(now), &forty), Some(Ok(())));
            assert_eq!(sample(&mut mapped, now).0.wheel_speed, wanted, "at {now} ms");
        }
        assert_eq!(sample(&mut mapped, 161).0.wheel_speed, Signal::Unknown(Cause::Stale));
        assert_eq!(mapped.accept(Millis::new(170), &frame(256, true, &[0; 8])), None, "another kind of identifier");
        assert_eq!(mapped.accept(Millis::new(170), &frame(256, false, &[0])), Some(Err(())), "too short");
        assert_eq!(sample(&mut mapped, 170).0.wheel_speed, Signal::Unknown(Cause::EndToEnd));
        Ok(())
    }

    #[test]
    fn j1939_compares_the_group_and_the_source() -> Result<(), String> {
        let mut mapped = made(
            "ids = \"j1939\"\n[[input]]\nfield = \"wheel_speed\"\nmessage = \"CCVS1\"\nsignal = \"Wheel\"\nsource = 0\nrequalify_ms = 0",
        )?;
        let data = [0xFF, 0, 10, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF];
        assert_eq!(mapped.accept(Millis::new(0), &frame(0x18FE_F121, true, &data)), None, "another sender");
        assert_eq!(mapped.accept(Millis::new(0), &frame(0x0CFE_F100, true, &data)), Some(Ok(())), "another priority");
        assert_eq!(sample(&mut mapped, 0).0.wheel_speed, Signal::Known(SpeedKmhQ8::new(10 * 256)));
        Ok(())
    }

    #[test]
    fn a_command_is_fresh_held_and_rejected() -> Result<(), String> {
        let mut mapped = made(
            "[[input]]\nfield = \"epb\"\nmessage = \"Parking\"\nsignal = \"State\"\nrequalify_ms = 0\nvalues = { 0 = \"released\", 1 = \"applied\" }\n\
             [[command]]\nchannel = \"parking_brake\"\nmessage = \"Parking\"\n[command.fields]\nmode = \"automatic\"\n\
             request = { signal = \"Wish\", values = { 0 = \"none\", 1 = \"apply\", 2 = \"release\" } }",
        )?;
        assert_eq!(sample(&mut mapped, 0).2.epb, Command::Absent);
        mapped.accept(Millis::new(10), &frame(512, false, &[1, 2]));
        let (inputs, _, commands) = sample(&mut mapped, 10);
        assert_eq!(inputs.epb, Signal::Known(EpbState::Applied));
        assert!(matches!(commands.epb, Command::Fresh(epb) if epb.request == EpbRequest::Release));
        assert!(matches!(sample(&mut mapped, 30).2.epb, Command::Held(age, _) if age == Millis::new(20)));
        mapped.accept(Millis::new(40), &frame(512, false, &[1, 3]));
        assert_eq!(sample(&mut mapped, 40).2.epb, Command::Rejected(Rejection::Field));
        mapped.accept(Millis::new(50), &frame(512, false, &[1, 0]));
        assert!(matches!(sample(&mut mapped, 50).2.epb, Command::Fresh(_)));
        assert_eq!(sample(&mut mapped, 20_000).2.epb, Command::Absent);
        Ok(())
    }

    #[test]
    fn a_radar_fills_its_list() -> Result<(), String> {
        let mut mapped = made(
            "[[radar]]\nmessage = \"Object\"\ndistance = { signal = \"Range\" }\nclosing = { signal = \"Rate\", factor = -1.0 }",
        )?;
        assert!(!sample(&mut mapped, 0).1.radar_known);
        for now in [0, 50, 100] {
            // 50.0 m, −10.0 m/s.
            mapped.accept(Millis::new(now), &frame(768, false, &[0xF4, 0x01, 0x9C, 0xFF, 0, 0, 0, 0]));
        }
        let scene = sample(&mut mapped, 110).1;
        let object = scene.radar.first().ok_or("no object")?;
        assert!(scene.radar_known && !scene.camera_known);
        assert_eq!((object.distance.raw(), object.closing.raw(), object.updates.raw()), (5000, 1000, 3));
        assert!(!sample(&mut mapped, 1000).1.radar_known);
        Ok(())
    }
}
