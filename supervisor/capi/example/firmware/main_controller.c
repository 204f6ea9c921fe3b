#include "main_controller.h"
#include "board.h"
#include "link.h"

/* In the style of generated code: external inputs and outputs, one step. */
typedef struct {
    uint32_t Time_ms;
    uint8_t AccelPedal; /* 0.4 % */
} ExtU_MainController_T;

typedef struct {
    uint8_t DriveTorque; /* % */
    uint8_t GearRequest;
    uint8_t EPBRequest;
    uint8_t K4Request;
} ExtY_MainController_T;

CONTROLLER_PARTITION static ExtU_MainController_T MainController_U;
CONTROLLER_PARTITION static ExtY_MainController_T MainController_Y;
CONTROLLER_PARTITION static uint8_t counter;      /* of Profile 11: 0 to 14 */
CONTROLLER_PARTITION static uint8_t counter_tsc1; /* 0 to 7 */
MAILBOX_PARTITION struct mailbox mailbox;

/* Where it must not write: the address of the supervisor's partition is no secret. */
extern uint32_t supervisor_partition[];

static void MainController_step(void)
{
    const uint32_t now = MainController_U.Time_ms;
    /* The pedal, halved: inside every pedal map. */
    MainController_Y.DriveTorque = (uint8_t)(MainController_U.AccelPedal / 5u);
    MainController_Y.GearRequest = SUPERVISOR_GEAR_REQUEST_HOLD;
    MainController_Y.EPBRequest = SUPERVISOR_EPB_REQUEST_NONE;
    MainController_Y.K4Request = SUPERVISOR_CONTACTOR_REQUEST_HOLD;
    if (now >= SHIFTS_TO_REVERSE && now < APPLIES_PARKING_BRAKE) {
        MainController_Y.GearRequest = SUPERVISOR_GEAR_REQUEST_REVERSE;
    } else if (now >= APPLIES_PARKING_BRAKE && now < OPENS_K4) {
        MainController_Y.EPBRequest = SUPERVISOR_EPB_REQUEST_APPLY;
    } else if (now >= OPENS_K4 && now < WRITES_INTO_SUPERVISOR) {
        MainController_Y.K4Request = SUPERVISOR_CONTACTOR_REQUEST_OPEN;
    } else if (now >= WRITES_INTO_SUPERVISOR) {
        *(volatile uint32_t *)supervisor_partition = 0;
    }
}

/* A frame of the table in ebus.dbc, reserved bits 0. */
static SupervisorFrame *frame(uint32_t number, uint32_t id)
{
    SupervisorFrame *made = &mailbox.frames[number];
    size_t at;
    made->id = id;
    for (at = 0; at < 8; at += 1) {
        made->data[at] = 0;
    }
    return made;
}

static void send(void)
{
    SupervisorFrame *made = frame(0, 0x0C00002Au); /* TSC1 to the drive: reserved bits are 1 */
    size_t at;
    for (at = 0; at < 8; at += 1) {
        made->data[at] = 0xFF;
    }
    made->data[0] = (uint8_t)(MainController_Y.DriveTorque > 0u ? 0xFEu : 0xFCu); /* torque control, or override disabled */
    made->data[3] = (uint8_t)(MainController_Y.DriveTorque + 125u);               /* 1 %, offset -125 % */
    made->data[4] = 0x07u;                                                        /* purpose: the driver's pedal */
    protect_tsc1(made, counter_tsc1);
    made = frame(1, 0x0CFF222Au);
    made->data[2] = MainController_Y.GearRequest;
    protect_profile11(made, counter);
    made = frame(2, 0x0CFF232Au);
    made->data[2] = (uint8_t)(MainController_Y.EPBRequest | SUPERVISOR_EPB_MODE_AUTOMATIC << 2);
    protect_profile11(made, counter);
    made = frame(3, 0x0CFF2B2Au);
    made->data[2] = MainController_Y.K4Request;
    protect_profile11(made, counter);
    counter_tsc1 = (uint8_t)((counter_tsc1 + 1u) & 7u);
    counter = (uint8_t)(counter < 14u ? counter + 1u : 0u);
    mailbox.count = 4;
    mailbox.sequence += 1u;
}

void main_controller_task(void)
{
    uint32_t seen = 0;
    for (;;) {
        if (mailbox.tick != seen) {
            seen = mailbox.tick;
            MainController_U.Time_ms = mailbox.now_ms;
            MainController_U.AccelPedal = mailbox.pedal;
            MainController_step();
            send();
        }
    }
}
