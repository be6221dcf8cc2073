// Complex Fourier transforms of many lines at once, one line for each place of a vector.
#pragma once

#include <cstddef>
#include <vector>

#include "fields.hpp"

#if defined(_MSC_VER)
#define INLINED __forceinline
#define APART __restrict
#else
#define INLINED inline __attribute__((always_inline))
#define APART __restrict__
#endif

namespace viscontact {

// Lines that are transformed at once: 64 bytes of numbers.
template <class Real>
constexpr int LINES = static_cast<int>(64 / sizeof(Real));

// A complex number of each line: all real parts, then all imaginary parts.
template <class Real>
constexpr int NUMBERS = 2 * LINES<Real>;

// Parts of the numbers before a transform, or of those after it, that are not zero or not needed.
enum class Part { ALL, FIRST_HALF, OUTER_QUARTERS };

// A pass through the numbers of lines: butterflies of a radix, `count` of them at a distance.
struct Pass {
    int radix;
    std::ptrdiff_t count, distance;
    std::size_t factors;  // place of the first of its factors
};

// Passes of transforms of a length without prime factors but 2, 3 and 5 (Stockham's order).
template <class Real>
class Passes {
  public:
    Passes(std::ptrdiff_t length, bool four_last);

    std::ptrdiff_t length() const { return length_; }

    const std::vector<Pass> &each() const { return passes_; }

    // Whether parts of the numbers are transformed one after the other, as all do not fit into the
    // fastest cache.
    bool is_parted() const { return length_ > LONGEST && passes_.size() > 1; }

    const Real *factors(const Pass &pass) const { return factors_.data() + pass.factors; }

  private:
    static constexpr std::ptrdiff_t LONGEST = 192;

    std::ptrdiff_t length_;
    std::vector<Pass> passes_;
    std::vector<Real> factors_;
};

namespace butterflies {

// A number and its factor, as it is written.
template <class Real>
INLINED void put(Real *to, int line, Real re, Real im, const Real *by) {
    to[line] = re * by[0] - im * by[1];
    to[LINES<Real> + line] = re * by[1] + im * by[0];
}

template <class Real>
INLINED void of_two(const Real *APART in, std::ptrdiff_t from, Real *APART out, std::ptrdiff_t to,
                    const Real *by) {
    constexpr int V = LINES<Real>;
    const Real *a = in, *b = in + from;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        out[l] = a[l] + b[l];
        out[V + l] = a[V + l] + b[V + l];
        put(out + to, l, a[l] - b[l], a[V + l] - b[V + l], by);
    }
}

template <class Real>
INLINED void of_three(const Real *APART in, std::ptrdiff_t from, Real *APART out, std::ptrdiff_t to,
                      const Real *by) {
    constexpr int V = LINES<Real>;
    constexpr Real SINE = static_cast<Real>(0.86602540378443864676);
    const Real *a = in, *b = in + from, *c = in + 2 * from;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        const Real sum_re = b[l] + c[l], sum_im = b[V + l] + c[V + l];
        const Real turn_re = SINE * (b[l] - c[l]), turn_im = SINE * (b[V + l] - c[V + l]);
        const Real re = a[l] - Real(0.5) * sum_re, im = a[V + l] - Real(0.5) * sum_im;
        out[l] = a[l] + sum_re;
        out[V + l] = a[V + l] + sum_im;
        put(out + to, l, re + turn_im, im - turn_re, by);
        put(out + 2 * to, l, re - turn_im, im + turn_re, by + 2);
    }
}

template <class Real>
INLINED void of_four(const Real *APART in, std::ptrdiff_t from, Real *APART out, std::ptrdiff_t to,
                     const Real *by) {
    constexpr int V = LINES<Real>;
    const Real *a = in, *b = in + from, *c = in + 2 * from, *d = in + 3 * from;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        const Real even_re = a[l] + c[l], even_im = a[V + l] + c[V + l];
        const Real odd_re = b[l] + d[l], odd_im = b[V + l] + d[V + l];
        const Real re = a[l] - c[l], im = a[V + l] - c[V + l];
        const Real turn_re = b[l] - d[l], turn_im = b[V + l] - d[V + l];
        out[l] = even_re + odd_re;
        out[V + l] = even_im + odd_im;
        put(out + to, l, re + turn_im, im - turn_re, by);
        put(out + 2 * to, l, even_re - odd_re, even_im - odd_im, by + 2);
        put(out + 3 * to, l, re - turn_im, im + turn_re, by + 4);
    }
}

// Of four numbers, of which the last two (1) or the middle ones (-1) are zero.
template <class Real>
INLINED void of_half_of_four(const Real *APART a, const Real *APART b, Real sign, Real *APART out,
                             std::ptrdiff_t to, const Real *by) {
    constexpr int V = LINES<Real>;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        const Real turn_re = sign * b[l], turn_im = sign * b[V + l];
        out[l] = a[l] + b[l];
        out[V + l] = a[V + l] + b[V + l];
        put(out + to, l, a[l] + turn_im, a[V + l] - turn_re, by);
        put(out + 2 * to, l, a[l] - b[l], a[V + l] - b[V + l], by + 2);
        put(out + 3 * to, l, a[l] - turn_im, a[V + l] + turn_re, by + 4);
    }
}

// The first number of four, and the second (1) or the last one (-1), without factors.
template <class Real>
INLINED void half_of_four(const Real *APART in, std::ptrdiff_t from, Real sign, Real *APART first,
                          Real *APART other) {
    constexpr int V = LINES<Real>;
    const Real *a = in, *b = in + from, *c = in + 2 * from, *d = in + 3 * from;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        first[l] = (a[l] + c[l]) + (b[l] + d[l]);
        first[V + l] = (a[V + l] + c[V + l]) + (b[V + l] + d[V + l]);
        other[l] = (a[l] - c[l]) + sign * (b[V + l] - d[V + l]);
        other[V + l] = (a[V + l] - c[V + l]) - sign * (b[l] - d[l]);
    }
}

template <class Real>
INLINED void of_five(const Real *APART in, std::ptrdiff_t from, Real *APART out, std::ptrdiff_t to,
                     const Real *by) {
    constexpr int V = LINES<Real>;
    constexpr Real C1 = static_cast<Real>(0.30901699437494742410),
                   C2 = static_cast<Real>(-0.80901699437494742410),
                   S1 = static_cast<Real>(0.95105651629515357212),
                   S2 = static_cast<Real>(0.58778525229247312917);
    const Real *a = in, *b = in + from, *c = in + 2 * from, *d = in + 3 * from, *e = in + 4 * from;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        const Real be_re = b[l] + e[l], be_im = b[V + l] + e[V + l];
        const Real cd_re = c[l] + d[l], cd_im = c[V + l] + d[V + l];
        const Real b_re = b[l] - e[l], b_im = b[V + l] - e[V + l];
        const Real c_re = c[l] - d[l], c_im = c[V + l] - d[V + l];
        const Real re1 = a[l] + C1 * be_re + C2 * cd_re, im1 = a[V + l] + C1 * be_im + C2 * cd_im;
        const Real re2 = a[l] + C2 * be_re + C1 * cd_re, im2 = a[V + l] + C2 * be_im + C1 * cd_im;
        const Real turn1_re = S1 * b_re + S2 * c_re, turn1_im = S1 * b_im + S2 * c_im;
        const Real turn2_re = S2 * b_re - S1 * c_re, turn2_im = S2 * b_im - S1 * c_im;
        out[l] = a[l] + be_re + cd_re;
        out[V + l] = a[V + l] + be_im + cd_im;
        put(out + to, l, re1 + turn1_im, im1 - turn1_re, by);
        put(out + 2 * to, l, re2 + turn2_im, im2 - turn2_re, by + 2);
        put(out + 3 * to, l, re2 - turn2_im, im2 + turn2_re, by + 4);
        put(out + 4 * to, l, re1 - turn1_im, im1 + turn1_re, by + 6);
    }
}

}  // namespace butterflies

// One butterfly of a pass: numbers at a distance `from` each other to numbers at a distance `to`.
template <class Real>
INLINED void butterfly(int radix, const Real *in, std::ptrdiff_t from, Real *out, std::ptrdiff_t to,
                       const Real *by) {
    if (radix == 4)
        butterflies::of_four(in, from, out, to, by);
    else if (radix == 2)
        butterflies::of_two(in, from, out, to, by);
    else if (radix == 3)
        butterflies::of_three(in, from, out, to, by);
    else
        butterflies::of_five(in, from, out, to, by);
}

// First pass of a transform of radix 4, of numbers of which half are zero. Of the numbers that it
// writes, those of a butterfly are `to` apart, and butterflies `step`.
template <class Real>
INLINED void pass_of_half(const Passes<Real> &passes, Part given, const Real *in, Real *out,
                          std::ptrdiff_t step, std::ptrdiff_t to) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const Pass &pass = passes.each().front();
    const Real *by = passes.factors(pass);
    const bool first = given == Part::FIRST_HALF;
    const std::ptrdiff_t other = (first ? 1 : 3) * pass.count * N;
    for (std::ptrdiff_t p = 0; p < pass.count; ++p, by += 6)
        butterflies::of_half_of_four(in + p * N, in + p * N + other, Real(first ? 1 : -1),
                                     out + p * step, to, by);
}

// First pass of a transform.
template <class Real>
INLINED void first_pass(const Passes<Real> &passes, Part given, const Real *in, Real *out,
                        std::ptrdiff_t step, std::ptrdiff_t to) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const Pass &pass = passes.each().front();
    if (given != Part::ALL) {
        pass_of_half(passes, given, in, out, step, to);
        return;
    }
    const Real *by = passes.factors(pass);
    for (std::ptrdiff_t p = 0; p < pass.count; ++p, by += 2 * (pass.radix - 1))
        butterfly(pass.radix, in + p * N, pass.count * N, out + p * step, to, by);
}

// Pass between the first and the last one, over a part of the numbers, one in `parts` of them.
template <class Real>
INLINED void inner_pass(const Passes<Real> &passes, const Pass &pass, int parts, const Real *in,
                        Real *out) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const Real *by = passes.factors(pass);
    const std::ptrdiff_t to = pass.distance / parts * N, from = pass.count * to;
    for (std::ptrdiff_t p = 0; p < pass.count; ++p, by += 2 * (pass.radix - 1))
        for (std::ptrdiff_t q = 0; q < to; q += N)
            butterfly(pass.radix, in + p * to + q, from, out + pass.radix * p * to + q, to, by);
}

// Last pass, whose results are one in `parts` of all.
template <class Real>
INLINED void last_pass(const Passes<Real> &passes, Part needed, int parts, const Real *in,
                       Real *out) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const Pass &pass = passes.each().back();
    const Real *by = passes.factors(pass);
    const std::ptrdiff_t from = pass.distance / parts * N, to = parts * from;
    const bool first = needed == Part::FIRST_HALF;
    for (std::ptrdiff_t q = 0; q < from; q += N) {
        Real *here = out + parts * q;
        if (needed == Part::ALL)
            butterfly(pass.radix, in + q, from, here, to, by);
        else
            butterflies::half_of_four(in + q, from, Real(first ? 1 : -1), here,
                                      here + (first ? 1 : 3) * to);
    }
}

// Transforms numbers in one of two buffers, and returns the one that holds the result; `spare` is a
// third one for long lines. Where half of the numbers is zero or half of the result is needed, the
// other half is not touched.
template <class Real>
INLINED Real *transformed(const Passes<Real> &passes, Real *in, Real *out, Real *spare, Part given,
                          Part needed) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const std::vector<Pass> &each = passes.each();
    if (each.empty()) return in;
    const Pass &begin = each.front();
    if (!passes.is_parted()) {
        first_pass(passes, given, in, out, begin.radix * N, N);
        for (std::size_t index = 1; index < each.size(); ++index) {
            std::swap(in, out);
            if (index + 1 == each.size())
                last_pass(passes, needed, 1, in, out);
            else
                inner_pass(passes, each[index], 1, in, out);
        }
        return out;
    }
    // What the first pass leaves are transforms of parts, one after the other in the cache.
    const std::ptrdiff_t part = begin.count * N;
    first_pass(passes, given, in, out, N, part);
    for (int k = 0; k < begin.radix; ++k) {
        Real *from = out + k * part, *to = spare;
        for (std::size_t index = 1; index + 1 < each.size(); ++index) {
            inner_pass(passes, each[index], begin.radix, from, to);
            std::swap(from, to);
        }
        last_pass(passes, needed, begin.radix, from, in + k * N);
    }
    return in;
}

}  // namespace viscontact
