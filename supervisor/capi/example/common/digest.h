/* One number of everything that a step decided and sent, as the golden vectors have it. */
#ifndef DIGEST_H
#define DIGEST_H
#include "supervisor.h"

/* FNV-1a (64 bits) over verdicts, outputs, status, each value as four bytes, then identifier and data of every frame. */
uint64_t digest(const SupervisorDecision *decision, const SupervisorFrame *frames, size_t count);

#endif
