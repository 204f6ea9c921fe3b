/* A model of the safety SBC's watchdog: it asks, and counts the answers that are right. The table is that of public data
 * sheets (TLF35584, TCAN1465-Q1): the third response byte, and the others by their difference from it. */
#include "board.h"

static const uint8_t third[16] = {0xFF, 0xB0, 0xE9, 0xA6, 0x75, 0x3A, 0x63, 0x2C,
                                  0xD2, 0x9D, 0xC4, 0x8B, 0x58, 0x17, 0x4E, 0x01};
static const uint8_t difference[SUPERVISOR_ANSWER_BYTES] = {0x00, 0xF0, 0x0F, 0xFF};
static uint8_t question;
static uint32_t right;
static uint32_t wrong;

uint8_t watchdog_question(void)
{
    return question;
}

void watchdog_take(const uint8_t *answer)
{
    int good = 1;
    size_t at;
    for (at = 0; at < SUPERVISOR_ANSWER_BYTES; at += 1) {
        good = good && answer[at] == (uint8_t)(third[question] ^ difference[at]);
    }
    right += good ? 1u : 0u;
    wrong += good ? 0u : 1u;
    question = (uint8_t)((question + 7u) & 15u);
}

uint32_t watchdog_right(void)
{
    return right;
}

uint32_t watchdog_wrong(void)
{
    return wrong;
}
