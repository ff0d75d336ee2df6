cimport cython

cdef double LONGEST_STRETCH

@cython.final
cdef class Hold:
    cdef double slope, c0, c1, c2, c3, c4, c5
    cdef int degree

    cdef double rest(self, double s) noexcept
    cdef void line(self, double value, double rate, double slope, double speed) noexcept
    @cython.locals(u=double, m=double, q=double, f2=double, f3=double)
    cdef bint hermite3(self, double step, double d, double u1, double m1) noexcept
    @cython.locals(e=double, u=double, m=double, q01=double, q12=double, a001=double, a011=double, a112=double,
                   a122=double, b0011=double, b0112=double, b1122=double, d00112=double, d01122=double,
                   f3=double, f4=double, f5=double)
    cdef bint hermite5(self, double step, double d, double u1, double m1, double d2, double u2, double m2) noexcept
