/* What the parts of the firmware know of each other. */
#ifndef BOARD_H
#define BOARD_H
#include "supervisor.h"

/* Only the supervisor's side may write here: memory_protection.c. */
#define SUPERVISOR_PARTITION __attribute__((section(".supervisor")))
/* Both sides may write here: nothing in it is believed. */
#define MAILBOX_PARTITION __attribute__((section(".mailbox")))
/* The main controller may write here, and in the mailbox, and nowhere else. */
#define CONTROLLER_PARTITION __attribute__((section(".controller")))

void on_tick(void);         /* every 10 ms, privileged: the supervisor's cycle */
void on_memory_fault(void); /* the main controller has written where it may not */
_Noreturn void end_badly(const char *why);

/* memory_protection.c */
void protect_memory(void);
_Noreturn void run_unprivileged(void (*task)(void), uint32_t *stack);
void redirect_unprivileged(void (*task)(void));

/* figures.c: what a call takes, see the README. */
void paint_stack(void);
uint32_t painted_stack(void);
void start_counting(void);
void around_step(int before);
uint32_t worst_step(void);
uint32_t deepest_step(void);
void start_ticking(void);

/* watchdog.c: a model of the safety SBC's question-and-answer watchdog. */
uint8_t watchdog_question(void);
void watchdog_take(const uint8_t *answer);
uint32_t watchdog_right(void);
uint32_t watchdog_wrong(void);

#endif
