/* The first vetted frame: a main controller asks for 60 % torque on a bus of which nothing is known yet.
 * Usage: first SEALED_CONFIGURATION */
#include "link.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    static SupervisorState state;
    static uint8_t sealed[SUPERVISOR_SEALED_BYTES];
    SupervisorFrame torque = {0x0C00002Au, {0xFE, 0xFF, 0xFF, 60 + 125, 0x07, 0xFF, 0xFF, 0xFF}, 8, {0, 0, 0}};
    SupervisorFrame frames[SUPERVISOR_OUTPUT_FRAMES];
    SupervisorDecision decision;
    SupervisorReceipt receipt;
    uint8_t answer[SUPERVISOR_ANSWER_BYTES];
    size_t count = 0;
    size_t at;
    uint8_t counter;
    FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
    if (file == NULL || fread(sealed, 1, sizeof sealed, file) != sizeof sealed) {
        printf("usage: first SEALED_CONFIGURATION\n");
        return 2;
    }
    (void)fclose(file);
    if (supervisor_init(&state, sizeof state, SUPERVISOR_ABI_VERSION, sealed, sizeof sealed,
                        SUPERVISOR_RESET_CAUSE_POWER_ON, SUPERVISOR_RECORD_NONE) != SUPERVISOR_CODE_OK) {
        printf("the supervisor does not start\n");
        return 1;
    }
    for (counter = 0; counter < 2; counter += 1) {
        SupervisorCode code;
        protect_tsc1(&torque, counter);
        code = supervisor_receive(&state, 5u + counter, &torque, &receipt);
        printf("frame %08X with counter %u: code %u, fault %u\n", (unsigned)torque.id, (unsigned)counter, (unsigned)code,
               (unsigned)receipt.fault);
    }
    if (supervisor_step(&state, 10, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count) != SUPERVISOR_CODE_OK
        || supervisor_watchdog(&state, 0, answer) != SUPERVISOR_CODE_OK) {
        printf("the step was refused\n");
        return 1;
    }
    printf("drive torque: kind %u, reason %u, asked %d, limit %d, margin %d; %u %% go out\n",
           (unsigned)decision.verdicts[SUPERVISOR_CHANNEL_DRIVE_TORQUE].kind,
           (unsigned)decision.verdicts[SUPERVISOR_CHANNEL_DRIVE_TORQUE].reason,
           (int)decision.verdicts[SUPERVISOR_CHANNEL_DRIVE_TORQUE].value,
           (int)decision.verdicts[SUPERVISOR_CHANNEL_DRIVE_TORQUE].limit,
           (int)decision.verdicts[SUPERVISOR_CHANNEL_DRIVE_TORQUE].margin, (unsigned)decision.outputs.drive_torque);
    for (at = 0; at < count; at += 1) {
        printf("send %08X %02X%02X%02X%02X%02X%02X%02X%02X\n", (unsigned)frames[at].id, (unsigned)frames[at].data[0],
               (unsigned)frames[at].data[1], (unsigned)frames[at].data[2], (unsigned)frames[at].data[3],
               (unsigned)frames[at].data[4], (unsigned)frames[at].data[5], (unsigned)frames[at].data[6],
               (unsigned)frames[at].data[7]);
    }
    return 0;
}
