cimport cython

from .hold cimport Hold
from .joint cimport Joint

cdef extern from "math.h":
    double sin(double x) noexcept
    double cos(double x) noexcept
    double sqrt(double x) noexcept

@cython.final
cdef class Motion:
    cdef Joint joint1, joint2
    cdef Hold hold_in, hold_out
    cdef bint rigid, driven, moving, straight1, straight2
    cdef double j1, j2a, j2b, j3, k, d, c_in, c_out, offset
    cdef double w1, wa, wy, w3, dw1, dwa, dwy, dw3, ts, tin, tout, net_power, p, twist
    cdef double m1, m2, before, behind, bias1, bias2
    cdef double p0, v0, v1, v2, a0, a1, a2, b0, b1, b2

    cdef void steer(self, double p0, double v0, double v1, double v2) noexcept
    cdef void swing(self, double a0, double a1, double a2, double b0, double b1, double b2) noexcept
    cdef void unbend(self) noexcept
    cdef void bend(self, double s) noexcept
    @cython.locals(sp=double, cp=double, one=Joint, root=double, sa=double, ca=double, alpha=double, sd=double,
                   cd=double)
    cdef void turn(self, double p, double twist) noexcept
    @cython.locals(one=Joint, two=Joint, r1=double, r2=double, wa=double, w3=double, tin=double, tout=double,
                   m=double, slip=double)
    cdef void evaluate(self, double s, double p, double twist, double w1, double wy) noexcept
    cdef void derivative(self, double s, double* y, double* dy, int place) noexcept
    @cython.locals(longest=double, other=double)
    cdef double reach(self) noexcept
    @cython.locals(slip=double)
    cdef double loss(self) noexcept
    cdef double kinetic(self) noexcept
    cdef double strain(self) noexcept
    @cython.locals(behind=double, before=double, stiffness=double, damping=double, fast=double)
    cdef double frequency(self) noexcept
