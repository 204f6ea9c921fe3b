/* The main controller: what a code generator makes of a model, and the few lines around it. Nobody trusts it. */
#ifndef MAIN_CONTROLLER_H
#define MAIN_CONTROLLER_H
#include "supervisor.h"

#define CONTROLLER_FRAMES 8u

/* Between both sides. Sequence numbers say what is new; nothing else in it is believed. */
struct mailbox {
    volatile uint32_t tick;      /* written by the supervisor's side: a new cycle */
    volatile uint32_t now_ms;    /* its time */
    volatile uint8_t pedal;      /* accelerator, 0.4 %, as the controller would read it from the bus */
    volatile uint32_t sequence;  /* written by the controller: frames are complete */
    volatile uint32_t count;
    SupervisorFrame frames[CONTROLLER_FRAMES];
};

extern struct mailbox mailbox;
/* What it does wrong, and from when, in ms. */
#define SHIFTS_TO_REVERSE 3000u
#define APPLIES_PARKING_BRAKE 3300u
#define OPENS_K4 3600u
#define WRITES_INTO_SUPERVISOR 3900u
#define ENDS 4200u

/* The task: runs unprivileged, once for every tick, for ever. */
void main_controller_task(void);

#endif
