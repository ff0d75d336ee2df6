cimport cython

from .history cimport History
from .integrator cimport Integrator
from .motion cimport Motion
from .tangent cimport Tangent

cdef extern from "math.h":
    double fabs(double x) noexcept
    double pow(double x, double y) noexcept

@cython.final
cdef class Stepper:
    cdef readonly object store
    cdef double[::1] z
    cdef Motion motion
    cdef Integrator integrator
    cdef Tangent tangent
    cdef double column[16]
    cdef History history

    @cython.locals(z='double[::1]', m=Motion, fast=double)
    cdef void configure(self)
    @cython.locals(z='double[::1]', m=Motion, y='double*', i=int, fast=double)
    cdef void start(self)
    cdef void forget_outputs(self)
    @cython.locals(z='double[::1]', m=Motion, it=Integrator, y='double*', v0=double, points=double, i=int, result=int)
    cdef int step(self, double h)
    @cython.locals(z='double[::1]', m=Motion, it=Integrator, y='double*', mean=double, i=int)
    cdef void remember(self, double h, double points)
    @cython.locals(y='double*', i=int)
    cdef void look(self)
    cdef void refresh(self, int group)
    @cython.locals(z='double[::1]', m=Motion, i=int, j=int)
    cdef list columns(self)
