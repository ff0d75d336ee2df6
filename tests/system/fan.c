/* An FMU of another author for the tests: a fan with lag, in the style of the Modelica Reference FMUs.
 *
 *     tau dM/dt = -k n |n| - M      n in rpm, M in N.m, negative where it brakes
 *
 * solved exactly for a held speed. Short names, native code, no state saving, messages through the logger.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef unsigned int reference;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} callbacks;

enum { K, TAU, N, M, COUNT };
typedef struct { double v[COUNT]; const callbacks *calls; char *name; } fan;

static void restart(fan *f) {
    f->v[K] = 1e-4;
    f->v[TAU] = 0.1;
    f->v[N] = f->v[M] = 0.0;
}

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const callbacks *calls,
                      int visible, int logging) {
    fan *f = calloc(1, sizeof *f);
    (void)resources; (void)visible; (void)logging;
    if (!f || type != 1 || strcmp(guid, "{fan}")) return NULL;
    f->calls = calls;
    f->name = strdup(name);
    restart(f);
    return f;
}

void fmi2FreeInstance(void *c) {
    if (c) free(((fan *)c)->name);
    free(c);
}

int fmi2SetReal(void *c, const reference *r, size_t n, const double *values) {
    size_t i;
    for (i = 0; i < n; i++) ((fan *)c)->v[r[i]] = values[i];
    return 0;
}

int fmi2GetReal(void *c, const reference *r, size_t n, double *values) {
    size_t i;
    for (i = 0; i < n; i++) values[i] = ((fan *)c)->v[r[i]];
    return 0;
}

int fmi2DoStep(void *c, double t, double h, int never_back) {
    fan *f = c;
    double end;
    (void)t; (void)never_back;
    if (f->v[N] > 9000.0) {
        f->calls->logger(f->calls->environment, f->name, 3, "error", "n = %g rpm: the blades have left", f->v[N]);
        return 3;
    }
    end = -f->v[K] * f->v[N] * fabs(f->v[N]);
    f->v[M] = end + (f->v[M] - end) * exp(-h / f->v[TAU]);
    return 0;
}

int fmi2Reset(void *c) { restart(c); return 0; }
int fmi2SetupExperiment(void *c, int a, double b, double d, int e, double f) {
    (void)c; (void)a; (void)b; (void)d; (void)e; (void)f; return 0;
}
#define FINE(name) int name(void *c) { (void)c; return 0; }
FINE(fmi2EnterInitializationMode)
FINE(fmi2ExitInitializationMode)
FINE(fmi2Terminate)
const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }

/* Not offered: every other function of FMI 2.0 answers with an error. */
#define ABSENT(name) int name(void) { return 3; }
ABSENT(fmi2SetDebugLogging) ABSENT(fmi2GetInteger) ABSENT(fmi2SetInteger) ABSENT(fmi2GetBoolean)
ABSENT(fmi2SetBoolean) ABSENT(fmi2GetString) ABSENT(fmi2SetString) ABSENT(fmi2GetFMUstate) ABSENT(fmi2SetFMUstate)
ABSENT(fmi2FreeFMUstate) ABSENT(fmi2SerializedFMUstateSize) ABSENT(fmi2SerializeFMUstate)
ABSENT(fmi2DeSerializeFMUstate) ABSENT(fmi2GetDirectionalDerivative) ABSENT(fmi2SetRealInputDerivatives)
ABSENT(fmi2GetRealOutputDerivatives) ABSENT(fmi2CancelStep) ABSENT(fmi2GetStatus) ABSENT(fmi2GetRealStatus)
ABSENT(fmi2GetIntegerStatus) ABSENT(fmi2GetBooleanStatus) ABSENT(fmi2GetStringStatus)
