// Numbers of lines at once, before and after their transforms.
#pragma once

#include "fourier.hpp"

namespace viscontact {

template <class Real>
INLINED void clear(Real *number) {
    for (int l = 0; l < NUMBERS<Real>; ++l) number[l] = 0;
}

// Waves k and length - k of cosine transforms, of the Fourier transforms of lines in their order.
template <class Real>
INLINED void to_cosines(const Real *APART a, const Real *APART b, const Real *turn, Real *APART one,
                        Real *APART other) {
    constexpr int V = LINES<Real>;
    const Real re = Real(0.5) * turn[0], im = Real(0.5) * turn[1];
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        const Real p_re = re * a[l] - im * a[V + l], p_im = re * a[V + l] + im * a[l];
        const Real q_re = re * b[l] + im * b[V + l], q_im = re * b[V + l] - im * b[l];
        one[l] = p_re + q_re;
        one[V + l] = p_im + q_im;
        other[l] = q_im - p_im;
        other[V + l] = p_re - q_re;
    }
}

// The inverse, with real and imaginary parts exchanged: the transform of these is the inverse one.
template <class Real>
INLINED void of_cosines(const Real *APART one, const Real *APART other, const Real *turn,
                        Real *APART a, Real *APART b) {
    constexpr int V = LINES<Real>;
    const Real re = turn[0], im = turn[1];
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        const Real p_re = one[l] + other[V + l], p_im = one[V + l] - other[l];
        const Real q_re = one[l] - other[V + l], q_im = one[V + l] + other[l];
        a[l] = re * p_im - im * p_re;
        a[V + l] = re * p_re + im * p_im;
        b[l] = re * q_im + im * q_re;
        b[V + l] = re * q_re - im * q_im;
    }
}

template <class Real>
INLINED void exchange(const Real *APART from, Real *APART to) {
    constexpr int V = LINES<Real>;
    for (int l = 0; l < V; ++l) {
        to[l] = from[V + l];
        to[V + l] = from[l];
    }
}

// Waves of two real lines, of the transform of one plus i times the other: a wave and its mirror
// image to the real and the imaginary parts of both lines.
template <class Real>
INLINED void to_reals(const Real *APART a, const Real *APART b, Real *APART re, Real *APART im) {
    constexpr int V = LINES<Real>;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        re[l] = Real(0.5) * (a[l] + b[l]);
        re[V + l] = Real(0.5) * (a[V + l] + b[V + l]);
        im[l] = Real(0.5) * (a[V + l] - b[V + l]);
        im[V + l] = Real(0.5) * (b[l] - a[l]);
    }
}

// The inverse, with real and imaginary parts exchanged.
template <class Real>
INLINED void of_reals(const Real *APART re, const Real *APART im, Real *APART a, Real *APART b) {
    constexpr int V = LINES<Real>;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        b[l] = re[V + l] - im[l];
        b[V + l] = re[l] + im[V + l];
        a[l] = im[l] + re[V + l];
        a[V + l] = re[l] - im[V + l];
    }
}

template <class Real, class Given>
INLINED void load(const Given *from, std::ptrdiff_t count, double size, Real *to) {
    constexpr int N = NUMBERS<Real>;
    if (count < N) {
        for (int l = 0; l < N; ++l)
            to[l] = l < count ? static_cast<Real>(size == 1 ? from[l] : from[l] / size) : Real(0);
    } else if (size == 1) {
#pragma omp simd
        for (int l = 0; l < N; ++l) to[l] = static_cast<Real>(from[l]);
    } else {
#pragma omp simd
        for (int l = 0; l < N; ++l) to[l] = static_cast<Real>(from[l] / size);
    }
}

// Of numbers whose real and imaginary parts are exchanged.
template <class Real, class Found>
INLINED void store(const Real *from, std::ptrdiff_t count, Found factor, Found *to) {
    constexpr int V = LINES<Real>;
    if (count < 2 * V) {
        for (int l = 0; l < count; ++l) to[l] = factor * from[l < V ? V + l : l - V];
        return;
    }
#pragma omp simd
    for (int l = 0; l < V; ++l) to[l] = factor * from[V + l];
#pragma omp simd
    for (int l = 0; l < V; ++l) to[V + l] = factor * from[l];
}

}  // namespace viscontact
