//! Why the automated mode ended, for driver and ADS (S4 ACR 8, MODE-1, RPT-1a, RPT-1b).

use supervisor_core::ExitReason;

/// What driver and ADS are told when the automated mode has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExitNotice {
    /// The stable code for the ADS: that of [`ExitReason`].
    pub code: u8,
    /// For the driver: one short sentence.
    pub driver: &'static str,
    /// For the ADS.
    pub ads: &'static str,
}

/// RPT-1a, RPT-1b: the notice of an exit; `None` while the mode has not ended.
#[must_use]
pub const fn exit_notice(reason: ExitReason) -> Option<ExitNotice> {
    let (driver, ads) = match reason {
        ExitReason::None => return None,
        ExitReason::Requested => ("You drive: automated driving has ended.", "Asked for by the main controller."),
        ExitReason::BrakePedal => ("You drive: you pressed the brake.", "Brake pedal pressed, or unknown."),
        ExitReason::Takeover => ("You drive: you took the wheel.", "The driver took over the steering."),
        ExitReason::Switch => ("You drive: the cruise switch is off.", "Cruise switch off, or unknown."),
        ExitReason::AdsState => ("Take over: automated driving failed.", "The state of the ADS is not valid."),
        ExitReason::CommandLost => ("Take over: no brake command comes.", "The brake request was lost."),
        ExitReason::InputLost => ("Take over: a sensor is silent.", "An input that the mode needs is unknown."),
        ExitReason::Leave => ("Take your seat: the bus brakes.", "The driver left the seat."),
        ExitReason::Fault => ("Take over: the supervisor has a fault.", "Clock fault, or safe state."),
        ExitReason::Bypass => {
            ("Take over: an actuator does not obey.", "An actuator was commanded past us, or disobeys.")
        }
        ExitReason::Mitigation => {
            ("The bus brakes for an obstacle.", "Mitigation has begun; new driver evidence after it.")
        }
    };
    Some(ExitNotice { code: reason.code(), driver, ads })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// RPT-1a, RPT-1b: every exit of the automated mode has a notice of its own, and no exit has none.
    #[test]
    fn every_exit_has_a_notice_of_its_own() {
        assert_eq!(exit_notice(ExitReason::None), None);
        for (index, reason) in ExitReason::ALL.iter().enumerate().skip(1) {
            let notice = exit_notice(*reason);
            assert_eq!(notice.map(|notice| notice.code), Some(reason.code()));
            assert!(notice.is_some_and(|notice| !notice.driver.is_empty() && !notice.ads.is_empty()), "{reason:?}");
            for other in ExitReason::ALL.iter().skip(index + 1).filter_map(|other| exit_notice(*other)) {
                let same = |notice: ExitNotice| notice.driver == other.driver || notice.ads == other.ads;
                assert!(!notice.is_some_and(same), "{reason:?}");
            }
        }
    }
}
