cimport cython

from .hold cimport Hold
from .motion cimport Motion

@cython.final
cdef class History:
    cdef Motion motion
    cdef double evaluations, new_in, new_out, rate_in, rate_out, speed_in, speed_out, acceleration_in, acceleration_out

    @cython.locals(m=Motion, degree=double, rate_in=double, rate_out=double,
                   slope_in=double, slope_out=double, w3=double, points=double, raised=bint, side=int, at=int,
                   torque=Hold, slope=double, u1=double, m1=double, u2=double, m2=double)
    cdef double hold(self, double[::1] z, double* y, double h)
    @cython.locals(i=int)
    cdef void push(self, double[::1] z, double h, double points)
