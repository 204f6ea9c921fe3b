#include "replay.h"
#include "digest.h"

#define MAGIC 0x56534245u /* "EBSV" */
#define VERSION 1u

static uint32_t word(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* The frames before one step. */
static int receive(SupervisorState *state, uint32_t count, replay_read read, struct replay *result)
{
    uint32_t number;
    for (number = 0; number < count; number += 1u) {
        uint8_t bytes[20];
        SupervisorFrame frame = {0, {0, 0, 0, 0, 0, 0, 0, 0}, 0, {0, 0, 0}};
        size_t at;
        if (!read(bytes, sizeof bytes)) {
            return 0;
        }
        frame.id = word(bytes + 4);
        for (at = 0; at < 8; at += 1) {
            frame.data[at] = bytes[8 + at];
        }
        frame.length = bytes[16];
        result->code = supervisor_receive(state, word(bytes), &frame, NULL);
        if (result->code != SUPERVISOR_CODE_OK && result->code != SUPERVISOR_CODE_FRAME_REFUSED) {
            return 0;
        }
    }
    return 1;
}

int replay(SupervisorState *state, const uint8_t *sealed, size_t sealed_bytes, replay_read read, replay_around around,
           struct replay *result)
{
    static SupervisorDecision decision;
    static SupervisorFrame frames[SUPERVISOR_OUTPUT_FRAMES];
    uint8_t bytes[16];
    uint32_t cycle;
    result->cycles = 0;
    result->identical = 0;
    result->first_different = 0;
    result->code = SUPERVISOR_CODE_OK;
    if (!read(bytes, sizeof bytes) || word(bytes) != MAGIC || word(bytes + 4) != VERSION) {
        return 0;
    }
    result->cycles = word(bytes + 8);
    result->first_different = result->cycles;
    result->code = supervisor_init(state, sizeof *state, SUPERVISOR_ABI_VERSION, sealed, sealed_bytes, bytes[12], bytes[13]);
    if (result->code != SUPERVISOR_CODE_OK) {
        return 0;
    }
    for (cycle = 0; cycle < result->cycles; cycle += 1u) {
        size_t count = 0;
        uint64_t expected;
        if (!read(bytes, sizeof bytes) || !receive(state, word(bytes + 4), read, result)) {
            return 0;
        }
        expected = (uint64_t)word(bytes + 8) | (uint64_t)word(bytes + 12) << 32;
        if (around != NULL) {
            around(1);
        }
        result->code = supervisor_step(state, word(bytes), &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count);
        if (around != NULL) {
            around(0);
        }
        if (result->code != SUPERVISOR_CODE_OK) {
            return 0;
        }
        if (digest(&decision, frames, count) == expected) {
            result->identical += 1u;
        } else if (result->first_different == result->cycles) {
            result->first_different = cycle;
        }
    }
    return 1;
}
