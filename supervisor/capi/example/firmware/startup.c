/* From the reset to main: vector table, memory, floating-point unit. */
#include "board.h"

extern uint32_t stack_top[];
extern uint32_t data_load[], data_begin[], data_end[], bss_begin[], bss_end[];
extern uint32_t supervisor_partition[], stack_bottom[], mailbox_partition[], controller_stack_top[];

_Noreturn void reset(void);
_Noreturn void broken(void);
int main(void);

static void zero(uint32_t *from, const uint32_t *to)
{
    while (from < to) {
        *from = 0;
        from += 1;
    }
}

_Noreturn void reset(void)
{
    const uint32_t *source = data_load;
    uint32_t *target = data_begin;
    /* The floating-point unit, before the first instruction that may use it. */
    *(volatile uint32_t *)0xE000ED88u |= 0xFu << 20;
    __asm__ volatile("dsb\n isb" ::: "memory");
    zero(supervisor_partition, stack_bottom);
    zero(mailbox_partition, controller_stack_top);
    zero(bss_begin, bss_end);
    while (target < data_end) {
        *target = *source;
        source += 1;
        target += 1;
    }
    (void)main();
    broken();
}

/* Whatever was not expected: no frame goes out and the watchdog is not answered. */
_Noreturn void broken(void)
{
    end_badly("an exception that nobody expects");
}

typedef void (*handler)(void);

__attribute__((section(".vectors"), used)) static const handler vectors[16] = {
    (handler)(uintptr_t)stack_top, reset, broken, broken, on_memory_fault, broken, broken, 0, 0, 0, 0, broken, broken, 0,
    broken, on_tick,
};
