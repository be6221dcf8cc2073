// Fields whose spectrum is multiplied by an even, real symbol.
#pragma once

#include "fourier.hpp"

namespace viscontact {

// Lines of cells along an axis, with zeros behind them up to the length of their transform: a
// Fourier transform, or the cosine transform (DCT-II) of one side of lines that are even.
template <class Real>
struct Axis {
    std::ptrdiff_t cells, length;
    bool even;
    Passes<Real> there, back;
    std::vector<Real> turns;  // exp(-i pi k / (2 length)), of cosine transforms
    Part data;                // of the numbers of a line that may not be zero

    Axis(std::ptrdiff_t cells, std::ptrdiff_t length, bool even);

    // Waves along this axis as the first one: half of those of real lines.
    std::ptrdiff_t waves() const { return even ? length : length / 2 + 1; }

    // Place of a cell in its line: cosine transforms take each second one, and the others backwards
    // (J. Makhoul, IEEE Trans. Acoust. 28 (1980) 27).
    std::ptrdiff_t place(std::ptrdiff_t cell) const {
        if (!even) return cell;
        return cell % 2 ? length - 1 - cell / 2 : cell / 2;
    }

    // Cells that are transformed, of which those beyond the data are zero.
    std::ptrdiff_t given() const { return data == Part::ALL ? length : length / 2; }
};

// Waves along the first axis of all columns, which are padded to whole vectors.
template <class Real>
struct Waves {
    Real *first;
    std::ptrdiff_t distance;
    std::ptrdiff_t imaginary;  // distance of the imaginary parts; 0 of real ones

    Real *row(std::ptrdiff_t index) const { return first + index * distance; }
};

template <class Real>
class SpectralFilter {
  public:
    // The symbol has half of the entries, with the middle, along an axis that is not even.
    SpectralFilter(const Axis<Real> &first, const Axis<Real> &second, const Field<double> &symbol,
                   int threads);

    // Numbers that `apply` works in.
    std::ptrdiff_t work() const;

    // Filters a field, whose numbers are divided by a size meanwhile.
    template <class Given, class Found>
    void apply(const Field<Given> &given, double size, const Field<Found> &found, Real *work) const;

    // Writes the symbol, in the order in which it was given.
    void read_symbol(const Field<double> &into) const;

    const Axis<Real> &first() const { return first_; }

    const Axis<Real> &second() const { return second_; }

  private:
    Waves<Real> waves(Real *work) const;

    // Rows of waves that are filtered at once.
    std::ptrdiff_t at_once() const { return first_.even ? NUMBERS<Real> : LINES<Real>; }

    Axis<Real> first_, second_;
    std::vector<Real> symbol_;  // rows that are filtered at once beside each other, wave by wave
    int threads_;
};

}  // namespace viscontact
