cimport cython

from .motion cimport Motion

cdef extern from "math.h":
    double fabs(double x) noexcept
    double floor(double x) noexcept
    double pow(double x, double y) noexcept
    double sqrt(double x) noexcept
    bint isfinite(double x) noexcept

cdef enum:
    DONE = 0
    STEP_TOO_SMALL = 1
    NOT_FINITE = 2
    TOO_MANY_STEPS = 3

cdef double SAFETY, PREVIOUS, PRESENT, LARGEST_CUT, LARGEST_GROWTH, LOCAL, SMALLEST_STEP, MOST_STEPS, INFINITE, TURN, TURN_REST

@cython.locals(big=double, a1=double, a2=double, b1=double, b2=double)
cdef double product_rest(double a, double b) noexcept

@cython.final
cdef class Integrator:
    cdef Motion motion
    cdef double y[5]
    cdef double z[5]
    cdef double f[60]
    cdef double nodes[12]
    cdef double values[50]
    cdef int columns[50]
    cdef int starts[13]
    cdef double b[12]
    cdef double e5[12]
    cdef double e3[12]
    cdef double carry, turns, h, previous_error, steps, evaluations, rejected, tolerance, twist_floor

    @cython.locals(y='double*', z='double*', f='double*', values='double*', columns='int*', starts='int*', i=int, j=int,
                   o=int, a=double, d0=double, d1=double, d2=double, d3=double)
    cdef void stages(self, double s, double h)
    @cython.locals(y='double*', z='double*', f='double*', m=int, j=int, big=double, sum5=double, sum3=double, d=double,
                   error5=double, error3=double, slope=double, scale=double, spread=double, error=double)
    cdef double combine(self, double h)
    @cython.locals(y='double*', z='double*')
    cdef void accept(self) noexcept
    @cython.locals(turns=double, whole=double)
    cdef void add_angle(self, double increment) noexcept
    @cython.locals(before=double, step=double, total=double, kept=double)
    cdef void shift(self, double increment) noexcept
    @cython.locals(s=double, left=double, h=double, reach=double, begin=double, error=double, factor=double, last_rejected=bint,
                   fresh=bint, fitted=bint)
    cdef int run(self, double span)
    cdef double attempt(self, double s, double h)
