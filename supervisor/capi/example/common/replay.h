/* A golden vector through the supervisor, cycle by cycle. */
#ifndef REPLAY_H
#define REPLAY_H
#include "supervisor.h"

/* Reads the next bytes of the vector; 1 if it got them all. */
typedef int (*replay_read)(void *bytes, size_t length);
/* Called before and after every step, to measure it; may be null. */
typedef void (*replay_around)(int before);

struct replay {
    uint32_t cycles;          /* in the vector */
    uint32_t identical;       /* whose digest is that of the vector */
    uint32_t first_different; /* number of the first other one; cycles if there is none */
    SupervisorCode code;      /* of the last call */
};

/* 1 if the vector could be read to its end and every call was carried out. */
int replay(SupervisorState *state, const uint8_t *sealed, size_t sealed_bytes, replay_read read, replay_around around,
           struct replay *result);

#endif
