//! The one table of messages (E2E-1a, CMD-1a, CMD-1d).
//!
//! A row: number, name in the DBC, id, period in ms, control time, destination, protection; then its signals: coding,
//! first bit, number of bits, and the value it carries.

use supervisor_core::{Cause, Channel, Millis};
use supervisor_perceive::{MAX_CAMERA, MAX_RADAR};

use crate::coding::{
    Age, BrakingTorque, Coding, Deceleration, Measured, MeasuredSigned, Pixels, Plain, Purpose, Spn, SpnSwitch, Torque,
    TorqueControl,
};
use crate::frame::{full, insert};
use crate::list::Entry;
use crate::message::Destination::{Camera, Command, Input, Radar, Status};
use crate::message::{ControlTime, Destination, SignalLayout, Source, Values, get, messages, put};
use crate::protection::Protection;
use crate::refusal::Fault;

messages! {
    (inputs, outputs, radar, camera, status, stamp)

    // Bare J1939 inputs, source addresses as on the recorded bus.
    /// Cruise control / vehicle speed.
    0 Ccvs1("CCVS1", 0x18FE_F100, 100, Ms100, Input, Bare) { WheelBasedVehicleSpeed: Spn(8, 16) = inputs.wheel_speed; }
    /// Electronic brake controller 1. Its pedal and switch are bare: they are not read (E2E-1f).
    1 Ebc1("EBC1", 0x18F0_010B, 100, Ms100, Input, Bare) {
        ASRBrakeControlActive: SpnSwitch(2, 2) = inputs.asr; ABSActive: SpnSwitch(4, 2) = inputs.abs;
        EBSRedWarning: SpnSwitch(42, 2) = inputs.ebs_red; ABSEBSAmberWarning: SpnSwitch(44, 2) = inputs.ebs_amber; }

    // Protected inputs.
    /// Both tracks of the accelerator, of one moment (E2E-1f, CMD-7d). In two messages a pedal on its way would disagree
    /// with itself. EEC2 says the same without protection: it is not read.
    2 Accelerator("Accelerator", 0x0CFF_3300, 50, Ms50, Input, Profile11) {
        AccelPedalPosition1: Measured(16, 8) = inputs.accelerator[0];
        AccelPedalPosition2: Measured(24, 8) = inputs.accelerator[1]; }
    /// Gearbox: what the driver selects, what is engaged (E2E-1f, CMD-7d). ETC2 says the same without protection: it is
    /// not read.
    3 GearStatus("GearStatus", 0x18FF_3203, 100, Ms100, Input, Profile11) {
        SelectedGear: Measured(12, 3) = inputs.selector; CurrentGear: Measured(16, 3) = inputs.gear; }
    /// First seat sensor.
    4 Seat1("Seat1", 0x0CFF_1021, 50, Ms50, Input, Profile11) { SeatSensor1: Measured(16, 2) = inputs.seat[0]; }
    /// Second seat sensor, by another ECU.
    5 Seat2("Seat2", 0x0CFF_1131, 50, Ms50, Input, Profile11) { SeatSensor2: Measured(16, 2) = inputs.seat[1]; }
    /// Second track of the brake pedal.
    6 BrakePedal2("BrakePedal2", 0x0CFF_1231, 50, Ms50, Input, Profile11) {
        BrakePedalPosition2: Measured(16, 8) = inputs.brake_pedal[1]; }
    /// Drive: second speed, executed torque, limits.
    7 DriveStatus("DriveStatus", 0x0CFF_1300, 50, Ms50, Input, Profile11) {
        DriveStopped: Measured(12, 2) = inputs.drive_stopped; MotorSpeed: Measured(16, 16) = inputs.motor_speed;
        ExecutedTorque: Measured(32, 8) = inputs.executed_torque; DriveLimit: Measured(40, 8) = inputs.drive_limit;
        ElectricLimit: Measured(48, 16) = inputs.electric_limit; }
    /// Brake system.
    8 BrakeStatus("BrakeStatus", 0x0CFF_140B, 50, Ms50, Input, Profile11) {
        XBRStatus: Measured(12, 2) = inputs.xbr_status; StabilityActive: Measured(14, 2) = inputs.stability;
        FrictionLimit: Measured(16, 16) = inputs.friction_limit;
        MeasuredDeceleration: Measured(32, 16) = inputs.deceleration;
        PressureFront: Measured(48, 8) = inputs.axle_pressure[0];
        PressureRear: Measured(56, 8) = inputs.axle_pressure[1]; }
    /// Power steering.
    9 SteeringStatus("SteeringStatus", 0x0CFF_1513, 50, Ms50, Input, Profile11) {
        HandsOff: Measured(12, 2) = inputs.hands_off;
        SteeringWheelAngle: MeasuredSigned(16, 16) = inputs.steering_angle;
        DriverTorque: MeasuredSigned(32, 16) = inputs.driver_torque; EPSState: Measured(48, 3) = inputs.eps; }
    /// Parking brake and the driver's switch of it.
    10 ParkingBrakeStatus("ParkingBrakeStatus", 0x18FF_1650, 100, Ms100, Input, Profile11) {
        EPBState: Measured(12, 2) = inputs.epb; EPBSwitch: Measured(14, 2) = inputs.epb_switch;
        EPBMode: Measured(16, 2) = inputs.epb_mode; }
    /// Key and cruise control switches.
    11 DriverControls("DriverControls", 0x18FF_1721, 100, Ms100, Input, Profile11) {
        Key: Measured(12, 2) = inputs.key; CruiseSwitch: Measured(14, 2) = inputs.cruise_switch;
        DriverSet: Measured(16, 2) = inputs.driver_set; }
    /// High voltage: contactors, current, loads.
    12 HighVoltageStatus("HighVoltageStatus", 0x18FF_18F3, 100, Ms100, Input, Profile11) {
        K1: Measured(12, 2) = inputs.k1; K4: Measured(14, 2) = inputs.k4;
        HVCurrent: MeasuredSigned(16, 16) = inputs.hv_current;
        AuxiliariesStopped: Measured(32, 2) = inputs.auxiliaries_stopped; }
    /// Automated driving system.
    13 AdsStatus("AdsStatus", 0x18FF_19A0, 100, Ms100, Input, Profile11) { ADSState: Measured(12, 3) = inputs.ads; }

    // Object lists: a list without objects is sent as index 0 of length 0.
    /// Radar object: where it is.
    14 RadarPosition("RadarPosition", 0x0CFF_1AA1, 50, Ms50, Radar(0), Profile11) {
        Cycle: Plain(12, 2) = radar.cycle; Index: Plain(16, 5) = radar.index; Length: Measured(21, 6) = radar.length;
        RadarDistance: Plain(32, 16) = radar.object.distance; RadarOffset: Plain(48, 16) = radar.object.offset; }
    /// Radar object: how it moves.
    15 RadarMotion("RadarMotion", 0x0CFF_1BA1, 50, Ms50, Radar(1), Profile11) {
        Cycle: Plain(12, 2) = radar.cycle; Index: Plain(16, 5) = radar.index; Length: Measured(21, 6) = radar.length;
        RadarAge: Age(27, 9) = radar.object.age; RadarUpdates: Plain(40, 8) = radar.object.updates;
        RadarClosing: Plain(48, 16) = radar.object.closing; }
    /// Camera object: what it is and how far.
    16 CameraObject("CameraObject", 0x0CFF_30E8, 50, Ms50, Camera(0), Profile11) {
        Cycle: Plain(12, 2) = camera.cycle; CameraClass: Plain(14, 2) = camera.object.class;
        Index: Plain(16, 4) = camera.index; Length: Measured(20, 5) = camera.length;
        CameraDistance: Plain(32, 16) = camera.object.distance; CameraClosing: Plain(48, 16) = camera.object.closing; }
    /// Camera object: corner of its box.
    17 CameraCorner("CameraCorner", 0x0CFF_1DE8, 50, Ms50, Camera(1), Profile11) {
        Cycle: Plain(12, 2) = camera.cycle; Index: Plain(14, 4) = camera.index;
        Length: Measured(18, 5) = camera.length; CameraAge: Age(23, 9) = camera.object.age;
        CameraLeft: Pixels(32, 16) = camera.object.pixels.left; CameraTop: Pixels(48, 16) = camera.object.pixels.top; }
    /// Camera object: size of its box.
    18 CameraSize("CameraSize", 0x0CFF_1EE8, 50, Ms50, Camera(2), Profile11) {
        Cycle: Plain(12, 2) = camera.cycle; Index: Plain(16, 4) = camera.index;
        Length: Measured(20, 5) = camera.length; CameraWidth: Pixels(32, 16) = camera.object.pixels.width;
        CameraHeight: Pixels(48, 16) = camera.object.pixels.height; }

    // Commands of the main controller, outputs of the supervisor.
    /// Drive torque: TSC1 to the drive.
    19 DriveTorque("TSC1_Drive", 0x0C00_002A, 10, Ms50, Command(Channel::DriveTorque), Tsc1) {
        OverrideControlMode: TorqueControl(0, 2) = outputs.drive.active;
        RequestedTorque: Torque(24, 8) = outputs.drive.torque; ControlPurpose: Purpose(35, 5) = outputs.drive.origin; }
    /// Target speed.
    20 TargetSpeed("TargetSpeed", 0x0CFF_202A, 50, Ms50, Command(Channel::TargetSpeed), Profile11) {
        TargetSpeed: Plain(16, 16) = outputs.target_speed; }
    /// Service brake: XBR, the total deceleration.
    21 ServiceBrake("XBR", 0x0C04_0B2A, 20, Ms50, Command(Channel::ServiceBrake), Xbr) {
        ExternalAccelerationDemand: Deceleration(0, 16) = outputs.brake.total;
        XBRPriority: Plain(18, 2) = outputs.brake.priority; XBRControlMode: Plain(20, 2) = outputs.brake.mode; }
    /// Service brake: the electric part, which XBR has no place for.
    22 BrakeSplit("BrakeSplit", 0x0CFF_212A, 20, Ms50, Command(Channel::ServiceBrake), Profile11) {
        ElectricDeceleration: Plain(16, 16) = outputs.brake.electric; }
    /// Retarder: TSC1 to the driveline retarder.
    23 Retarder("TSC1_Retarder", 0x0C00_102A, 50, Ms100, Command(Channel::Retarder), Tsc1) {
        RetarderControlMode: Plain(0, 2) = outputs.retarder.mode;
        RetarderPriority: Plain(4, 2) = outputs.retarder.priority;
        RetarderTorque: BrakingTorque(24, 8) = outputs.retarder.torque; }
    /// Gear.
    24 Gear("Gear", 0x0CFF_222A, 100, Ms100, Command(Channel::Gear), Profile11) {
        GearRequest: Plain(16, 3) = outputs.gear; }
    /// Parking brake.
    25 ParkingBrake("ParkingBrake", 0x0CFF_232A, 100, Ms200, Command(Channel::ParkingBrake), Profile11) {
        EPBRequest: Plain(16, 2) = outputs.epb.request; EPBRequestMode: Plain(18, 1) = outputs.epb.mode; }
    /// Steering: the angle.
    26 SteeringAngle("SteeringAngle", 0x0CFF_242A, 50, Ms50, Command(Channel::Steering), Profile11) {
        SteeringEnable: Plain(12, 1) = outputs.steering.enable; TargetAngle: Plain(16, 16) = outputs.steering.angle;
        TargetRate: Plain(32, 16) = outputs.steering.rate; }
    /// Steering: the torque. Belongs to the angle with the same counter.
    27 SteeringTorque("SteeringTorque", 0x0CFF_252A, 50, Ms50, Command(Channel::Steering), Profile11) {
        OverlayTorque: Plain(16, 16) = outputs.steering.overlay; AngleWeight: Plain(32, 8) = outputs.steering.weight;
        BarTorqueLimit: Plain(40, 8) = outputs.steering.bar_limit; }
    /// Contactors.
    28 Contactors("Contactors", 0x0CFF_2B2A, 100, Ms100, Command(Channel::Contactors), Profile11) {
        K4Request: Plain(16, 2) = outputs.contactors.k4; K1Request: Plain(18, 2) = outputs.contactors.k1; }
    /// Auxiliaries.
    29 Auxiliaries("Auxiliaries", 0x18FF_272A, 200, Ms200, Command(Channel::Auxiliaries), Profile11) {
        AirPump: Plain(16, 1) = outputs.auxiliaries.air_pump;
        PowerSteering: Plain(17, 1) = outputs.auxiliaries.power_steering;
        DCDC: Plain(18, 1) = outputs.auxiliaries.dc_dc; }
    /// Warnings.
    30 Warnings("Warnings", 0x18FF_282A, 100, Ms200, Command(Channel::Warnings), Profile11) {
        ForwardCollision: Plain(16, 1) = outputs.warnings.forward_collision;
        PedestrianCollision: Plain(17, 1) = outputs.warnings.pedestrian;
        SeatLeave: Plain(18, 1) = outputs.warnings.seat_leave;
        HazardFlashers: Plain(19, 1) = outputs.warnings.hazard_flashers;
        FaultLamp: Plain(20, 1) = outputs.warnings.fault_lamp;
        NoticeLamp: Plain(21, 1) = outputs.warnings.notice_lamp;
        LaneDeparture: Plain(22, 1) = outputs.warnings.lane_departure;
        SpeedLimit: Plain(23, 1) = outputs.warnings.speed_limit; Headway: Plain(24, 1) = outputs.warnings.headway; }
    /// Body.
    31 Body("Body", 0x18FF_292A, 100, Ms200, Command(Channel::Body), Profile11) {
        Wipers: Plain(16, 2) = outputs.body.wipers; BrakeLamps: Plain(18, 1) = outputs.body.brake_lamps;
        IndicatorLeft: Plain(19, 1) = outputs.body.indicator_left;
        IndicatorRight: Plain(20, 1) = outputs.body.indicator_right; LowBeam: Plain(21, 1) = outputs.body.low_beam;
        HighBeam: Plain(22, 1) = outputs.body.high_beam; Horn: Plain(23, 1) = outputs.body.horn; }
    /// Driving mode.
    32 Mode("Mode", 0x18FF_2A2A, 200, Ms200, Command(Channel::Mode), Profile11) {
        DrivingMode: Plain(16, 1) = outputs.mode; }

    // What else the brake system splits by (VLC-3).
    /// Electric brake: what it gives now. The drive's status has no room for it.
    33 ElectricBrake("ElectricBrake", 0x0CFF_1F00, 50, Ms50, Input, Profile11) {
        ElectricActual: Measured(16, 16) = inputs.electric_actual; }
    /// Mass of the vehicle.
    34 VehicleMass("VehicleMass", 0x18FF_310B, 100, Ms100, Input, Profile11) { Mass: Measured(16, 16) = inputs.mass; }

    // What the supervisor says of itself (SELF-8a, RPT-1b), in every period, whether anything has changed or not.
    /// Where the supervisor stands: driving mode and exit reason (S4 ACR 1, ACR 8), and its clock.
    35 SupervisorStatus("SupervisorStatus", 0x18FF_2C80, 50, Ms50, Status, Profile11) {
        SafeState: Plain(12, 1) = status.safe_state; ParkedByLeave: Plain(13, 1) = status.parked_by_leave;
        SeatOccupancy: Plain(14, 2) = status.occupancy; ModeGranted: Plain(16, 2) = status.mode;
        MitigationLevel: Plain(18, 2) = status.level; ShutdownStage: Plain(20, 2) = status.stage;
        PersistentRecord: Plain(22, 2) = status.record; ExitReason: Plain(24, 8) = status.exit;
        TimeStamp: Plain(32, 32) = *stamp; }
    /// Faults and hints, one bit each; and how long it has been parked by leave.
    36 SupervisorFaults("SupervisorFaults", 0x18FF_2D80, 100, Ms100, Status, Profile11) {
        Faults: Plain(12, 32) = status.faults; ParkedFor: Age(44, 20) = status.parked_for; }
    /// First track of the brake pedal and its switch (E2E-1f, CMD-7d).
    37 BrakePedal1("BrakePedal1", 0x0CFF_340B, 50, Ms50, Input, Profile11) {
        EBSBrakeSwitch: Measured(12, 2) = inputs.brake_switch;
        BrakePedalPosition1: Measured(16, 8) = inputs.brake_pedal[0]; }
}

impl Message {
    /// How many there are.
    pub const COUNT: usize = Self::ALL.len();

    /// Whether it is a command.
    #[must_use]
    pub const fn is_command(self) -> bool {
        matches!(self.destination(), Command(_))
    }
    /// E2E-1a, E2E-1f, CMD-7d: whether it may give evidence of safety. It is protected; or it is bare, and the core takes
    /// it for evidence only while a protected message agrees: the speed of CCVS1 with `DriveStatus`; slip control and
    /// warnings of EBC1 permit nothing alone. Checked for every row when this is compiled.
    pub(crate) const fn gives_evidence(self) -> bool {
        !matches!(self.protection(), Protection::Bare) || matches!(self, Self::Ccvs1 | Self::Ebc1)
    }
    /// The identifier from this source, if it is a command; an input has one sender only.
    #[must_use]
    pub fn id_from(self, source: Source) -> u32 {
        if self.is_command() { self.id() & !0xFF | u32::from(source.address()) } else { self.id() }
    }
    /// SELF-10: whether an actuator may take a frame with this identifier for this command, whoever sends it; or it is
    /// the supervisor's status in its own name.
    ///
    /// J1939: parameter group and destination say what it is, not the priority; destination 0xFF is everybody.
    pub(crate) const fn commanded_by(self, id: u32) -> bool {
        let to_all = id & 0x00FF_0000 < 0x00F0_0000 && id & 0xFF00 == 0xFF00;
        let counts = match self.destination() {
            Command(_) if to_all => 0x03FF_0000,
            Command(_) => 0x03FF_FF00,
            Status => 0x03FF_FFFF,
            Input | Radar(_) | Camera(_) => return false,
        };
        (self.id() ^ id) & counts == 0
    }
    /// CMD-1a: the message with this identifier, and from whom a command comes.
    pub(crate) fn identify(id: u32) -> Option<(Self, Source)> {
        let from = |source| Some((*Self::ALL.iter().find(|message| message.id_from(source) == id)?, source));
        from(Source::MainController).or_else(|| from(Source::Supervisor))
    }

    /// The payload without signals: reserved bits are 1 in J1939 and 0 in ours.
    const fn reserved(self) -> u64 {
        match self.protection() {
            Protection::Profile11 => 0,
            Protection::Tsc1 | Protection::Bare => u64::MAX,
            // SPN 2914, EBI mode: 0, no endurance brake on the brake system's own account. The split is ours.
            Protection::Xbr => !(full(2) << 16),
        }
    }
    /// CMD-1d: the payload, still without counter and check field.
    pub(crate) fn write(self, values: &Values) -> u64 {
        let mut payload = self.reserved();
        self.write_signals(&mut payload, values);
        payload
    }
    /// CMD-1b, c: takes the signals over, or refuses them all.
    ///
    /// E2E-1e: a bare message has no wrong content, only unknown signals; its other bits are signals of others.
    pub(crate) fn read(self, payload: u64, values: &mut Values) -> Result<(), Fault> {
        let cover = |bits, start, width| insert(bits, start, width, u64::MAX);
        if let Some((counter, check)) = self.protection().places() {
            let own = cover(cover(0, counter.0, counter.1), check.0, check.1);
            let own = self.signals().iter().fold(own, |own, signal| cover(own, signal.start, signal.width));
            if (payload ^ self.reserved()) & !own != 0 {
                return Err(Fault::Reserved);
            }
        }
        (values.radar, values.camera) = (Entry::NONE, Entry::NONE);
        let unread = self.read_signals(payload, self.protection() != Protection::Bare, values);
        let misfit = match self.destination() {
            Radar(_) => !values.radar.fits(MAX_RADAR),
            Camera(_) => !values.camera.fits(MAX_CAMERA),
            Input | Command(_) | Status => false,
        };
        unread.or(misfit.then_some("Index")).map_or(Ok(()), |signal| Err(Fault::Signal(signal)))
    }
}
