#include "spectral_filter.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "line_spectra.hpp"

// Work on lines is compiled for newer processors as well; the vectors' length changes no number.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define FOR_WIDE_PROCESSORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FOR_WIDE_PROCESSORS
#endif

namespace viscontact {

namespace {

// Buffers for lines of a length.
template <class Real>
class Buffers {
  public:
    explicit Buffers(std::ptrdiff_t length) : size_(length * NUMBERS<Real>) {
        constexpr std::size_t ALIGNMENT = 64, SPARE = ALIGNMENT / sizeof(Real);
        memory_.reset(new Real[3 * size_ + SPARE]);
        const auto address = reinterpret_cast<std::uintptr_t>(memory_.get());
        first = memory_.get() + (-address % ALIGNMENT) / sizeof(Real);
        second = first + size_;
        third = second + size_;
    }

    Real *first, *second, *third;

  private:
    std::ptrdiff_t size_;
    std::unique_ptr<Real[]> memory_;
};

// Transforms numbers in one of the first two buffers; the same function for all stages.
template <class Real>
FOR_WIDE_PROCESSORS Real *transform(const Passes<Real> &passes, Real *in, Real *out,
                                    const Buffers<Real> &buffers, Part given, Part needed) {
    return transformed(passes, in, out, buffers.third, given, needed);
}

// Transforms columns from a place on along the first axis.
template <class Real, class Given>
FOR_WIDE_PROCESSORS void columns_there(const Axis<Real> &axis, const Field<Given> &field,
                                       std::ptrdiff_t column, double size, const Waves<Real> &waves,
                                       const Buffers<Real> &buffers) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const std::ptrdiff_t length = axis.length;
    Real *in = buffers.first;
    for (std::ptrdiff_t i = 0; i < axis.cells; ++i)
        load(field.row(i) + column, field.columns - column, size, in + axis.place(i) * N);
    for (std::ptrdiff_t i = axis.cells; i < axis.given(); ++i) clear(in + axis.place(i) * N);
    const Real *found = transform(axis.there, in, buffers.second, buffers, axis.data, Part::ALL);
    Real *to = waves.first + column;
    if (axis.even) std::copy(found, found + N, to);
    for (std::ptrdiff_t k = axis.even; 2 * k <= length; ++k) {
        const std::ptrdiff_t mirrored = (length - k) % length;
        const Real *a = found + k * N, *b = found + mirrored * N;
        Real *one = to + k * waves.distance, unused[N];
        Real *other = mirrored == k ? unused : to + mirrored * waves.distance;
        if (axis.even)
            to_cosines(a, b, &axis.turns[2 * k], one, other);
        else
            to_reals(a, b, one, one + waves.imaginary);
    }
    // Columns beyond the field would bring their rounding back, of numbers without the symbol.
    const std::ptrdiff_t count = field.columns - column;
    for (std::ptrdiff_t k = 0; count < N && k < axis.waves(); ++k) {
        std::fill(to + k * waves.distance + count, to + k * waves.distance + N, Real(0));
        if (axis.even) continue;
        Real *imaginary = to + k * waves.distance + waves.imaginary;
        std::fill(imaginary + count, imaginary + N, Real(0));
    }
}

template <class Real, class Found>
FOR_WIDE_PROCESSORS void columns_back(const Axis<Real> &axis, const Waves<Real> &waves,
                                      std::ptrdiff_t column, double factor,
                                      const Field<Found> &field, const Buffers<Real> &buffers) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const std::ptrdiff_t length = axis.length;
    const Real *from = waves.first + column;
    Real *in = buffers.first;
    if (axis.even) exchange(from, in);
    for (std::ptrdiff_t k = axis.even; 2 * k <= length; ++k) {
        const std::ptrdiff_t mirrored = (length - k) % length;
        const Real *one = from + k * waves.distance;
        Real unused[N];
        Real *b = mirrored == k ? unused : in + mirrored * N;
        if (axis.even)
            of_cosines(one, from + mirrored * waves.distance, &axis.turns[2 * k], in + k * N, b);
        else
            of_reals(one, one + waves.imaginary, in + k * N, b);
    }
    const Real *found = transform(axis.back, in, buffers.second, buffers, Part::ALL, axis.data);
    for (std::ptrdiff_t i = 0; i < axis.cells; ++i)
        store(found + axis.place(i) * N, field.columns - column, static_cast<Found>(factor),
              field.row(i) + column);
}

// Multiplies a number of lines by their symbols: of complex lines, or of two real ones in each
// place.
template <bool COMPLEX, class Real>
INLINED void multiply(Real *APART number, const Real *APART by) {
    constexpr int V = LINES<Real>;
#pragma omp simd
    for (int l = 0; l < V; ++l) {
        number[l] *= by[l];
        number[V + l] *= by[COMPLEX ? l : V + l];
    }
}

// Filters Fourier transforms of real lines, of two in each place of a vector.
template <class Real>
INLINED void filter_reals(const Axis<Real> &axis, const Real *symbol, const Real *given, Real *to) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    for (std::ptrdiff_t k = 0; 2 * k <= axis.length; ++k) {
        const std::ptrdiff_t mirrored = (axis.length - k) % axis.length;
        Real re[N], im[N], unused[N];
        to_reals(given + k * N, given + mirrored * N, re, im);
        multiply<false>(re, symbol + k * N);
        multiply<false>(im, symbol + k * N);
        of_reals(re, im, to + k * N, mirrored == k ? unused : to + mirrored * N);
    }
}

// Filters Fourier transforms of complex lines.
template <class Real>
INLINED void filter_complex(const Axis<Real> &axis, const Real *symbol, Real *given, Real *to) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    for (std::ptrdiff_t k = 0; k < axis.length; ++k, given += N) {
        multiply<true>(given, symbol + std::min(k, axis.length - k) * LINES<Real>);
        exchange(given, to + k * N);
    }
}

// Filters cosine transforms.
template <bool COMPLEX, class Real>
INLINED void filter_cosines(const Axis<Real> &axis, const Real *symbol, Real *given, Real *to) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>, AT_ONCE = COMPLEX ? LINES<Real> : N;
    Real one[N], other[N], unused[N];
    multiply<COMPLEX>(given, symbol);
    exchange(given, to);
    for (std::ptrdiff_t k = 1; 2 * k <= axis.length; ++k) {
        const std::ptrdiff_t mirrored = axis.length - k;
        const Real *turn = &axis.turns[2 * k];
        to_cosines(given + k * N, given + mirrored * N, turn, one, other);
        multiply<COMPLEX>(one, symbol + k * AT_ONCE);
        multiply<COMPLEX>(other, symbol + mirrored * AT_ONCE);
        of_cosines(one, other, turn, to + k * N, mirrored == k ? unused : to + mirrored * N);
    }
}

// Rows of waves that are filtered at once, and how many of them there are.
template <class Real>
struct Rows {
    std::array<Real *, NUMBERS<Real>> at;
    int count;
};

// Cells of a row that are copied at once: those of all rows stay in the cache.
constexpr std::ptrdiff_t COPIED = 64;

// Copies cells of a row to their places in vectors, or back.
template <bool BACK, class Real>
INLINED void copy_cells(const Axis<Real> &axis, std::ptrdiff_t begin, std::ptrdiff_t end, Real *row,
                        Real *line) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const auto copy = [](Real &ours, Real &theirs) { BACK ? ours = theirs : theirs = ours; };
    if (!axis.even) {
        for (std::ptrdiff_t j = begin; j < end; ++j) copy(row[j], line[j * N]);
        return;
    }
    Real *last = line + (axis.length - 1) * N;
    for (std::ptrdiff_t j = begin; j < end; j += 2) copy(row[j], line[j / 2 * N]);
    for (std::ptrdiff_t j = begin + 1; j < end; j += 2) copy(row[j], *(last - j / 2 * N));
}

// Rows to vectors.
template <class Real>
INLINED void gather(const Axis<Real> &axis, const Rows<Real> &rows, Real *to) {
    for (std::ptrdiff_t begin = 0; begin < axis.cells; begin += COPIED)
        for (int l = 0; l < NUMBERS<Real>; ++l)
            copy_cells<false>(axis, begin, std::min(axis.cells, begin + COPIED), rows.at[l],
                              to + l);
}

// Vectors, whose real and imaginary parts are exchanged, to rows.
template <class Real>
INLINED void scatter(const Axis<Real> &axis, const Rows<Real> &rows, bool complex, Real *from) {
    constexpr int N = NUMBERS<Real>, V = LINES<Real>;
    for (std::ptrdiff_t begin = 0; begin < axis.cells; begin += COPIED)
        for (int l = 0; l < N; ++l)
            if (l % (complex ? V : N) < rows.count)
                copy_cells<true>(axis, begin, std::min(axis.cells, begin + COPIED), rows.at[l],
                                 from + (l < V ? V + l : l - V));
}

// Filters rows of waves along the second axis.
template <class Real>
FOR_WIDE_PROCESSORS void filter_rows(const Axis<Real> &axis, const Rows<Real> &rows, bool complex,
                                     const Real *symbol, const Buffers<Real> &buffers) {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    Real *in = buffers.first;
    for (std::ptrdiff_t j = axis.cells; j < axis.given(); ++j) clear(in + axis.place(j) * N);
    gather(axis, rows, in);
    Real *given = transform(axis.there, in, buffers.second, buffers, axis.data, Part::ALL);
    Real *to = given == in ? buffers.second : in;
    if (axis.even && complex)
        filter_cosines<true>(axis, symbol, given, to);
    else if (axis.even)
        filter_cosines<false>(axis, symbol, given, to);
    else if (complex)
        filter_complex(axis, symbol, given, to);
    else
        filter_reals(axis, symbol, given, to);
    scatter(axis, rows, complex, transform(axis.back, to, given, buffers, Part::ALL, axis.data));
}

}  // namespace

template <class Real>
Axis<Real>::Axis(std::ptrdiff_t cells_, std::ptrdiff_t length_, bool even_)
    : cells(cells_),
      length(length_),
      even(even_),
      there(length_, false),
      back(length_, true),
      data(Part::ALL) {
    if (cells < 1 || cells > length)
        throw std::invalid_argument("a line has its cells and zeros behind them");
    if (length % 4 == 0 && 2 * cells <= length)
        data = even ? Part::OUTER_QUARTERS : Part::FIRST_HALF;
    constexpr double PI = 3.14159265358979323846;
    for (std::ptrdiff_t k = 0; even && 2 * k <= length; ++k) {
        const double angle = -PI * static_cast<double>(k) / (2.0 * static_cast<double>(length));
        turns.push_back(static_cast<Real>(std::cos(angle)));
        turns.push_back(static_cast<Real>(std::sin(angle)));
    }
}

template <class Real>
SpectralFilter<Real>::SpectralFilter(const Axis<Real> &first, const Axis<Real> &second,
                                     const Field<double> &symbol, int threads)
    : first_(first), second_(second), threads_(threads) {
    if (symbol.rows != first.waves() || symbol.columns != second.waves())
        throw std::invalid_argument("the symbol has no entry for each wave");
    symbol_.reserve((symbol.rows + at_once() - 1) / at_once() * at_once() * symbol.columns);
    for (std::ptrdiff_t row = 0; row < symbol.rows; row += at_once())
        for (std::ptrdiff_t k = 0; k < symbol.columns; ++k)
            for (std::ptrdiff_t l = 0; l < at_once(); ++l)
                symbol_.push_back(
                    static_cast<Real>(symbol.row(std::min(row + l, symbol.rows - 1))[k]));
}

template <class Real>
void SpectralFilter<Real>::read_symbol(const Field<double> &into) const {
    for (std::ptrdiff_t row = 0; row < into.rows; ++row) {
        const std::ptrdiff_t l = row % at_once();
        const Real *from = symbol_.data() + (row - l) * into.columns + l;
        for (std::ptrdiff_t k = 0; k < into.columns; ++k) into.row(row)[k] = from[k * at_once()];
    }
}

template <class Real>
Waves<Real> SpectralFilter<Real>::waves(Real *work) const {
    // Rows at odd multiples of vectors, so that those at once are not all in the same part of the
    // cache.
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const std::ptrdiff_t distance = ((second_.cells + N - 1) / N | 1) * N;
    return {work, distance, first_.even ? 0 : first_.waves() * distance};
}

template <class Real>
std::ptrdiff_t SpectralFilter<Real>::work() const {
    return waves(nullptr).distance * first_.waves() * (first_.even ? 1 : 2);
}

template <class Real>
template <class Given, class Found>
void SpectralFilter<Real>::apply(const Field<Given> &given, double size, const Field<Found> &found,
                                 Real *work) const {
    constexpr std::ptrdiff_t N = NUMBERS<Real>;
    const Waves<Real> waves = this->waves(work);
    // Work on all lines along an axis, as many at once as `step`.
    const auto each = [&](const Axis<Real> &axis, std::ptrdiff_t lines, std::ptrdiff_t step,
                          const auto &do_lines) {
        const std::ptrdiff_t bunches = (lines + step - 1) / step;
        const Blocks blocks(bunches, axis.length * N, threads_);
        std::vector<Buffers<Real>> buffers;  // made here, as work of threads does not throw
        for (std::ptrdiff_t share = 0; share < blocks.shares(); ++share)
            buffers.emplace_back(axis.length);
        blocks.each([&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
            for (std::ptrdiff_t bunch = begin; bunch < end; ++bunch)
                do_lines(bunch * step, buffers[block % blocks.shares()]);
        });
    };
    each(first_, second_.cells, N, [&](std::ptrdiff_t column, const Buffers<Real> &buffers) {
        columns_there(first_, given, column, size, waves, buffers);
    });
    const std::ptrdiff_t count = first_.waves(), step = at_once();
    each(second_, count, step, [&](std::ptrdiff_t row, const Buffers<Real> &buffers) {
        Rows<Real> rows{{}, static_cast<int>(std::min(step, count - row))};
        for (std::ptrdiff_t l = 0; l < N; ++l) {
            const std::ptrdiff_t known = std::min(row + l % step, count - 1);
            rows.at[l] = waves.row(known) + l / step * waves.imaginary;
        }
        filter_rows(second_, rows, !first_.even, &symbol_[row * second_.waves()], buffers);
    });
    const double factor = size / (static_cast<double>(first_.length) * second_.length);
    each(first_, second_.cells, N, [&](std::ptrdiff_t column, const Buffers<Real> &buffers) {
        columns_back(first_, waves, column, factor, found, buffers);
    });
}

template struct Axis<float>;
template struct Axis<double>;
template class SpectralFilter<float>;
template class SpectralFilter<double>;

#define APPLY(Real, Given, Found)                                                                 \
    template void SpectralFilter<Real>::apply(const Field<Given> &, double, const Field<Found> &, \
                                              Real *) const;
APPLY(float, float, float)
APPLY(float, double, float)
APPLY(float, float, double)
APPLY(float, double, double)
APPLY(double, double, double)
#undef APPLY

}  // namespace viscontact
