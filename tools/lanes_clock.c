/* Least time of one call of forward and of coupled, ns: compiled with -DSTAND=name, -DHEADER="name.h", -DCALLS=n. */
#define _POSIX_C_SOURCE 199309L
#include HEADER

#include <math.h>
#include <stdio.h>
#include <time.h>

#define JOINED(a, b) a##b
#define JOIN(a, b) JOINED(a, b)
#define NAME(f) JOIN(STAND, f)

enum { STATES = 8, REPETITIONS = 30 };

static NAME(_state) states[STATES];
static double drive[FLYWHEELS], V_dot[6], phi_ddot[FLYWHEELS];
static int locked[FLYWHEELS];
volatile double sink;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double least(int coupled)
{
    double best = 1e9;
    for (int r = 0; r < REPETITIONS; ++r) {
        const double begin = seconds();
        for (int i = 0; i < CALLS; ++i) {
            const NAME(_state) *x = &states[i % STATES];
            const int status = coupled ? (int)NAME(_coupled)(&NAME(_default), x, drive, locked, V_dot, phi_ddot)
                                       : (int)NAME(_forward)(&NAME(_default), x, drive, V_dot);
            if (status < 0) {
                return -1.0;
            }
            sink = V_dot[0];
        }
        best = fmin(best, (seconds() - begin) / CALLS);
    }
    return 1e9 * best;
}

int main(void)
{
    unsigned seed = 1u;
    for (int k = 0; k < STATES; ++k) {
        states[k].attitude[0] = 1.0;
        for (int i = 0; i < 6; ++i) {
            states[k].V[i] = 0.1 * (i + 1) - 0.2;
        }
        for (int s = 0; s < FLYWHEELS; ++s) {
            seed = seed * 1664525u + 1013904223u;
            states[k].phi[s] = 6.0 * (seed / 4294967296.0) - 3.0;
            states[k].phi_dot[s] = 100.0 + s % 7;
            drive[s] = 0.01 * (s % 5 - 2);
        }
    }
    printf("%.1f\n", least(0));
    printf("%.1f\n", least(1));
    return 0;
}
