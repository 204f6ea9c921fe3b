/* Frames of the main controller: counter and check field of AUTOSAR E2E Profile 11 (variant A) and of J1939 TSC1, XBR.
 * What the counter is for, and which message has which, stands in supervisor/wire/ebus.dbc. */
#ifndef LINK_H
#define LINK_H
#include "supervisor.h"

/* Puts counter and CRC into bytes 0 and 1. */
void protect_profile11(SupervisorFrame *frame, uint8_t counter);
/* Puts counter (0 to 7) and checksum into byte 7. */
void protect_tsc1(SupervisorFrame *frame, uint8_t counter);
/* Puts counter (0 to 15) and checksum into byte 7. */
void protect_xbr(SupervisorFrame *frame, uint8_t counter);

#endif
