/* Freedom from interference, sketched: the memory protection unit of the Cortex-M4 lets the main controller, which runs
 * unprivileged, write into its own memory and into the mailbox, and nowhere else. A vehicle does the same with the
 * partitions of its operating system or, better, with a second core or a controller of its own. */
#include "board.h"

extern uint32_t mailbox_partition[], controller_partition[];

#define MPU_CTRL (*(volatile uint32_t *)0xE000ED94u)
#define MPU_RNR (*(volatile uint32_t *)0xE000ED98u)
#define MPU_RBAR (*(volatile uint32_t *)0xE000ED9Cu)
#define MPU_RASR (*(volatile uint32_t *)0xE000EDA0u)
#define SHCSR (*(volatile uint32_t *)0xE000ED24u)

#define READ_ONLY (6u << 24)
#define PRIVILEGED (1u << 24)
#define EVERYBODY (3u << 24)
#define NO_CODE (1u << 28)
#define NORMAL (1u << 17 | 1u << 16)

/* A region of 2 to the power of `bits` bytes; a later one goes before an earlier one. */
static void region(uint32_t number, uint32_t begin, uint32_t bits, uint32_t access)
{
    MPU_RNR = number;
    MPU_RBAR = begin;
    MPU_RASR = access | NORMAL | (bits - 1u) << 1 | 1u;
}

void protect_memory(void)
{
    region(0, 0x00000000u, 22, READ_ONLY);
    region(1, 0x20000000u, 22, PRIVILEGED | NO_CODE);
    region(2, (uint32_t)(uintptr_t)mailbox_partition, 12, EVERYBODY | NO_CODE);
    region(3, (uint32_t)(uintptr_t)controller_partition, 13, EVERYBODY | NO_CODE);
    SHCSR |= 1u << 16;   /* a handler of its own for the memory fault */
    MPU_CTRL = 1u | 4u;  /* on; peripherals for privileged code alone */
    __asm__ volatile("dsb\n isb" ::: "memory");
}

_Noreturn void run_unprivileged(void (*task)(void), uint32_t *stack)
{
    __asm__ volatile("msr psp, %0\n"
                     "mov r2, #3\n"
                     "msr control, r2\n" /* unprivileged, on its own stack */
                     "isb\n"
                     "blx %1\n"
                     :
                     : "r"(stack), "r"(task)
                     : "r2", "memory");
    for (;;) {
    }
}

void redirect_unprivileged(void (*task)(void))
{
    uint32_t *frame;
    __asm__ volatile("mrs %0, psp" : "=r"(frame));
    frame[6] = (uint32_t)(uintptr_t)task & ~1u; /* where the exception returns to */
}
