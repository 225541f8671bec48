/* Calls works of a peer's library under callgrind, one dump of counters a work: count LIBRARY MODEL INPUT WORK...
 * INPUT: one flat input, binary. The first dump holds an empty work, which the others are counted against. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <valgrind/callgrind.h>

typedef void (*work)(const double *record, double *out);

static void nothing(const double *record, double *out) { (void)record; (void)out; }

static void *symbol(void *library, const char *name)
{
    void *found = dlsym(library, name);

    if (found == NULL) {
        fprintf(stderr, "no %s\n", name);
        exit(1);
    }
    return found;
}

static void counted(work f, const double *record, double *out, const char *name)
{
    CALLGRIND_ZERO_STATS;
    f(record, out);
    CALLGRIND_DUMP_STATS_AT(name);
}

int main(int argc, char **argv)
{
    static double flat[4096], out[1 << 20];
    void         *library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    FILE         *file = fopen(argv[3], "rb");
    double       *record;
    int           i;

    if (library == NULL || file == NULL || fread(flat, sizeof *flat, 4096, file) == 0) {
        fprintf(stderr, "%s\n", library == NULL ? dlerror() : argv[3]);
        return 1;
    }
    if (((int (*)(const char *))symbol(library, "peer_setup"))(argv[2]) != 0) { return 1; }
    record = calloc((size_t)((int (*)(void))symbol(library, "peer_size"))(), sizeof *record);
    ((void (*)(const double *, double *))symbol(library, "peer_pack"))(flat, record);
    for (i = 4; i < argc; ++i) { ((work)symbol(library, argv[i]))(record, out); } /* warm: nothing is bound late */
    CALLGRIND_START_INSTRUMENTATION;
    counted(nothing, record, out, "nothing");
    counted(nothing, record, out, "nothing");
    for (i = 4; i < argc; ++i) { counted((work)symbol(library, argv[i]), record, out, argv[i]); }
    return 0;
}
