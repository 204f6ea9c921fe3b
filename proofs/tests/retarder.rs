//! What fits of the retarder below the cap (RET-1a, SELF-11g), for every room and every valid deceleration.

use supervisor_core::LIMITS;
use supervisor_core::kernel::fits;

/// RET-1a, SELF-11g, PHB-1a: what fits stays inside the room, and one per cent more would not; all of it fits where it costs
/// nothing.
#[test]
fn ret_1_fits_by_its_contract() {
    let valid = LIMITS.iter().find(|limit| limit.name == "retarder_decel").map(|limit| limit.greatest);
    let greatest = valid.and_then(|most| u16::try_from(most).ok()).unwrap_or(0);
    assert!(greatest > 0, "the table of limits has its row");
    for each in 0..=greatest {
        let costs = |percents: u8| u32::from(each) * u32::from(percents);
        for room in 0..=u16::MAX {
            let percents = fits(room, each);
            assert!(percents <= 100 && costs(percents) <= u32::from(room), "{each} in {room}: {percents}");
            assert!(percents == 100 || costs(percents + 1) > u32::from(room), "{each} in {room}: {percents}");
        }
    }
    assert_eq!(fits(0, 0), 100);
}
