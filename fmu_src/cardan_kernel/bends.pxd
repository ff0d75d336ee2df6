cimport cython

from .joint cimport Joint

cdef extern from "math.h":
    double sqrt(double x) noexcept

@cython.final
cdef class Bends:
    cdef double bias_p, bias_w, jcpp, drag_p, drag_w

    @cython.locals(c=double, s=double, sp=double, cp=double, D=double, d2=double, d3=double, both=double, s2=double,
                   twice=double, dD=double, b1=double, rpp=double, rbp=double, swell=double, gbp=double, ddD=double,
                   plane=double, lean=double, top=double, dtop=double, ddtop=double)
    cdef void take(self, Joint joint, double w) noexcept
    @cython.locals(D=double, root=double, sp=double, cp=double, b1=double, a=double, b=double, moment_a=double,
                   moment_b=double, slope_a=double, slope_b=double, v2=double, size_a=double, size_b=double,
                   along_a=double, along_b=double, along_ap=double, along_bp=double, a_p=double, b_p=double)
    cdef void take_friction(self, Joint joint, double w, double dD) noexcept
