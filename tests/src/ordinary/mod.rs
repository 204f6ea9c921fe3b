//! A day of a city bus: ordinary driving, in which nobody should be disturbed.
//!
//! Written from how people drive, not from the supervisor's law: the driver sees gap and speed of what is ahead a reaction
//! time ago, chooses a deceleration of 0.5 to 1.5 m/s² and a gap of 1 to 4 m to come to rest with, and follows as everybody
//! does. The main controller warns and leaves the braking to the driver ([`Controller::without_mitigation`]): whatever
//! brakes beside the driver is then the supervisor.
//!
//! [`human`]: the driver; [`mod@route`]: what the day brings; [`day`]: a piece of it in the loop, and what came of it.
//!
//! [`Controller::without_mitigation`]: crate::controller::Controller::without_mitigation

pub mod day;
pub mod human;
pub mod route;
