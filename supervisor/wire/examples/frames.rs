//! Prints frames as `candump -l` does: random inputs, objects, commands, outputs and status over two seconds, for
//! `check_dbc.py` and other tools.

use supervisor_core::{
    AngleDeciDeg, Commands, DecelMs2Q11, ExitReason, Faults, Inputs, Level, Mass10Kg, Millis, Mode, Occupancy, Outputs,
    Pedal250, Percent, Pressure5KPa, Record, Seat, Signal, SpeedKmhQ8, Stage, Status,
};
use supervisor_perceive::Scene;
use supervisor_wire::{Frame, Sender};

fn main() {
    let (mut sensors, mut controller, mut supervisor) = (Sender::new(), Sender::new(), Sender::new());
    for step in 0..200_u16 {
        let time = u32::from(step).saturating_mul(10);
        let raw = step.wrapping_mul(331);
        let small = raw.to_le_bytes()[0];
        let inputs = Inputs {
            seat: [Signal::Known(Seat::Occupied), Signal::NEVER],
            wheel_speed: Signal::Known(SpeedKmhQ8::new(raw)),
            motor_speed: Signal::Known(SpeedKmhQ8::new(raw)),
            brake_pedal: [Signal::Known(Pedal250::new(small)); 2],
            steering_angle: Signal::Known(AngleDeciDeg::new(raw.cast_signed())),
            electric_actual: Signal::Known(DecelMs2Q11::new(raw)),
            mass: Signal::Known(Mass10Kg::new(raw)),
            axle_pressure: [Signal::Known(Pressure5KPa::new(small)); 2],
            ..Inputs::NEVER
        };
        let mut outputs = Outputs::NEUTRAL;
        outputs.drive.torque = Percent::new(small);
        outputs.brake.total = DecelMs2Q11::new(raw);
        outputs.brake.electric = DecelMs2Q11::new(raw >> 1);
        outputs.steering.angle = AngleDeciDeg::new(raw.cast_signed());
        outputs.target_speed = SpeedKmhQ8::new(raw);
        let mut print = |frame: Frame| {
            let data = frame.data.map(|byte| format!("{byte:02X}")).concat();
            println!("({:.6}) can0 {:08X}#{data}", f64::from(time) / 1000.0, frame.id);
        };
        let commands: Commands = outputs.as_commands();
        sensors.encode_inputs(Millis::new(time), &inputs, &Scene::clear(), &mut print);
        controller.encode_commands(Millis::new(time), &commands, &mut print);
        supervisor.encode_outputs(Millis::new(time), &outputs, &mut print);
        let status = Status {
            occupancy: Occupancy::Leave,
            parked_by_leave: true,
            parked_for: Millis::new(time),
            stage: Stage::Down,
            level: Level::Two,
            mode: Mode::Manual,
            exit: ExitReason::Leave,
            safe_state: false,
            faults: Faults::EBS_RED,
            record: Record::HighVoltageDown,
        };
        supervisor.encode_status(Millis::new(time), &status, &mut print);
    }
}
