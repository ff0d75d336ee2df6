cimport cython

from .bundle cimport Bundle
from .integrator cimport Integrator
from .motion cimport Motion

cdef extern from "math.h":
    double atan2(double y, double x) noexcept
    double fabs(double x) noexcept
    double pow(double x, double y) noexcept
    double sqrt(double x) noexcept
    bint isfinite(double x) noexcept

cdef enum:
    MOST_COLUMNS = 7
    WIDTH = 32

cdef double FINEST_STEP

@cython.final
cdef class Variation:
    cdef Bundle bundle
    cdef Integrator integrator
    cdef double y[32]
    cdef double z[32]
    cdef double scale[32]
    cdef double f[384]
    cdef int places[50]
    cdef int width, watched
    cdef double fast, s, h, previous_error
    cdef public double tolerance, most_steps
    cdef readonly double rotation, steps

    @cython.locals(b=Bundle, y='double*', m=Motion, j=int, i=int, kind=int, count=int, fast=double)
    cpdef start(self, double p, double twist, double w1, double wy, columns)
    @cython.locals(y='double*', z='double*', f='double*', it=Integrator, i=int, first=int, last=int, m=int, d=double,
                   j=int)
    cdef void stages(self, double h)
    @cython.locals(y='double*', scale='double*', fast=double, speed=double, o=int, size=double, least=double)
    cdef void measure(self) noexcept
    @cython.locals(z='double*', f='double*', it=Integrator, sum5=double, sum3=double, total=double, m=int, d=double,
                   error5=double, error3=double, j=int, slope=double, spread=double, error=double)
    cdef double combine(self, double h)
    cdef double attempt(self, double h)
    @cython.locals(y='double*', f='double*', o=int, a0=double, b0=double, a1=double, b1=double, m=int)
    cdef void accept(self, double h) noexcept
    @cython.locals(span=double, rejected=bint, left=double, h=double, reach=double, fitted=bint, error=double,
                   factor=double)
    cpdef int run(self, double end)
    @cython.locals(i=int)
    cpdef values(self)
    @cython.locals(i=int)
    cpdef rates(self)
