//! The numbers of the bus model, each with its source. "own": typical of an 18 t, 12 m electric city bus, and of
//! no consequence for the verdicts, which come from the sensed values alone.

/// Physical parameters of the bus, in SI units unless the name says otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Mass. S1 §3.2 tests a 12 m bus under high load; 18 t is the greatest mass of two axles (GB 1589).
    pub mass_kg: f64,
    /// Share of rotating masses (own).
    pub rotating: f64,
    /// Rolling resistance, force per weight (own).
    pub rolling: f64,
    /// Drag coefficient times frontal area times half the density of air (own: 0.65 · 8.0 m² · 0.6 kg/m³).
    pub drag: f64,
    /// Slope, rise per length; positive uphill.
    pub slope: f64,
    /// Friction between tyre and road, deceleration per gravity; infinite: no wheel ever slips (the shipped drives).
    pub grip: f64,
    /// Wheel force at 100 % torque (own: 1.2 m/s² at 18 t; S4 table 2 asks for 0.1 m/s² at least).
    pub full_force_n: f64,
    /// Greatest power at the wheels (own).
    pub full_power_w: f64,
    /// The drive says what its power leaves of its torque; else it always says 100 % (the shipped drives).
    pub power_told: bool,
    /// Time constant of the drive: 95 % after 300 ms (S4 table 2: ≤ 500 ms).
    pub drive_lag_s: f64,
    /// Dead time of the service brake (own; S1's figures are compared for 0 to 0.7 s).
    pub brake_dead_s: f64,
    /// Time constant of its build-up: 95 % after 450 ms (S4 table 3: ≤ 500 ms in an emergency).
    pub brake_lag_s: f64,
    /// Greatest deceleration by friction (own; S4 table 3 asks for 6 m/s²).
    pub friction_decel: f64,
    /// Greatest electric deceleration (own).
    pub electric_decel: f64,
    /// Time constant of the electric brake (own: the inverter's).
    pub electric_lag_s: f64,
    /// Deceleration of the retarder at 100 % (the supervisor's `retarder_decel`).
    pub retarder_decel: f64,
    /// Time constant of the retarder (own).
    pub retarder_lag_s: f64,
    /// Deceleration that the parking brake holds against (an 18 % slope: UN R13, annex 4).
    pub parking_decel: f64,
    /// The parking brake applies or releases in this time (own).
    pub parking_ms: u32,
    /// The gearbox confirms a gear in this time (S4 6.1.6: < 800 ms).
    pub gearbox_ms: u32,
    /// A contactor closes, and its feedback follows, in this time (own).
    pub contactor_close_ms: u32,
    /// A contactor opens, and its feedback follows, in this time (own).
    pub contactor_open_ms: u32,
    /// The drive reports "stopped" this long after K4 opened: its link has discharged (own).
    pub drive_stop_ms: u32,
    /// The auxiliary supplies report "stopped" this long after K4 opened (own).
    pub auxiliaries_stop_ms: u32,
    /// Power of the auxiliaries while K4 is closed (own).
    pub auxiliaries_w: f64,
    /// Battery voltage (own).
    pub battery_v: f64,
    /// Radar period (own: 50 ms is usual), in ms.
    pub radar_ms: u32,
    /// Radar range (own).
    pub radar_range_m: f64,
    /// Camera period (own: 25 frames per second, never in step with the radar), in ms.
    pub camera_ms: u32,
    /// Within this distance the camera sees an object (own).
    pub camera_range_m: f64,
}

impl Parameters {
    /// The bus of the shipped drives: level road, dead time 0.15 s.
    pub const DEFAULT: Self = Self {
        mass_kg: 18_000.0,
        rotating: 1.06,
        rolling: 0.008,
        drag: 3.12,
        slope: 0.0,
        grip: f64::INFINITY,
        full_force_n: 22_900.0,
        full_power_w: 180_000.0,
        power_told: false,
        drive_lag_s: 0.1,
        brake_dead_s: 0.15,
        brake_lag_s: 0.15,
        friction_decel: 7.0,
        electric_decel: 1.3,
        electric_lag_s: 0.06,
        retarder_decel: 1.5,
        retarder_lag_s: 0.2,
        parking_decel: 1.74,
        parking_ms: 1000,
        gearbox_ms: 400,
        contactor_close_ms: 100,
        contactor_open_ms: 60,
        drive_stop_ms: 1500,
        auxiliaries_stop_ms: 3000,
        auxiliaries_w: 12_000.0,
        battery_v: 600.0,
        radar_ms: 50,
        radar_range_m: 150.0,
        camera_ms: 40,
        camera_range_m: 80.0,
    };

    /// The same bus with another dead time of the service brake.
    #[must_use]
    pub const fn with_brake_dead(mut self, seconds: f64) -> Self {
        self.brake_dead_s = seconds;
        self
    }
}
