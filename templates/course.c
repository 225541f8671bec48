/* course.c: many steps of n states in one call, for Python. It knows no stand: it calls NAME_arrays.c.
 *
 * What drives the flywheels comes as rows of numbers, one for each step. A flywheel of given speed has its phase and
 * speed set; any other turns under a torque, constant in a step: that of the middle, at a speed that is extrapolated
 * from the step before. Component i of state j is at [i * n + j]. REAL: double or float. */
#include <math.h>
#include <stddef.h>
#include <string.h>

typedef REAL real;

/* A function for arrays of n states, with what is passed to it. */
typedef struct call {
    int (*function)(size_t n, void *const passed[], int status[]);
    void *const *passed;
} call;

/* Torques (N m) at rising speeds (rad/s), joined by straight lines; beyond the ends they hold. */
typedef struct curve {
    int points;
    const double *speed;
    const double *torque;
} curve;

/* How torque depends on speed: a law, and a motor. */
typedef struct drive {
    curve delivered;      /* torque in place of a commanded one, not limited; no points: commanded */
    double to, band;      /* command tanh((to - speed) / band); band 0: the command itself */
    curve limit;          /* the most; no points: none */
    int by_sense;         /* is its speed that in the sense of the torque, and not the flywheel's? */
    double viscous, coulomb, coulomb_speed;
} drive;

/* What is kept of each moment of output: results of a call, or of none. */
typedef struct answer {
    call call;
    const void *from;
    char *to;
    size_t bytes;
} answer;

typedef struct course {
    size_t n, left;         /* states; those that are not refused */
    int flywheels, inputs;  /* `inputs` numbers of run-time wrenches */
    int by_torque, solves;  /* is any flywheel driven by torque; are accelerations needed at moments */
    int reacting;           /* first number of the wrench that takes the reaction to given accelerations; -1: none */
    int held;               /* a hold bears these accelerations besides */
    real *phi, *phi_dot, *phi_ddot, *tau, *wrench, *dt, *carry;
    const real *coupling;   /* I (6, N, n) of (8) */
    const int *given;       /* flywheels whose speed is given */
    const drive *const *drives; /* (N, n) */
    double *rate, *turned, *before; /* (N, n): rad/s2 in the step before; rad since the beginning; rad, rad/s */
    call step, matrices, solve, torque;
    const answer *answers;
    int many, numbers;      /* answers; numbers of a state */
    int *status, *where, *now;
    double *when;
} course;

/* Stretches of steps of equal length, each from one moment of output to the next. */
typedef struct rows {
    int stretches;
    const int *count;
    const double *begin, *length;         /* s: beginning of a stretch; length of its steps */
    const real *phi, *phi_dot;            /* count + 1 rows a stretch */
    const real *mean, *between, *halfway; /* rows a step: mean acceleration; speed that turns as far; phase half-way */
    const double *command;                /* torque commanded in the middle */
    const real *wrench;
    const real *end_phi_ddot, *end_wrench; /* rows a stretch, at its end */
    const double *end_command;
} rows;

enum { A_STEP, SOLVE, TORQUE, MATRICES, ANSWER };

int course_run(course *c, const rows *given);

static double on_curve(const curve *c, double speed)
{
    int k = 1;
    if (!(speed > c->speed[0])) { return c->torque[0]; }
    while (k < c->points && c->speed[k] < speed) { ++k; }
    if (k == c->points) { return c->torque[k - 1]; }
    const double part = (speed - c->speed[k - 1]) / (c->speed[k] - c->speed[k - 1]);
    return c->torque[k - 1] + part * (c->torque[k] - c->torque[k - 1]);
}

static double drive_torque(const drive *d, double command, double speed)
{
    double torque = command;
    if (d->delivered.points) {
        torque = on_curve(&d->delivered, speed);
    } else {
        if (d->band > 0.0) { torque *= tanh((d->to - speed) / d->band); }
        if (d->limit.points) {
            const double most = on_curve(&d->limit, d->by_sense && torque < 0.0 ? -speed : speed);
            torque = torque > most ? most : torque < -most ? -most : torque;
        }
    }
    torque -= d->viscous * speed;
    return d->coulomb > 0.0 ? torque - d->coulomb * tanh(speed / d->coulomb_speed) : torque;
}

static void fill(real to[], size_t n, const real row[], int count)
{
    for (int i = 0; i < count; ++i) {
        for (size_t j = 0; j < n; ++j) { to[(size_t)i * n + j] = row[i]; }
    }
}

static int same(const real one[], const real other[], int count)
{
    for (int i = 0; i < count; ++i) {
        if (one[i] < other[i] || one[i] > other[i]) { return 0; }
    }
    return 1;
}

/* Sets the numbers of flywheels of given speed. */
static void set(const course *c, real to[], const real row[])
{
    for (int s = 0; s < c->flywheels; ++s) {
        if (c->given[s]) { fill(to + (size_t)s * c->n, c->n, row + s, 1); }
    }
}

/* Calls a function; states that it refuses for the first time are noted. */
static void run(course *c, const call *f, int where, double t)
{
    if (f->function(c->n, f->passed, c->now) >= 0) { return; }
    for (size_t j = 0; j < c->n; ++j) {
        if (c->now[j] < 0 && c->status[j] >= 0) {
            c->status[j] = c->now[j];
            c->where[j] = where;
            c->when[j] = t;
            --c->left;
        }
    }
}

/* Adds -sum I_s phi_s'' of (8) to the wrench on the carrier: a known acceleration is a term without unknowns there. */
static void react(course *c, const real accelerations[], double t)
{
    run(c, &c->matrices, MATRICES, t);
    for (int s = 0; s < c->flywheels; ++s) {
        if (!c->given[s] || !(accelerations[s] < 0 || accelerations[s] > 0)) { continue; }
        for (int i = 0; i < 6; ++i) {
            real *const to = c->wrench + (size_t)(c->reacting + i) * c->n;
            const real *const I = c->coupling + (size_t)(i * c->flywheels + s) * c->n;
            for (size_t j = 0; j < c->n; ++j) { to[j] -= I[j] * accelerations[s]; }
        }
    }
}

/* Torques at the speeds `ahead` seconds later; zero of flywheels of given speed. */
static void set_torques(course *c, const double command[], double ahead)
{
    for (int s = 0; s < c->flywheels; ++s) {
        const size_t at = (size_t)s * c->n;
        for (size_t i = at; i < at + c->n; ++i) {
            const double speed = (double)c->phi_dot[i] + ahead * c->rate[i];
            c->tau[i] = c->given[s] ? (real)0 : (real)drive_torque(c->drives[i], command[s], speed);
        }
    }
}

/* What was set has lost nothing by rounding. */
static void forget_rounding(course *c)
{
    for (size_t j = 0; c->carry && j < c->n; ++j) {
        real *const lost = c->carry + j * (size_t)c->numbers + (c->numbers - 2 * c->flywheels);
        for (int s = 0; s < c->flywheels; ++s) {
            if (c->given[s]) { lost[s] = lost[s + c->flywheels] = 0; }
        }
    }
}

static void step_by_torque(course *c, const rows *r, double t, double h)
{
    const int N = c->flywheels;
    const size_t all = (size_t)N * c->n;
    double *const before = c->before, *const phase = c->before + all;
    for (size_t i = 0; i < all; ++i) {
        before[i] = (double)c->phi_dot[i];
        phase[i] = (double)c->phi[i];
    }
    set_torques(c, r->command, h / 2);
    if (c->reacting >= 0) {
        set(c, c->phi, r->halfway);
        react(c, r->mean, t);
    }
    set(c, c->phi, r->phi);
    set(c, c->phi_dot, r->between);
    forget_rounding(c);
    run(c, &c->step, A_STEP, t);
    set(c, c->phi, r->phi + N);
    set(c, c->phi_dot, r->phi_dot + N);
    for (size_t i = 0; i < all; ++i) {
        const double after = (double)c->phi_dot[i], turned = (double)c->phi[i] - phase[i];
        const double turn = 6.283185307179586;
        c->rate[i] = (after - before[i]) / h;
        c->turned[i] += turned + turn * rint((h * (before[i] + after) / 2 - turned) / turn);
    }
}

/* `first`: is it the first step of a stretch? */
static void step_by_speed(course *c, const rows *r, double t, int first)
{
    const int N = c->flywheels;
    int still = 1;
    if (N && (first || !same(r->mean, r->mean - N, N))) { fill(c->phi_ddot, c->n, r->mean, N); }
    forget_rounding(c);
    run(c, &c->step, A_STEP, t);
    fill(c->phi, c->n, r->phi + N, N);
    /* without acceleration a step leaves the speeds as they are */
    for (int s = 0; s < N; ++s) { still = still && !(r->mean[s] < 0 || r->mean[s] > 0); }
    if (!still || !same(r->phi_dot, r->phi_dot + N, N)) { fill(c->phi_dot, c->n, r->phi_dot + N, N); }
}

/* Accelerations and torques at the end of a stretch, then the answers, which are number `k`. */
static void moment(course *c, const rows *r, double t, size_t k)
{
    fill(c->wrench, c->n, r->end_wrench, c->inputs);
    if (c->solves) {
        int lacks = !c->by_torque;
        if (c->by_torque) {
            if (c->reacting >= 0) { react(c, r->end_phi_ddot, t); }
            set_torques(c, r->end_command, 0.0);
            run(c, &c->solve, SOLVE, t);
            for (int s = 0; s < c->flywheels; ++s) { lacks = lacks || c->given[s]; }
            for (size_t i = 0; lacks && i < (size_t)c->flywheels * c->n; ++i) { c->before[i] = (double)c->tau[i]; }
            set(c, c->phi_ddot, r->end_phi_ddot);
        } else {
            fill(c->phi_ddot, c->n, r->end_phi_ddot, c->flywheels);
            run(c, &c->solve, SOLVE, t);
        }
        if (lacks && c->torque.function) {
            run(c, &c->torque, TORQUE, t);
            for (int s = 0; c->by_torque && s < c->flywheels; ++s) {
                const size_t at = (size_t)s * c->n;
                for (size_t i = at; !c->given[s] && i < at + c->n; ++i) { c->tau[i] = (real)c->before[i]; }
            }
        }
        if (c->reacting >= 0 && c->held) { fill(c->wrench, c->n, r->end_wrench, c->inputs); }
    }
    for (int a = 0; a < c->many; ++a) {
        const answer *const of = &c->answers[a];
        if (of->call.function) { run(c, &of->call, ANSWER + a, t); }
        memcpy(of->to + k * of->bytes, of->from, of->bytes);
    }
}

/* Steps through all stretches. Returns how many moments are kept: fewer where every state is refused. */
int course_run(course *c, const rows *given)
{
    rows r = *given;
    const int N = c->flywheels;
    for (int k = 0; k < r.stretches; ++k) {
        const double h = r.length[k];
        *c->dt = (real)h;
        for (int i = 0; i < r.count[k]; ++i) {
            const double t = r.begin[k] + i * h;
            fill(c->wrench, c->n, r.wrench, c->inputs);
            if (c->by_torque) {
                step_by_torque(c, &r, t, h);
            } else {
                step_by_speed(c, &r, t, i == 0);
            }
            if (!c->left) { return k; }
            r.phi += N;
            r.phi_dot += N;
            r.mean += N;
            r.between += N;
            r.halfway += N;
            r.command += N;
            r.wrench += c->inputs;
        }
        r.phi += N;
        r.phi_dot += N;
        moment(c, &r, r.begin[k] + r.count[k] * h, (size_t)k);
        if (!c->left) { return k; }
        r.end_phi_ddot += N;
        r.end_command += N;
        r.end_wrench += c->inputs;
    }
    return r.stretches;
}
