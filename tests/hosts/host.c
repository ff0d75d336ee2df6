/* An importer that knows no Python: it loads an FMI 2.0 co-simulation FMU by its C functions alone.
 *
 *     host LIBRARY RESOURCES GUID MODE COUNT < job
 *
 * The job: "START n" and n lines "r|i reference value"; "INPUTS a b"; "OUTPUTS n" and n references.
 * Modes: run      COUNT steps of 1 ms; prints the outputs of each in hexadecimal
 *        time     COUNT batches of steps; prints the fastest in microseconds per step (set 2, step, get the outputs)
 *        threads  COUNT instances, each in a thread of its own; prints the last outputs of each
 *        cycles   COUNT times load, run, free, unload; prints the memory after each tenth of them in kB
 */
#include <dlfcn.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

typedef unsigned int reference;
typedef int status;
typedef struct {
    void (*logger)(void *, const char *, status, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, status);
    void *environment;
} callbacks;

typedef struct {
    void *library;
    void *(*instantiate)(const char *, int, const char *, const char *, const callbacks *, int, int);
    void (*free_instance)(void *);
    status (*setup)(void *, int, double, double, int, double);
    status (*enter)(void *);
    status (*leave)(void *);
    status (*terminate)(void *);
    status (*set_real)(void *, const reference *, size_t, const double *);
    status (*set_integer)(void *, const reference *, size_t, const int *);
    status (*get_real)(void *, const reference *, size_t, double *);
    status (*step)(void *, double, double, int);
} fmu;

#define MOST 200
static const char *path, *resources, *guid;
static int starts, outputs;
static char kind[MOST];
static reference start[MOST], input[2], output[MOST];
static double value[MOST];
static int quiet = 1;

static void fail(const char *what) {
    fprintf(stderr, "host: %s\n", what);
    exit(3);
}

static void say(void *environment, const char *name, status level, const char *category, const char *text, ...) {
    (void)environment; (void)name; (void)category;
    if (!quiet || level > 1) fprintf(stderr, "message %d: %s\n", level, text);
}

static const callbacks calls = {say, calloc, free, NULL, NULL};

static void *symbol(void *library, const char *name) {
    void *found = dlsym(library, name);
    if (!found) fail(name);
    return found;
}

static fmu load(void) {
    fmu f;
    f.library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!f.library) fail(dlerror());
    *(void **)&f.instantiate = symbol(f.library, "fmi2Instantiate");
    *(void **)&f.free_instance = symbol(f.library, "fmi2FreeInstance");
    *(void **)&f.setup = symbol(f.library, "fmi2SetupExperiment");
    *(void **)&f.enter = symbol(f.library, "fmi2EnterInitializationMode");
    *(void **)&f.leave = symbol(f.library, "fmi2ExitInitializationMode");
    *(void **)&f.terminate = symbol(f.library, "fmi2Terminate");
    *(void **)&f.set_real = symbol(f.library, "fmi2SetReal");
    *(void **)&f.set_integer = symbol(f.library, "fmi2SetInteger");
    *(void **)&f.get_real = symbol(f.library, "fmi2GetReal");
    *(void **)&f.step = symbol(f.library, "fmi2DoStep");
    return f;
}

static void *begin(const fmu *f, const char *name) {
    void *instance = f->instantiate(name, 1, guid, resources, &calls, 0, 1);
    int i;
    if (!instance) fail("fmi2Instantiate gave no instance");
    if (f->setup(instance, 0, 0.0, 0.0, 0, 0.0) > 1) fail("fmi2SetupExperiment");
    for (i = 0; i < starts; i++) {
        if (kind[i] == 'r') {
            if (f->set_real(instance, &start[i], 1, &value[i]) > 1) fail("fmi2SetReal");
        } else {
            int whole = (int)value[i];
            if (f->set_integer(instance, &start[i], 1, &whole) > 1) fail("fmi2SetInteger");
        }
    }
    if (f->enter(instance) > 1 || f->leave(instance) > 1) fail("initialization");
    return instance;
}

static void step(const fmu *f, void *instance, int i, double *seen) {
    double torques[2];
    torques[0] = 200.0 - 10.0 * (i % 7);
    torques[1] = 50.0 + 5.0 * (i % 3);
    if (f->set_real(instance, input, 2, torques) > 1) fail("fmi2SetReal");
    if (f->step(instance, i * 1e-3, 1e-3, 1) > 1) fail("fmi2DoStep");
    if (f->get_real(instance, output, outputs, seen) > 1) fail("fmi2GetReal");
}

static void print(const double *seen) {
    int i;
    for (i = 0; i < outputs; i++) printf("%a%c", seen[i], i + 1 < outputs ? ' ' : '\n');
}

static void end(const fmu *f, void *instance) {
    f->terminate(instance);
    f->free_instance(instance);
}

static void run(int count) {
    fmu f = load();
    void *instance;
    double seen[MOST];
    int i;
    quiet = 0;
    instance = begin(&f, "host");
    for (i = 0; i < count; i++) {
        step(&f, instance, i, seen);
        print(seen);
    }
    end(&f, instance);
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void measure(int count) {
    fmu f = load();
    void *instance = begin(&f, "host");
    double seen[MOST], best = 1e9;
    int batch, i, n = 0;
    for (batch = 0; batch < count; batch++) {
        double before = now(), took;
        for (i = 0; i < 200; i++) step(&f, instance, n++, seen);
        took = (now() - before) / 200 * 1e6;
        if (took < best) best = took;
    }
    printf("%.3f\n", best);
    end(&f, instance);
}

typedef struct {
    const fmu *f;
    int number;
    double seen[MOST];
} task;

static void *work(void *given) {
    task *t = given;
    char name[20];
    void *instance;
    int i;
    snprintf(name, sizeof name, "thread %d", t->number);
    instance = begin(t->f, name);
    for (i = 0; i < 200; i++) step(t->f, instance, i, t->seen);
    end(t->f, instance);
    return NULL;
}

static void threads(int count) {
    fmu f = load();
    pthread_t *thread = calloc(count, sizeof *thread);
    task *tasks = calloc(count, sizeof *tasks);
    /* The exporter ends its interpreter with the last instance: one stays alive. */
    void *first = begin(&f, "host");
    int i;
    for (i = 0; i < count; i++) {
        tasks[i].f = &f;
        tasks[i].number = i;
        if (pthread_create(&thread[i], NULL, work, &tasks[i])) fail("pthread_create");
    }
    for (i = 0; i < count; i++) pthread_join(thread[i], NULL);
    for (i = 0; i < count; i++) print(tasks[i].seen);
    end(&f, first);
}

static long memory(void) {
    long pages = 0, resident = 0;
    FILE *stream = fopen("/proc/self/statm", "r");
    if (!stream || fscanf(stream, "%ld %ld", &pages, &resident) != 2) fail("/proc/self/statm");
    fclose(stream);
    return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

static void cycles(int count) {
    double seen[MOST], first[MOST];
    int i;
    for (i = 0; i < count; i++) {
        fmu f = load();
        void *instance = begin(&f, "host");
        step(&f, instance, 0, seen);
        if (i == 0) memcpy(first, seen, sizeof seen);
        if (memcmp(first, seen, outputs * sizeof *seen)) fail("a later cycle gives other values");
        end(&f, instance);
        dlclose(f.library);
        if ((i + 1) % (count / 10) == 0) printf("%ld\n", memory());
    }
}

int main(int count, char **argument) {
    int i;
    if (count != 6) fail("usage: host LIBRARY RESOURCES GUID MODE COUNT");
    path = argument[1];
    resources = argument[2];
    guid = argument[3];
    if (scanf(" START %d", &starts) != 1 || starts > MOST) fail("START");
    for (i = 0; i < starts; i++)
        if (scanf(" %c %u %lf", &kind[i], &start[i], &value[i]) != 3) fail("start value");
    if (scanf(" INPUTS %u %u OUTPUTS %d", &input[0], &input[1], &outputs) != 3 || outputs > MOST) fail("INPUTS");
    for (i = 0; i < outputs; i++)
        if (scanf(" %u", &output[i]) != 1) fail("output");
    i = atoi(argument[5]);
    if (!strcmp(argument[4], "run")) run(i);
    else if (!strcmp(argument[4], "time")) measure(i);
    else if (!strcmp(argument[4], "threads")) threads(i);
    else if (!strcmp(argument[4], "cycles")) cycles(i);
    else fail("no such mode");
    return 0;
}
