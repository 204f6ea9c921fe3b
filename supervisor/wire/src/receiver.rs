//! From frames to inputs, object lists and commands.

use core::array;

use supervisor_core::{
    BrakeMode, Cause, Channel, Channels, Command, Commands, Config, DecelMs2Q11, Inputs, Millis, ServiceBrake, Status,
    Steering,
};
use supervisor_perceive::{CameraObject, MAX_CAMERA, MAX_RADAR, RadarObject, Scene};

use crate::frame::Frame;
use crate::link::Link;
use crate::list::List;
use crate::message::{ControlTime, Destination, Source, Values};
use crate::qualifier::{FOREVER, Timing, elapsed};
use crate::refusal::{Accepted, Fault, Refusal};
use crate::sender::Sender;
use crate::table::Message;

/// What one cycle of the supervisor reads.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a> {
    /// The inputs.
    pub inputs: &'a Inputs,
    /// The object lists.
    pub scene: &'a Scene,
    /// The commands.
    pub commands: &'a Commands,
}

/// Takes frames in and keeps what they say until the cycle asks for it.
#[derive(Clone, Debug)]
pub struct Receiver {
    source: Source,
    links: [Link; Message::COUNT],
    values: Values,
    /// The time-out of a steering command.
    timeout: Millis,
    radar: List<RadarObject, MAX_RADAR>,
    camera: List<CameraObject, MAX_CAMERA>,
    /// The last steering command of which both frames were there, when, and whether since the last sample.
    steering: Option<(Millis, Steering, bool)>,
    /// The strongest brake request since the last sample.
    brake: Option<ServiceBrake>,
    inputs: Inputs,
    scene: Scene,
    commands: Commands,
}

impl Receiver {
    /// The supervisor's: inputs, and the commands of the main controller.
    #[must_use]
    pub fn new(config: &Config) -> Self {
        Self::listening_to(Source::MainController, config)
    }

    /// One that takes commands from `source`; from the supervisor, it is an actuator's.
    ///
    /// E2E-1g: the time-out of a message is that of its control time. A command needs no time after a gap: its
    /// counter has a predecessor, and it is vetted anyway.
    #[must_use]
    pub fn listening_to(source: Source, config: &Config) -> Self {
        let link = |message: Message| {
            let timeout = match message.control_time() {
                ControlTime::Ms50 => config.timeout_50,
                ControlTime::Ms100 => config.timeout_100,
                ControlTime::Ms200 => config.timeout_200,
            };
            let requalify = if message.is_command() { Millis::ZERO } else { config.requalify };
            Link::new(message, Timing { timeout, requalify })
        };
        Self {
            source,
            links: array::from_fn(|number| link(Message::ALL.get(number).copied().unwrap_or(Message::Mode))),
            values: Values::NONE,
            timeout: config.timeout_50,
            radar: List::new(config.timeout_50),
            camera: List::new(config.timeout_50),
            steering: None,
            brake: None,
            inputs: Inputs::NEVER,
            scene: Scene::default(),
            commands: Commands::ABSENT,
        }
    }

    /// SELF-10b: takes one frame in; a second sender of an address is refused as such.
    ///
    /// # Errors
    /// What is wrong with it. The message then counts as failed until its next good frame (RULE-5a).
    pub fn accept(&mut self, now: Millis, frame: &Frame) -> Result<Accepted, Refusal> {
        let unknown = Refusal { message: None, fault: Fault::Identifier };
        let (message, source) = Message::identify(frame.id).ok_or(unknown)?;
        let refusal = |fault| Refusal { message: Some(message), fault };
        let own_status = message.destination() == Destination::Status && self.source == Source::MainController;
        if own_status || message.is_command() && source != self.source {
            return Err(refusal(Fault::Source));
        }
        let mut values = self.values;
        let link = self.links.get_mut(message.number()).ok_or(unknown)?;
        let lost = link.receive(now, frame, &mut values).map_err(refusal)?;
        self.values = values;
        if message == Message::ServiceBrake {
            self.values.outputs.brake = self.strongest(values.outputs.brake);
        }
        self.complete(now, message.destination());
        Ok(Accepted { message, lost })
    }

    /// Watches the bus of the actuators: every frame that is read there, of whatever sender, goes in here; feedback
    /// that comes by this bus goes to [`accept`](Self::accept) too. `sender` is the one of the outputs.
    ///
    /// What is found is in the next sample, once. The priority in the identifier does not count, as in J1939.
    /// - SELF-10a: a command to an actuator from another source address, or to all of them, is foreign on its channel.
    /// - SELF-10b: a frame of ours that is not an echo has a second sender; a command is foreign too. A controller that
    ///   receives its own frames hands each back once, to the bit, within two cycles.
    ///
    /// # Errors
    /// The message that somebody else sent.
    pub fn accept_actuator(&mut self, now: Millis, frame: &Frame, sender: &mut Sender) -> Result<(), Refusal> {
        let mut result = Ok(());
        for message in Message::ALL.iter().copied().filter(|message| message.commanded_by(frame.id)) {
            if sender.takes_back(now, message, frame) {
                continue;
            }
            let inputs = &mut self.values.inputs;
            inputs.second_sender |= frame.id & 0xFF == u32::from(Source::Supervisor.address());
            if let Destination::Command(channel) = message.destination() {
                inputs.foreign = inputs.foreign.with(channel);
            }
            result = Err(Refusal { message: Some(message), fault: Fault::Source });
        }
        result
    }

    /// VLC-1e: of several good requests in one cycle, the one for the greatest deceleration; of equal ones the last. It
    /// is held until the next good request after the cycle. The electric part has its own message.
    ///
    /// The link has one main controller: if two send under its address they break each other's counters, and of the
    /// frames that still pass their check the strongest counts.
    fn strongest(&mut self, request: ServiceBrake) -> ServiceBrake {
        let demand = |brake: &ServiceBrake| if brake.mode == BrakeMode::Off { DecelMs2Q11::ZERO } else { brake.total };
        let before = self.brake.filter(|before| demand(before) > demand(&request)).unwrap_or(request);
        self.brake = Some(before);
        ServiceBrake { electric: request.electric, ..before }
    }

    /// Completes what consists of several frames.
    fn complete(&mut self, now: Millis, destination: Destination) {
        match destination {
            Destination::Radar(part) => {
                if let Some(objects) = self.radar.add(now, part, &self.values.radar) {
                    self.scene.radar.clear();
                    objects.for_each(|object| self.scene.radar.push(object).unwrap_or(()));
                }
            }
            Destination::Camera(part) => {
                if let Some(objects) = self.camera.add(now, part, &self.values.camera) {
                    self.scene.camera.clear();
                    objects.for_each(|object| self.scene.camera.push(object).unwrap_or(()));
                }
            }
            Destination::Command(Channel::Steering) => {
                // Angle and torque belong together when they carry the same counter.
                let [angle, torque] = [Message::SteeringAngle, Message::SteeringTorque]
                    .map(|message| self.links.get(message.number()).and_then(Link::good_counter));
                if angle == torque {
                    self.steering = Some((now, self.values.outputs.steering, true));
                }
            }
            Destination::Input | Destination::Command(_) | Destination::Status => {}
        }
    }

    /// What the cycle at `now` reads. Once per cycle: what was fresh is held from then on.
    pub fn sample(&mut self, now: Millis) -> Sample<'_> {
        let mut values = self.values;
        let Scene { radar, camera, .. } = &mut self.scene;
        let radar_known = self.radar.known(now, radar.iter_mut().map(|object| &mut object.age));
        let camera_known = self.camera.known(now, camera.iter_mut().map(|object| &mut object.age));
        (self.scene.radar_known, self.scene.camera_known) = (radar_known, camera_known);
        for (message, link) in Message::ALL.iter().zip(&mut self.links) {
            if let Err(cause) = link.quality(now) {
                message.degrade(&mut values, cause);
                self.scene.radar_known &= !matches!(message.destination(), Destination::Radar(_));
                self.scene.camera_known &= !matches!(message.destination(), Destination::Camera(_));
            }
        }
        self.inputs = values.inputs;
        self.commands = self.commands(now);
        self.steering = self.steering.map(|(taken, value, _)| (taken, value, false));
        (self.values.inputs.foreign, self.values.inputs.second_sender) = (Channels::NONE, false);
        self.brake = None;
        for link in &mut self.links {
            link.fresh = false;
        }
        Sample { inputs: &self.inputs, scene: &self.scene, commands: &self.commands }
    }

    /// What the supervisor last said of itself, and its time stamp, for a receiver that listens to the supervisor.
    ///
    /// # Errors
    /// Why it does not count, as for an input.
    pub fn status(&mut self, now: Millis) -> Result<(Millis, Status), Cause> {
        for message in [Message::SupervisorStatus, Message::SupervisorFaults] {
            self.links.get_mut(message.number()).ok_or(Cause::NeverReceived)?.quality(now)?;
        }
        Ok((self.values.stamp, self.values.status))
    }

    fn commands(&mut self, now: Millis) -> Commands {
        let outputs = self.values.outputs;
        Commands {
            drive: self.command(now, Message::DriveTorque, outputs.drive),
            target_speed: self.command(now, Message::TargetSpeed, outputs.target_speed),
            brake: self.brake(now, outputs.brake),
            retarder: self.command(now, Message::Retarder, outputs.retarder),
            gear: self.command(now, Message::Gear, outputs.gear),
            epb: self.command(now, Message::ParkingBrake, outputs.epb),
            steering: self.steering(now),
            contactors: self.command(now, Message::Contactors, outputs.contactors),
            auxiliaries: self.command(now, Message::Auxiliaries, outputs.auxiliaries),
            warnings: self.command(now, Message::Warnings, outputs.warnings),
            body: self.command(now, Message::Body, outputs.body),
            mode: self.command(now, Message::Mode, outputs.mode),
        }
    }

    fn command<T>(&mut self, now: Millis, message: Message, value: T) -> Command<T> {
        self.links.get_mut(message.number()).map_or(Command::Absent, |link| link.command(now, value))
    }

    /// The electric part needs its own frame; without it the demand of XBR stands, all of it by friction.
    fn brake(&mut self, now: Millis, brake: ServiceBrake) -> Command<ServiceBrake> {
        let split = self.command(now, Message::BrakeSplit, brake.electric);
        let electric = split.usable(FOREVER).unwrap_or(ServiceBrake::NEUTRAL.electric);
        self.command(now, Message::ServiceBrake, ServiceBrake { electric, ..brake })
    }

    /// Both frames must be in order, and the last two that belong together not too old.
    fn steering(&mut self, now: Millis) -> Command<Steering> {
        self.steering = self.steering.filter(|(taken, ..)| elapsed(now, *taken) <= self.timeout);
        let frames = [Message::SteeringAngle, Message::SteeringTorque].map(|message| self.command(now, message, ()));
        match (frames, self.steering) {
            ([Command::Rejected(why), _] | [_, Command::Rejected(why)], _) => Command::Rejected(why),
            ([Command::Absent, _] | [_, Command::Absent], _) | (_, None) => Command::Absent,
            (_, Some((_, value, true))) => Command::Fresh(value),
            (_, Some((taken, value, false))) => Command::Held(elapsed(now, taken), value),
        }
    }
}
