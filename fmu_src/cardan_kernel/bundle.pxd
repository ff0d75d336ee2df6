cimport cython

from .law cimport Law
from .motion cimport Motion
from .stepper cimport Stepper
from .tangent cimport Tangent

cdef enum:
    POINT_IN = 9
    POINT_OUT = 152

@cython.final
cdef class Bundle:
    cdef Stepper stepper
    cdef Motion motion
    cdef Tangent tangent
    cdef Law law_in, law_out
    cdef double column[19]
    cdef int kinds[7]
    cdef int count
    cdef readonly double evaluations
    cdef bint stale

    cpdef put(self, int reference, double value)
    @cython.locals(law=Law)
    cpdef load(self, bint output, double c0, double c1, double c2)
    @cython.locals(law=Law)
    cpdef load_series(self, bint output, double order, list rest, list gain)
    @cython.locals(z='double[::1]')
    cdef void prepare(self)
    @cython.locals(m=Motion, law_in=Law, law_out=Law, w3=double)
    cdef void torques(self, double s, double p, double twist, double w1, double wy) noexcept
    @cython.locals(m=Motion, t=Tangent, j=int, o=int, kind=int)
    cdef void slopes(self, double s, double* y, double* f, int place) noexcept
    @cython.locals(m=Motion, t=Tangent, i=int, j=int, k=int, a=int, o=int)
    cpdef fields(self, double[::1] points, double[::1] values, int count)
