cimport cython

from .values cimport Values

cdef extern from "math.h":
    bint isfinite(double x) noexcept

cdef double HALF_PI, LOWEST_BEND

@cython.final
cdef class Driveline(Values):
    @cython.locals(z='double[::1]', result=int)
    cdef bint advance(self, double current_time, double step_size) except -1
    @cython.locals(z='double[::1]', total=double, i=int)
    cdef bint inputs_good(self, double h)
    @cython.locals(z='double[::1]', a0=double, a1=double, a2=double)
    cdef bint bend_good(self, int place, double h)
