//! The table of leave (SEAT-3): any table, any speed.
//!
//! The line between two points is one kernel: the test `seat_3_line_of_every_way` goes through all that it gives, for both
//! distances that points lie apart; that `decide` asks for the right line is proved for any arithmetic there.

use supervisor_core::{
    Config, DecelMs2Q11, EpbState, Inputs, Millis, Response, Seat, SeatState, Signal, SpeedKmhQ8, State, Threat, decide,
};

use crate::properties::leave::line_of_table;

/// What the shipped `decide` demands in leave at this speed, the parking brake applied: the table alone.
fn demand(speed: u16, config: &Config) -> DecelMs2Q11 {
    demand_with(speed, Signal::Known(EpbState::Applied), config)
}

/// The same with the parking brake as it is.
fn demand_with(speed: u16, epb: Signal<EpbState>, config: &Config) -> DecelMs2Q11 {
    let speed = Signal::Known(SpeedKmhQ8::new(speed));
    let inputs = Inputs { wheel_speed: speed, motor_speed: speed, epb, ..Inputs::NEVER };
    let state = State { seat: SeatState { leave: true, ..SeatState::INITIAL }, ..State::INITIAL };
    decide(&state, Millis::ZERO, &inputs, &Threat::CLEAR, &Response::FOLLOWS, config).state.brake.leave
}

/// SEAT-3a, SEAT-3b: at every speed and for every table the line between the two points that it lies between, for any
/// arithmetic there; beyond the last point its value.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::between_up, crate::harness::uninterpreted::between_up)]
fn seat_3_table_exactly() {
    let config = Config { leave_decel: kani::any(), ..Config::DEFAULT };
    let speed: u16 = kani::any();
    let demand = demand(speed, &config);
    assert!(demand == line_of_table(speed, &config));
    kani::cover!(speed > 2560 && speed < 3840 && demand.raw() > 0, "between two points");
    kani::cover!(speed > 15_360, "beyond the table");
}

/// SEAT-3d: slower than the hold speed the bus is held as long as the parking brake is not known applied; that is all it adds.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::between_up, crate::harness::uninterpreted::between_up)]
fn seat_3_holds_at_rest() {
    let config =
        Config { leave_decel: kani::any(), leave_hold: kani::any(), leave_hold_speed: kani::any(), ..Config::DEFAULT };
    let (speed, epb): (u16, Signal<EpbState>) = (kani::any(), kani::any());
    let (table, demand) = (demand(speed, &config), demand_with(speed, epb, &config));
    let holds = speed < config.leave_hold_speed.raw() && !epb.is(EpbState::Applied);
    assert!(demand == if holds { table.max(config.leave_hold) } else { table });
    kani::cover!(demand > table, "it holds");
}

/// SEAT-3b: a table that rises gives a demand that does not fall, from each 1/256 km/h to the next, and so over all speeds.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::between_up, crate::harness::uninterpreted::rising)]
fn seat_3_demand_does_not_fall() {
    let config = Config { leave_decel: kani::any(), ..Config::DEFAULT };
    let slower: u16 = kani::any();
    let faster = slower.saturating_add(1);
    let rises = config.leave_decel.0.is_sorted();
    let (low, high) = (demand(slower, &config), demand(faster, &config));
    assert!(!rises || low <= high);
    kani::cover!(rises && low < high, "it rises");
}

/// SELF-5d, SEAT-3a: in the safe state with a vacant seat the bus brakes at least as the table says.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::between_up, crate::harness::uninterpreted::between_up)]
fn self_5d_vacant_seat_in_the_safe_state() {
    let config = Config { leave_decel: kani::any(), ..Config::DEFAULT };
    let speed: u16 = kani::any();
    let known = Signal::Known(SpeedKmhQ8::new(speed));
    let inputs =
        Inputs { wheel_speed: known, motor_speed: known, seat: [Signal::Known(Seat::Vacant); 2], ..Inputs::NEVER };
    let state = State::corrupted();
    let decided = decide(&state, Millis::ZERO, &inputs, &Threat::CLEAR, &Response::FOLLOWS, &config);
    assert!(decided.envelope.brake.floor.most >= line_of_table(speed, &config));
    assert!(decided.state.is_safe_state() && !decided.state.seat.leave);
    kani::cover!(decided.envelope.brake.floor.most.raw() > 4506, "it brakes by the table");
}
