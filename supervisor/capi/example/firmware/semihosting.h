/* What the debugger, here QEMU, does for the firmware: print, read a file, end. Not for a vehicle. */
#ifndef SEMIHOSTING_H
#define SEMIHOSTING_H
#include <stddef.h>
#include <stdint.h>

void say(const char *text);
void say_number(uint32_t number);
int open_file(const char *name);               /* 1 if it could be opened; one file at a time */
int read_file(void *bytes, size_t length);     /* 1 if it got them all */
void close_file(void);
_Noreturn void end(int good);

#endif
