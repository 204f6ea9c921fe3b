/* The supervisor beside a main controller, on one core: start-up test, golden vectors, then both side by side.
 *
 * The supervisor's cycle runs privileged in the timer's interrupt, every 10 ms, whatever the main controller does; the
 * main controller is a task without privileges. Sensors come from a golden vector, the bus is a buffer. */
#include "board.h"
#include "main_controller.h"
#include "replay.h"
#include "semihosting.h"

extern uint32_t controller_stack_top[];

SUPERVISOR_PARTITION static SupervisorState state;
SUPERVISOR_PARTITION static SupervisorDiagnosis diagnosis;
SUPERVISOR_PARTITION static uint8_t sealed[SUPERVISOR_SEALED_BYTES];
SUPERVISOR_PARTITION static SupervisorDecision decision;
SUPERVISOR_PARTITION static SupervisorFrame frames[SUPERVISOR_OUTPUT_FRAMES];

static SupervisorEvent events[SUPERVISOR_EVENTS];
static char list[2048];
static volatile int controller_stopped;
static uint32_t refused_as_expected;
static uint32_t stack_of_init;
static uint32_t stack_of_receive;
static uint32_t stack_of_step;

_Noreturn void end_badly(const char *why)
{
    say("FAILED: ");
    say(why);
    say("\n");
    end(0);
}

static void must(int holds, const char *what)
{
    if (!holds) {
        end_badly(what);
    }
}

static SupervisorCode start(void)
{
    return supervisor_init(&state, sizeof state, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed,
                           SUPERVISOR_RESET_CAUSE_POWER_ON, SUPERVISOR_RECORD_NONE);
}

/* At every start: each fault is injected, and the refusal is seen. A supervisor that lets one pass may not drive. */
static void start_up_test(void)
{
    uint8_t answer[SUPERVISOR_ANSWER_BYTES];
    size_t count = 1;
    SupervisorFrame frame = {0x0CFF1021u, {0, 0, 0, 0, 0, 0, 0, 0}, 8, {0, 0, 0}};
    SupervisorReceipt receipt;
    must(supervisor_abi_version() == SUPERVISOR_ABI_VERSION, "the library is of another version");
    must(supervisor_state_bytes() == sizeof state, "the state has another size");
    must(supervisor_step(&state, 0, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count)
             == SUPERVISOR_CODE_UNINITIALISED && count == 0, "a step without a start");
    sealed[100] = (uint8_t)(sealed[100] ^ 0x10u);
    must(start() == SUPERVISOR_CODE_CONFIG_CRC, "a configuration with a flipped bit");
    sealed[100] = (uint8_t)(sealed[100] ^ 0x10u);
    must(supervisor_init(&state, sizeof state - 8, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed, 0, 0)
             == SUPERVISOR_CODE_SIZE, "too little memory");
    paint_stack();
    must(start() == SUPERVISOR_CODE_OK, "the start");
    stack_of_init = painted_stack();
    must(supervisor_watchdog(&state, 0, answer) == SUPERVISOR_CODE_NOT_STEPPED && answer[0] != 0xFFu,
         "a watchdog answer without a step");
    paint_stack();
    must(supervisor_receive(&state, 5, &frame, &receipt) == SUPERVISOR_CODE_FRAME_REFUSED
             && receipt.fault == SUPERVISOR_FRAME_FAULT_CHECKSUM, "a frame without its checksum");
    stack_of_receive = painted_stack();
    must(supervisor_step(&state, 10, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count) == SUPERVISOR_CODE_OK
             && count == SUPERVISOR_OUTPUT_FRAMES, "a step");
    must(decision.outputs.drive_torque == 0 && decision.outputs.epb_request == SUPERVISOR_EPB_REQUEST_NONE,
         "nothing is known and something is asked for");
    {
        volatile uint8_t *header = (volatile uint8_t *)&state;
        header[0] = (uint8_t)(header[0] ^ 1u);
    }
    must(supervisor_step(&state, 20, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count)
             == SUPERVISOR_CODE_UNINITIALISED && count == 0, "a state that was overwritten");
    say("start-up test: every fault was refused\n");
}

/* The names of the vectors stand in vectors.txt, one a line. */
static void back_to_back(void)
{
    uint32_t identical = 0;
    uint32_t cycles = 0;
    size_t at = 0;
    size_t length = 0;
    must(open_file("vectors.txt"), "vectors.txt cannot be opened");
    while (length < sizeof list - 1 && read_file(&list[length], 1)) {
        length += 1;
    }
    close_file();
    start_counting();
    while (at < length) {
        struct replay result;
        const char *name = &list[at];
        while (at < length && list[at] != '\n') {
            at += 1;
        }
        list[at] = '\0';
        at += 1;
        must(open_file(name), name);
        must(replay(&state, sealed, sizeof sealed, read_file, around_step, &result), "a vector was broken off");
        close_file();
        say(name);
        say(": decisions identical: ");
        say_number(result.identical);
        say(" of ");
        say_number(result.cycles);
        say("\n");
        identical += result.identical;
        cycles += result.cycles;
    }
    stack_of_step = deepest_step();
    say("decisions identical: ");
    say_number(identical);
    say(" of ");
    say_number(cycles);
    say("\n");
    must(cycles > 0 && identical == cycles, "a decision differs from the host's");
}

static uint32_t word(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* The sensors' frames of one cycle of the vector; its main controller is left out, ours sends. */
static uint32_t sense(void)
{
    uint8_t head[16];
    uint32_t number;
    must(read_file(head, sizeof head), "the sensors end");
    for (number = 0; number < word(head + 4); number += 1u) {
        uint8_t bytes[20];
        SupervisorFrame frame = {0, {0, 0, 0, 0, 0, 0, 0, 0}, 0, {0, 0, 0}};
        SupervisorCode code;
        size_t at;
        must(read_file(bytes, sizeof bytes), "the sensors end");
        frame.id = word(bytes + 4);
        frame.length = bytes[16];
        for (at = 0; at < 8; at += 1) {
            frame.data[at] = bytes[8 + at];
        }
        if ((frame.id & 0xFFu) == 0x2Au) {
            continue;
        }
        code = supervisor_receive(&state, word(bytes), &frame, NULL);
        must(code == SUPERVISOR_CODE_OK || code == SUPERVISOR_CODE_FRAME_REFUSED, "a frame of the sensors");
        if (frame.id == 0x0CFF3300u) {
            mailbox.pedal = frame.data[2];
        }
    }
    return word(head);
}

/* What the main controller has put into the mailbox: copied first, believed in nothing. */
static void take_commands(uint32_t now)
{
    static uint32_t seen;
    uint32_t count = mailbox.count;
    uint32_t number;
    if (mailbox.sequence == seen) {
        return;
    }
    seen = mailbox.sequence;
    count = count < CONTROLLER_FRAMES ? count : CONTROLLER_FRAMES;
    for (number = 0; number < count; number += 1u) {
        const SupervisorFrame frame = mailbox.frames[number];
        const SupervisorCode code = supervisor_receive(&state, now, &frame, NULL);
        must(code == SUPERVISOR_CODE_OK || code == SUPERVISOR_CODE_FRAME_REFUSED, "a frame of the main controller");
    }
}

static void expect(uint32_t now, uint32_t from, uint8_t channel, uint8_t kind, uint8_t reason)
{
    const SupervisorVerdict *verdict = &decision.verdicts[channel];
    if (now == from + 100u && verdict->kind == kind && verdict->reason == reason) {
        refused_as_expected += 1u;
    }
}

/* What must have come of each misdeed, a tenth of a second after it begins. */
static void judge(uint32_t now)
{
    expect(now, SHIFTS_TO_REVERSE, SUPERVISOR_CHANNEL_GEAR, SUPERVISOR_KIND_BLOCK, SUPERVISOR_REASON_SELECTOR);
    expect(now, APPLIES_PARKING_BRAKE, SUPERVISOR_CHANNEL_PARKING_BRAKE, SUPERVISOR_KIND_BLOCK,
           SUPERVISOR_REASON_EPB_SPEED);
    expect(now, OPENS_K4, SUPERVISOR_CHANNEL_CONTACTORS, SUPERVISOR_KIND_BLOCK, SUPERVISOR_REASON_NOT_STANDSTILL);
    /* Stopped by the memory protection, it is silent: after its time-out there is no torque. */
    expect(now, WRITES_INTO_SUPERVISOR + 100u, SUPERVISOR_CHANNEL_DRIVE_TORQUE, SUPERVISOR_KIND_BLOCK,
           SUPERVISOR_REASON_COMMAND_LOST);
}

static void tell(void)
{
    size_t count = 0;
    size_t at;
    uint32_t dropped = 0;
    must(supervisor_diagnosis_events(&diagnosis, events, SUPERVISOR_EVENTS, &count, &dropped) == SUPERVISOR_CODE_OK,
         "the event record");
    for (at = 0; at < count; at += 1) {
        if (events[at].what == SUPERVISOR_EVENT_KIND_VERDICT && events[at].time_ms >= SHIFTS_TO_REVERSE) {
            say("  at ");
            say_number(events[at].time_ms);
            say(" ms: channel ");
            say_number(events[at].channel);
            say(", kind ");
            say_number(events[at].kind);
            say(", reason ");
            say_number(events[at].reason);
            say("\n");
        }
    }
    say("misdeeds refused as expected: ");
    say_number(refused_as_expected);
    say(" of 4\nwatchdog: right ");
    say_number(watchdog_right());
    say(", wrong ");
    say_number(watchdog_wrong());
    say("\nstack of init: ");
    say_number(stack_of_init);
    say("\nstack of receive: ");
    say_number(stack_of_receive);
    say("\nstack of step: ");
    say_number(stack_of_step);
    say("\ninstructions of the worst step: ");
    say_number(worst_step());
    say("\n");
    must(controller_stopped, "the main controller wrote into the supervisor");
    must(refused_as_expected == 4u && watchdog_wrong() == 0u && watchdog_right() > 400u, "side by side");
    end(1);
}

/* Every 10 ms. */
void on_tick(void)
{
    uint8_t answer[SUPERVISOR_ANSWER_BYTES];
    const uint32_t now = sense();
    size_t count = 0;
    size_t at;
    SupervisorCode code;
    take_commands(now);
    /* A refused step sends nothing and answers nothing: the actuators' time-out and the watchdog do the rest. */
    must(supervisor_step(&state, now, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count) == SUPERVISOR_CODE_OK,
         "the step");
    for (at = 0; at < count; at += 1) {
        /* Here the frame goes to the bus of the actuators; the controller hands it back when it was sent. */
        must(supervisor_receive_actuator(&state, now, &frames[at], NULL) == SUPERVISOR_CODE_OK, "an echo");
    }
    must(supervisor_watchdog(&state, watchdog_question(), answer) == SUPERVISOR_CODE_OK, "the watchdog");
    watchdog_take(answer);
    must(supervisor_diagnosis_observe(&diagnosis, &state, NULL) == SUPERVISOR_CODE_OK, "the diagnosis");
    code = supervisor_diagnosis_dm1(&diagnosis, now, &frames[0]);
    must(code == SUPERVISOR_CODE_OK || code == SUPERVISOR_CODE_NOTHING, "DM1");
    judge(now);
    if (now >= ENDS) {
        tell();
    }
    mailbox.now_ms = now;
    mailbox.tick += 1u;
}

/* The main controller wrote where it may not. It is stopped; the supervisor goes on. */
static void stopped(void)
{
    for (;;) {
    }
}

void on_memory_fault(void)
{
    controller_stopped = 1;
    redirect_unprivileged(stopped);
}

int main(void)
{
    must(open_file("default.bin") && read_file(sealed, sizeof sealed), "default.bin cannot be read");
    close_file();
    start_up_test();
    back_to_back();
    must(start() == SUPERVISOR_CODE_OK, "the start");
    must(supervisor_diagnosis_init(&diagnosis, sizeof diagnosis, SUPERVISOR_ABI_VERSION) == SUPERVISOR_CODE_OK,
         "the start of the diagnosis");
    must(open_file("boundary-driving.vec"), "boundary-driving.vec cannot be opened");
    {
        uint8_t head[16];
        must(read_file(head, sizeof head), "boundary-driving.vec is empty");
    }
    protect_memory();
    start_ticking();
    run_unprivileged(main_controller_task, controller_stack_top);
}
