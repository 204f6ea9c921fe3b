/* What a call takes: painted stack, and instructions as QEMU counts them (`-icount shift=6`: 64 ns each, 25 MHz timer). */
#include "board.h"

extern uint32_t stack_bottom[];

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)
#define PAINT 0xA5A5A5A5u
#define CYCLE 250000u /* 10 ms at 25 MHz */

static uint32_t before_step;
static uint32_t most;
static uint32_t deepest;

static uint32_t *stack_now(void)
{
    uint32_t *now;
    __asm__ volatile("mov %0, sp" : "=r"(now));
    return now;
}

void paint_stack(void)
{
    uint32_t *at = stack_bottom;
    uint32_t *const now = stack_now() - 16;
    while (at < now) {
        *at = PAINT;
        at += 1;
    }
}

uint32_t painted_stack(void)
{
    const uint32_t *at = stack_bottom;
    const uint32_t *const now = stack_now();
    while (at < now && *at == PAINT) {
        at += 1;
    }
    return (uint32_t)((const uint8_t *)now - (const uint8_t *)at);
}

void start_counting(void)
{
    most = 0;
    deepest = 0;
    SYST_CSR = 0;
    SYST_RVR = 0x00FFFFFFu;
    SYST_CVR = 0;
    SYST_CSR = 5u; /* runs from the processor's clock, without interrupt */
}

void around_step(int before)
{
    const uint32_t now = SYST_CVR;
    if (before) {
        paint_stack();
        before_step = SYST_CVR;
    } else {
        const uint32_t ticks = (before_step - now) & 0x00FFFFFFu;
        const uint32_t stack = painted_stack();
        most = ticks > most ? ticks : most;
        deepest = stack > deepest ? stack : deepest;
    }
}

uint32_t deepest_step(void)
{
    return deepest;
}

uint32_t worst_step(void)
{
    /* 64 ns an instruction, 40 ns a tick. */
    return most * 5u / 8u;
}

void start_ticking(void)
{
    SYST_CSR = 0;
    SYST_RVR = CYCLE - 1u;
    SYST_CVR = 0;
    SYST_CSR = 7u;
}
