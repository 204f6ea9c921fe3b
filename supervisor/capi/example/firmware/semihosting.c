#include "semihosting.h"

#define SYS_OPEN 0x01u
#define SYS_CLOSE 0x02u
#define SYS_WRITE0 0x04u
#define SYS_READ 0x06u
#define SYS_EXIT 0x18u
#define APPLICATION_EXIT 0x20026u
#define RUNTIME_ERROR 0x20023u

static uint8_t buffer[4096];
static size_t filled;
static size_t taken;
static uint32_t handle;

static uint32_t call(uint32_t number, const void *argument)
{
    register uint32_t r0 __asm__("r0") = number;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void say(const char *text)
{
    (void)call(SYS_WRITE0, text);
}

void say_number(uint32_t number)
{
    char text[11];
    size_t at = sizeof text - 1;
    text[at] = '\0';
    do {
        at -= 1;
        text[at] = (char)('0' + (int)(number % 10u));
        number /= 10u;
    } while (number != 0u);
    say(&text[at]);
}

static size_t length_of(const char *text)
{
    size_t length = 0;
    while (text[length] != '\0') {
        length += 1;
    }
    return length;
}

int open_file(const char *name)
{
    const uint32_t block[3] = {(uint32_t)(uintptr_t)name, 1u /* "rb" */, (uint32_t)length_of(name)};
    filled = 0;
    taken = 0;
    handle = call(SYS_OPEN, block);
    return handle != 0xFFFFFFFFu;
}

int read_file(void *bytes, size_t length)
{
    uint8_t *out = bytes;
    size_t at;
    for (at = 0; at < length; at += 1) {
        if (taken == filled) {
            const uint32_t block[3] = {handle, (uint32_t)(uintptr_t)buffer, sizeof buffer};
            /* The answer is how many bytes are missing. */
            filled = sizeof buffer - call(SYS_READ, block);
            taken = 0;
            if (filled == 0) {
                return 0;
            }
        }
        out[at] = buffer[taken];
        taken += 1;
    }
    return 1;
}

void close_file(void)
{
    const uint32_t block[1] = {handle};
    (void)call(SYS_CLOSE, block);
}

_Noreturn void end(int good)
{
    (void)call(SYS_EXIT, (const void *)(uintptr_t)(good ? APPLICATION_EXIT : RUNTIME_ERROR));
    for (;;) {
    }
}
