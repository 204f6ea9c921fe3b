//! The table of leave at every speed there is (SEAT-3a, SEAT-3b, SEAT-3c), on the shipped `decide`.

use supervisor_core::kernel::between_up;
use supervisor_core::{
    Commands, Config, DecelMs2Q11, EpbState, Inputs, Millis, Row, SeatState, Signal, SpeedKmhQ8, State, Threat,
};
use supervisor_proofs::properties::Witness;
use supervisor_proofs::properties::leave::{COARSE, FINE, is_line, is_table};

/// The demand of leave at this speed, the parking brake applied.
fn demand(speed: u16, config: &Config) -> DecelMs2Q11 {
    let speed = Signal::Known(SpeedKmhQ8::new(speed));
    let inputs =
        Inputs { wheel_speed: speed, motor_speed: speed, epb: Signal::Known(EpbState::Applied), ..Inputs::NEVER };
    let state = State { seat: SeatState { leave: true, ..SeatState::INITIAL }, ..State::INITIAL };
    let witness = Witness::of(state, Millis::ZERO, &inputs, &Threat::CLEAR, &Commands::ABSENT, config);
    assert_eq!(witness.broken(), None);
    assert!(witness.outputs.brake.total >= witness.next.brake.leave);
    witness.next.brake.leave
}

fn exact_at_every_speed(config: &Config) {
    let mut before = DecelMs2Q11::ZERO;
    for speed in 0..=u16::MAX {
        let demand = demand(speed, config);
        assert!(is_table(demand, speed, config), "{speed}: {demand:?}");
        assert!(demand >= before, "{speed}: {demand:?} falls");
        before = demand;
    }
}

/// SEAT-3a, SEAT-3b, SEAT-3c: every speed under the default table: S3's value at each of its 16 points, the line between
/// them, 2.20 m/s² beyond 60 km/h; and nowhere does it fall.
#[test]
fn default_table_at_every_speed() {
    exact_at_every_speed(&Config::DEFAULT);
    let points = [0, 2, 4, 6, 8, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60].map(|speed| speed * 256);
    let demands = points.map(|speed| demand(speed, &Config::DEFAULT));
    assert_eq!(demands, Config::DEFAULT.leave_decel.0);
    assert_eq!(demand(15_361, &Config::DEFAULT), DecelMs2Q11::new(4506));
    assert_eq!(demand(u16::MAX, &Config::DEFAULT), DecelMs2Q11::new(4506));
}

/// SEAT-3b: a table of extremes: steps of the whole range, steps of one, and none.
#[test]
fn table_of_extremes_at_every_speed() {
    let values = [0, 0, 1, 2, 2, 6000, 6001, 6001, 6001, 12_287, 12_288, 12_288, 12_288, 12_288, 12_288, 12_288];
    let leave_decel = Row(values.map(DecelMs2Q11::new));
    exact_at_every_speed(&Config { leave_decel, ..Config::DEFAULT });
}

/// SEAT-3b, SEAT-3c: the line between two points, for both distances that points lie apart, every difference of their values
/// and every place between them: rounded to the stronger side, and nowhere does it fall. The lower value only adds.
#[test]
fn seat_3_line_of_every_way() {
    for step in [FINE, COARSE] {
        for way in 0..=u16::MAX {
            let mut before = 0;
            for rest in 0..=step {
                let (least, most) = (between_up(0, way, rest, step), between_up(u16::MAX - way, u16::MAX, rest, step));
                assert!(is_line(least, 0, way, rest, step), "{rest} of {step} of {way}: {least}");
                assert_eq!(most, u16::MAX - way + least, "{rest} of {step} of {way}");
                assert!(before <= least, "{rest} of {step} of {way}: {least} falls");
                before = least;
            }
            assert_eq!(before, way, "{way}: the second point");
        }
    }
}
