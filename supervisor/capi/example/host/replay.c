/* Golden vectors through the C library on this machine: replay SEALED_CONFIGURATION VECTOR...
 * Exit codes: 0 every decision is identical, 1 one is not, 2 a file cannot be read. */
#include "replay.h"

#include <stdio.h>

static FILE *file;

static int read_file(void *bytes, size_t length)
{
    return fread(bytes, 1, length, file) == length;
}

int main(int argc, char **argv)
{
    static SupervisorState state;
    static uint8_t sealed[SUPERVISOR_SEALED_BYTES];
    unsigned long identical = 0;
    unsigned long cycles = 0;
    int number;
    if (argc < 3 || (file = fopen(argv[1], "rb")) == NULL || !read_file(sealed, sizeof sealed)) {
        printf("usage: replay SEALED_CONFIGURATION VECTOR...\n");
        return 2;
    }
    (void)fclose(file);
    for (number = 2; number < argc; number += 1) {
        struct replay result;
        int whole;
        file = fopen(argv[number], "rb");
        if (file == NULL) {
            printf("%s: cannot be opened\n", argv[number]);
            return 2;
        }
        whole = replay(&state, sealed, sizeof sealed, read_file, NULL, &result);
        (void)fclose(file);
        if (!whole) {
            printf("%s: broken off, code %u\n", argv[number], (unsigned)result.code);
            return 2;
        }
        if (result.identical != result.cycles) {
            printf("%s: cycle %u is the first that differs\n", argv[number], (unsigned)result.first_different);
        }
        identical += result.identical;
        cycles += result.cycles;
    }
    printf("decisions identical: %lu of %lu\n", identical, cycles);
    return identical == cycles ? 0 : 1;
}
