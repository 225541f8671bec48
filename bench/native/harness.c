/* Times one block of calls of one peer. Independent: state after state. Chained: each call waits for the one before,
 * since V and every phase of its record take a vanishing part of the last result. */
#define _POSIX_C_SOURCE 199309L
#include <time.h>

typedef void (*work)(const double *record, double *out);

static volatile double vanishing = 1e-250;

static double now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

/* Nanoseconds of a call. */
double independent(work f, double *records, int size, int count, int calls, double *out)
{
    int    i, k = 0;
    double start;

    f(records, out);
    start = now();
    for (i = 0; i < calls; ++i) {
        f(records + k * size, out);
        k = k + 1 == count ? 0 : k + 1;
    }
    return (now() - start) / calls;
}

double chained(work f, double *records, int size, int count, int calls, double *out, int V, int phi, int flywheels)
{
    const double part = vanishing;
    int          i, s, k = 0;
    double       start;

    f(records, out);
    start = now();
    for (i = 0; i < calls; ++i) {
        double      *record = records + k * size;
        const double last = part * out[0];
        record[V] += last;
        for (s = 0; s < flywheels; ++s) { record[phi + s] += last; }
        f(record, out);
        k = k + 1 == count ? 0 : k + 1;
    }
    return (now() - start) / calls;
}
