/* The calls as a C program makes them. Prints "N passed, 0 failed". The argument is a file with a sealed configuration.
 * Compiles as C99 and as C++17. */
#include "supervisor.h"

#include <stdio.h>
#include <string.h>

static unsigned passed;
static unsigned failed;

static void check(int holds, const char *what, int line)
{
    if (holds) {
        passed += 1;
    } else {
        failed += 1;
        printf("line %d: %s\n", line, what);
    }
}
#define CHECK(condition) check((condition) ? 1 : 0, #condition, __LINE__)

static uint8_t sealed[SUPERVISOR_SEALED_BYTES];
static SupervisorState state;
static SupervisorState other;
static SupervisorDiagnosis diagnosis;
static SupervisorFrame frames[SUPERVISOR_OUTPUT_FRAMES];
static SupervisorEvent events[SUPERVISOR_EVENTS];
static SupervisorTrouble troubles[SUPERVISOR_TROUBLES];
static SupervisorDecision decision;

static SupervisorCode start(SupervisorState *place)
{
    return supervisor_init(place, sizeof *place, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed,
                           SUPERVISOR_RESET_CAUSE_POWER_ON, SUPERVISOR_RECORD_NONE);
}

static int read_sealed(const char *path)
{
    FILE *file = fopen(path, "rb");
    size_t length = 0;
    if (file != NULL) {
        length = fread(sealed, 1, sizeof sealed, file);
        (void)fclose(file);
    }
    return length == sizeof sealed;
}

/* The numbers of the header are those of the library, and the structures have no gap. */
static void numbers(void)
{
    CHECK(supervisor_abi_version() == SUPERVISOR_ABI_VERSION);
    CHECK(supervisor_state_bytes() == sizeof(SupervisorState));
    CHECK(supervisor_state_bytes() == SUPERVISOR_STATE_BYTES);
    CHECK(sizeof(SupervisorState) % supervisor_state_alignment() == 0);
    CHECK(supervisor_diagnosis_bytes() == sizeof(SupervisorDiagnosis));
    CHECK(sizeof(SupervisorDiagnosis) % supervisor_diagnosis_alignment() == 0);
    CHECK(supervisor_sealed_bytes() == SUPERVISOR_SEALED_BYTES);
    CHECK(supervisor_output_frames() == SUPERVISOR_OUTPUT_FRAMES);
    CHECK(sizeof(SupervisorFrame) == 16);
    CHECK(sizeof(SupervisorReceipt) == 4);
    CHECK(sizeof(SupervisorVerdict) == 16);
    CHECK(sizeof(SupervisorOutputs) == 48);
    CHECK(sizeof(SupervisorStatus) == 16);
    CHECK(sizeof(SupervisorDecision) == 256);
    CHECK(sizeof(SupervisorEvent) == 24);
    CHECK(sizeof(SupervisorTrouble) == 12);
    CHECK(sizeof(SupervisorCode) == 4);
}

/* Nothing works without a start, and no start without a configuration. */
static void before_the_start(void)
{
    size_t count = 7;
    uint8_t answer[SUPERVISOR_ANSWER_BYTES] = {1, 2, 3, 4};
    CHECK(supervisor_step(&state, 10, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count)
          == SUPERVISOR_CODE_UNINITIALISED);
    CHECK(count == 0);
    CHECK(supervisor_watchdog(&state, 3, answer) == SUPERVISOR_CODE_UNINITIALISED);
    CHECK(answer[0] == 0 && answer[1] == 0 && answer[2] == 0 && answer[3] == 0);
    CHECK(supervisor_init(NULL, sizeof state, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed, 0, 0)
          == SUPERVISOR_CODE_NULL);
    CHECK(supervisor_init(&state, sizeof state, SUPERVISOR_ABI_VERSION + 1, sealed, sizeof sealed, 0, 0)
          == SUPERVISOR_CODE_VERSION);
    CHECK(supervisor_init(&state, sizeof state - 1, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed, 0, 0)
          == SUPERVISOR_CODE_SIZE);
    CHECK(supervisor_init(&state, sizeof state, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed - 1, 0, 0)
          == SUPERVISOR_CODE_CONFIG_LENGTH);
    sealed[40] = (uint8_t)(sealed[40] ^ 1u);
    CHECK(start(&state) == SUPERVISOR_CODE_CONFIG_CRC);
    sealed[40] = (uint8_t)(sealed[40] ^ 1u);
    CHECK(supervisor_init(&state, sizeof state, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed, 3, 0)
          == SUPERVISOR_CODE_VALUE);
    CHECK(supervisor_step(&state, 10, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count)
          == SUPERVISOR_CODE_UNINITIALISED);
}

/* A silent bus: every channel has a frame, a neutral output and a reason. */
static void silence(void)
{
    size_t count = 0;
    size_t at;
    uint8_t answer[SUPERVISOR_ANSWER_BYTES];
    uint8_t first;
    CHECK(start(&state) == SUPERVISOR_CODE_OK);
    CHECK(start(&other) == SUPERVISOR_CODE_OK);
    CHECK(supervisor_watchdog(&state, 0, answer) == SUPERVISOR_CODE_NOT_STEPPED);
    CHECK(answer[0] != 0xFF);
    CHECK(supervisor_step(&state, 10, &decision, frames, SUPERVISOR_OUTPUT_FRAMES - 1, &count)
          == SUPERVISOR_CODE_CAPACITY);
    CHECK(supervisor_step(&state, 10, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count) == SUPERVISOR_CODE_OK);
    CHECK(count == SUPERVISOR_OUTPUT_FRAMES);
    for (at = 0; at < SUPERVISOR_CHANNELS; at += 1) {
        CHECK(decision.verdicts[at].reason == SUPERVISOR_REASON_COMMAND_LOST
              || decision.verdicts[at].reason == SUPERVISOR_REASON_WARNING_OBLIGED);
    }
    CHECK(decision.outputs.drive_torque == 0);
    CHECK(decision.outputs.epb_request == SUPERVISOR_EPB_REQUEST_NONE);
    CHECK(decision.outputs.k1 == SUPERVISOR_CONTACTOR_REQUEST_HOLD);
    CHECK((decision.status.faults & (uint32_t)SUPERVISOR_FAULT_SEAT_UNKNOWN) != 0);
    CHECK(decision.status.record == SUPERVISOR_RECORD_NONE);
    CHECK(supervisor_watchdog(&state, 0, answer) == SUPERVISOR_CODE_OK);
    CHECK(answer[0] == 0xFF && answer[1] == 0x0F && answer[2] == 0xF0 && answer[3] == 0x00);
    first = answer[0];
    CHECK(supervisor_watchdog(&state, 0, answer) == SUPERVISOR_CODE_NOT_STEPPED);
    CHECK(answer[0] != first || answer[1] != 0x0F || answer[2] != 0xF0 || answer[3] != 0x00);
}

/* Frames in: an unknown one, a damaged one; and the bus of the actuators: an echo, a foreign command. */
static void frames_in(void)
{
    SupervisorFrame frame = {0x1FFFFFFFu, {0, 0, 0, 0, 0, 0, 0, 0}, 8, {0, 0, 0}};
    SupervisorReceipt receipt = {0, 0, 0, 0};
    size_t count = 0;
    CHECK(supervisor_receive(&state, 12, &frame, &receipt) == SUPERVISOR_CODE_FRAME_REFUSED);
    CHECK(receipt.message == 255 && receipt.fault == SUPERVISOR_FRAME_FAULT_IDENTIFIER);
    frame.id = 0x0CFF1021u; /* Seat1, without a checksum */
    CHECK(supervisor_receive(&state, 12, &frame, NULL) == SUPERVISOR_CODE_FRAME_REFUSED);
    frame.length = 9;
    CHECK(supervisor_receive(&state, 12, &frame, &receipt) == SUPERVISOR_CODE_FRAME_REFUSED);
    CHECK(receipt.fault == SUPERVISOR_FRAME_FAULT_LENGTH);
    CHECK(supervisor_receive_actuator(&state, 12, &frames[0], &receipt) == SUPERVISOR_CODE_OK);
    CHECK(supervisor_receive_actuator(&state, 12, &frames[0], &receipt) == SUPERVISOR_CODE_FRAME_REFUSED);
    CHECK(receipt.fault == SUPERVISOR_FRAME_FAULT_SOURCE);
    CHECK(supervisor_receive(&state, 12, NULL, NULL) == SUPERVISOR_CODE_NULL);
    CHECK(supervisor_step(&state, 20, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count) == SUPERVISOR_CODE_OK);
    CHECK((decision.status.faults & (uint32_t)SUPERVISOR_FAULT_SECOND_SENDER) != 0);
}

/* One command against the envelope. */
static void vetting(void)
{
    SupervisorOutputs asked = decision.outputs;
    SupervisorOutputs given;
    SupervisorVerdict verdict;
    asked.epb_request = SUPERVISOR_EPB_REQUEST_RELEASE;
    CHECK(supervisor_vet(&state, 21, SUPERVISOR_CHANNEL_PARKING_BRAKE, &asked, &given, &verdict) == SUPERVISOR_CODE_OK);
    CHECK(given.epb_request == SUPERVISOR_EPB_REQUEST_NONE);
    CHECK(verdict.kind == SUPERVISOR_KIND_BLOCK && verdict.reason == SUPERVISOR_REASON_SEAT_NOT_OCCUPIED);
    CHECK(supervisor_vet(&state, 21, SUPERVISOR_CHANNELS, &asked, &given, &verdict) == SUPERVISOR_CODE_VALUE);
    CHECK(supervisor_vet(&state, 200, SUPERVISOR_CHANNEL_GEAR, &asked, &given, &verdict) == SUPERVISOR_CODE_EXPIRED);
    CHECK(supervisor_vet(&other, 21, SUPERVISOR_CHANNEL_GEAR, &asked, &given, &verdict)
          == SUPERVISOR_CODE_NOT_STEPPED);
    CHECK(supervisor_vet(&state, 21, SUPERVISOR_CHANNEL_GEAR, &asked, &asked, &verdict) == SUPERVISOR_CODE_OVERLAP);
}

/* Five seconds of a silent bus: what driver and workshop are told. */
static void diagnoses(void)
{
    SupervisorBodyFeedback unknown;
    SupervisorFrame dm1;
    size_t count = 0;
    uint32_t dropped = 99;
    uint32_t now;
    unsigned sent = 0;
    memset(&unknown, 0xFF, sizeof unknown);
    CHECK(supervisor_diagnosis_observe(&diagnosis, &other, NULL) == SUPERVISOR_CODE_NOT_STEPPED);
    CHECK(supervisor_diagnosis_init(&diagnosis, sizeof diagnosis, SUPERVISOR_ABI_VERSION) == SUPERVISOR_CODE_OK);
    for (now = 10; now <= 5000; now += 10) {
        SupervisorCode due;
        CHECK(supervisor_step(&other, now, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count) == SUPERVISOR_CODE_OK);
        CHECK(supervisor_diagnosis_observe(&diagnosis, &other, &unknown) == SUPERVISOR_CODE_OK);
        due = supervisor_diagnosis_dm1(&diagnosis, now, &dm1);
        CHECK(due == SUPERVISOR_CODE_OK || due == SUPERVISOR_CODE_NOTHING);
        sent += due == SUPERVISOR_CODE_OK ? 1u : 0u;
    }
    CHECK(sent > 2);
    CHECK(supervisor_diagnosis_events(&diagnosis, events, SUPERVISOR_EVENTS, &count, &dropped) == SUPERVISOR_CODE_OK);
    CHECK(count > 12 && dropped == 0);
    CHECK(events[0].what == SUPERVISOR_EVENT_KIND_VERDICT && events[0].time_ms == 10);
    CHECK(supervisor_diagnosis_troubles(&diagnosis, troubles, SUPERVISOR_TROUBLES, &count) == SUPERVISOR_CODE_OK);
    CHECK(count > 3 && troubles[0].occurrences == 1 && troubles[0].present == 1);
    CHECK(supervisor_diagnosis_troubles(&diagnosis, troubles, 1, &count) == SUPERVISOR_CODE_OK);
    CHECK(count == 1);
}

int main(int argc, char **argv)
{
    if (argc != 2 || !read_sealed(argv[1])) {
        printf("usage: boundary SEALED_CONFIGURATION\n");
        return 2;
    }
    numbers();
    before_the_start();
    silence();
    frames_in();
    vetting();
    diagnoses();
    printf("%u passed, %u failed\n", passed, failed);
    return failed == 0 ? 0 : 1;
}
