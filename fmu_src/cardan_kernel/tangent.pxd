cimport cython

from .bends cimport Bends
from .joint cimport Joint
from .motion cimport Motion

@cython.final
cdef class Tangent:
    cdef Motion motion
    cdef Bends bends1, bends2
    cdef double dp, dtwist, dw1, dwa, dwy, dw3, dangle, adw1, adwa, adwy, adw3, dts, dtin, dtout

    @cython.locals(m=Motion)
    cdef void take(self) noexcept
    @cython.locals(m=Motion, one=Joint, two=Joint, r1=double, r2=double, dr1=double, dwa=double, dx=double, dr2=double,
                   dw3=double, dbias1=double, dbias2=double, dm1=double, dm2=double, dbefore=double, dbehind=double,
                   mass=double, adwa=double, adwy=double, dts=double)
    cdef void along(self, double dp, double dtwist, double dw1, double dwy, double dtin, double dtout,
                    double adw1) noexcept
    cdef void state_column(self, double* column, int place) noexcept
    @cython.locals(m=Motion)
    cdef void output_column(self, double* column, int place) noexcept
