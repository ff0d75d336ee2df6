cimport cython

from .joint cimport Joint
from .motion cimport Motion

cdef void settle(Motion motion, double[::1] z, double* y) noexcept
cdef double momentum_out(Motion motion) noexcept
@cython.locals(behind=double)
cdef double momentum_in(Motion motion) noexcept
@cython.locals(one=Joint, two=Joint, first=double, second=double, energy=double, lead=double, kick1=double,
               kick2=double, behind=double, inertia=double, offset=double)
cdef void jump(Motion motion, double* y, double[::1] z, double v0, double a0, double a1, double a2, double b0,
               double b1, double b2) noexcept
