/* Times and counts the hooks of opendbc (https://github.com/commaai/opendbc) that vet one frame to an actuator, for tests/benches/peer. */
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "opendbc/safety/tests/libsafety/safety.c"

#define TOYOTA 2U
#define EPS_SCALE 73U

/* Not inlined: callgrind counts what is called from here, and only that. */
__attribute__((noinline)) int measured(CANPacket_t *frame) {
  int passed = safety_tx_hook(frame) ? 1 : 0;
  __asm__ volatile("" ::: "memory");
  return passed;
}

static CANPacket_t acceleration(int mm_s2) {
  CANPacket_t frame;
  memset(&frame, 0, sizeof frame);
  frame.addr = 0x343U;
  frame.data_len_code = 8U;
  frame.data[0] = (unsigned char)((unsigned)mm_s2 >> 8);
  frame.data[1] = (unsigned char)mm_s2;
  return frame;
}

static CANPacket_t steering(void) {
  CANPacket_t frame;
  memset(&frame, 0, sizeof frame);
  frame.addr = 0x2E4U;
  frame.data_len_code = 5U;
  return frame;
}

static void one(const char *name, CANPacket_t frame, int expected, int repeats) {
  double least = 1e18;
  for (int batch = 0; batch < (repeats > 1 ? 30 : 1); batch++) {
    struct timespec begin, end;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    for (int call = 0; call < repeats; call++) {
      if (measured(&frame) != expected) {
        fprintf(stderr, "%s: the hook answers other than expected\n", name);
        exit(1);
      }
    }
    clock_gettime(CLOCK_MONOTONIC, &end);
    double took = ((double)(end.tv_sec - begin.tv_sec) * 1e9 + (double)(end.tv_nsec - begin.tv_nsec)) / repeats;
    least = took < least ? took : least;
  }
  printf("%s\t%.2f\n", name, least);
}

int main(int count, char **arguments) {
  int repeats = count > 1 && strcmp(arguments[1], "once") == 0 ? 1 : 1000;
  if (set_safety_hooks(TOYOTA, EPS_SCALE) != 0) {
    fprintf(stderr, "the hooks cannot be set\n");
    return 1;
  }
  init_tests();
  set_controls_allowed(true);
  one("acceleration, allowed", acceleration(1000), 1, repeats);
  one("acceleration, refused", acceleration(9000), 0, repeats);
  one("steering, idle", steering(), 1, repeats);
  return 0;
}
