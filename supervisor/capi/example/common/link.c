#include "link.h"

static uint8_t crc8(uint8_t crc, uint8_t byte)
{
    unsigned bit;
    crc ^= byte;
    for (bit = 0; bit < 8u; bit += 1u) {
        crc = (uint8_t)((crc & 0x80u) != 0u ? (unsigned)crc << 1 ^ 0x1Du : (unsigned)crc << 1);
    }
    return crc;
}

void protect_profile11(SupervisorFrame *frame, uint8_t counter)
{
    uint8_t crc = 0;
    size_t at;
    frame->length = 8;
    frame->data[1] = (uint8_t)((frame->data[1] & 0xF0u) | (counter & 0x0Fu));
    /* The data id is the low half of the identifier. */
    crc = crc8(crc, (uint8_t)(frame->id & 0xFFu));
    crc = crc8(crc, (uint8_t)(frame->id >> 8 & 0xFFu));
    for (at = 1; at < 8; at += 1) {
        crc = crc8(crc, frame->data[at]);
    }
    frame->data[0] = crc;
}

/* Data, identifier and counter, the checksum left out. */
static uint32_t sum(SupervisorFrame *frame, uint8_t counter)
{
    uint32_t total = 0;
    size_t at;
    frame->length = 8;
    frame->data[7] = counter & 0x0Fu;
    for (at = 0; at < 8; at += 1) {
        total += frame->data[at];
    }
    for (at = 0; at < 4; at += 1) {
        total += frame->id >> (8u * at) & 0xFFu;
    }
    return total;
}

void protect_tsc1(SupervisorFrame *frame, uint8_t counter)
{
    const uint32_t total = sum(frame, counter);
    const uint32_t check = ((total >> 6 & 3u) + (total >> 3) + total) & 7u;
    frame->data[7] = (uint8_t)(frame->data[7] | check << 4);
}

void protect_xbr(SupervisorFrame *frame, uint8_t counter)
{
    const uint32_t total = sum(frame, counter);
    const uint32_t check = ((total >> 4) + total) & 15u;
    frame->data[7] = (uint8_t)(frame->data[7] | check << 4);
}
