// Planes c0 + c1 x + c2 y over cells, and sums of fields against 1, x, y.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "fields.hpp"

namespace viscontact {

using Motion = std::array<double, 3>;  // coefficients of a plane, or sums against 1, x, y
using Matrix = std::array<double, 9>;  // of three rows
using Free = std::array<bool, 3>;      // motions that balances determine

inline Motion times(const Matrix &matrix, const Motion &vector) {
    Motion found{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) found[i] += matrix[3 * i + j] * vector[j];
    return found;
}

// Sums of weights times 1, x, y, xx, xy, yy over cells, in units of cells.
struct Moments {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

    void add(const Moments &other) {
        n += other.n, x += other.x, y += other.y;
        xx += other.xx, xy += other.xy, yy += other.yy;
    }

    // A row at a place along x, by its own sums of weights times 1, y, yy.
    void add_row(double weight, double along_y, double squares, double place) {
        n += weight, x += weight * place, y += along_y;
        xx += weight * place * place, xy += along_y * place, yy += squares;
    }
};

inline void add(Motion &total, const Motion &other) {
    for (int i = 0; i < 3; ++i) total[i] += other[i];
}

// Cell centres of a block. Mirrored cells count for their mirror images as well: what is odd along
// that axis vanishes.
class Plane {
  public:
    std::vector<double> x, y;                // cell centres [m]
    std::vector<double> across_x, across_y;  // the same in cells
    bool mirrored_x, mirrored_y;
    int threads;

    Plane(std::vector<double> x_, std::vector<double> y_, double dx, double dy, bool mx, bool my,
          int threads_)
        : x(std::move(x_)),
          y(std::move(y_)),
          mirrored_x(mx),
          mirrored_y(my),
          threads(threads_),
          unit_{1.0, 1 / dx, 1 / dy} {
        for (double each : x) across_x.push_back(each * unit_[1]);
        for (double each : y) across_y.push_back(each * unit_[2]);
    }

    std::ptrdiff_t rows() const { return static_cast<std::ptrdiff_t>(x.size()); }

    std::ptrdiff_t columns() const { return static_cast<std::ptrdiff_t>(y.size()); }

    template <class Work>
    auto each(Work work) const {
        return of_blocks(rows(), columns(), threads, work);
    }

    // Sums of a row by those of its values times 1 and y.
    void add_row(Motion &total, double sum, double along_y, std::ptrdiff_t row) const {
        total[0] += sum;
        if (!mirrored_x) total[1] += sum * x[row];
        if (!mirrored_y) total[2] += along_y;
    }

    // Inverse of the Gram matrix of 1, x, y over free coefficients. Where the cells determine only
    // some (one cell, or a line of cells) the others are of least norm about the cells' centre.
    Matrix inverse(Moments of, const Free &free) const {
        if (mirrored_x) of.x = of.xx = of.xy = 0;
        if (mirrored_y) of.y = of.yy = of.xy = 0;
        Matrix found{};
        if (!(of.n > 0)) return found;
        const double n = of.n, mx = free[0] * of.x / n, my = free[0] * of.y / n;
        const auto [a, b, c] = pseudo_inverse(free[1] * (of.xx - n * mx * mx),
                                              free[1] * free[2] * (of.xy - n * mx * my),
                                              free[2] * (of.yy - n * my * my), NO_EXTENT * n);
        const double to_x = -(a * mx + b * my), to_y = -(b * mx + c * my);
        const double head = free[0] / n - (mx * to_x + my * to_y);
        found = {head, to_x, to_y, to_x, a, b, to_y, b, c};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) found[3 * i + j] *= unit_[i] * unit_[j];
        return found;
    }

  private:
    // Variance of position [cells^2] below which cells count as one, or as a line.
    static constexpr double NO_EXTENT = 1e-9;

    // Inverse of a symmetric 2 x 2 matrix, on its directions above a threshold.
    static std::array<double, 3> pseudo_inverse(double xx, double xy, double yy, double threshold) {
        const double middle = (xx + yy) / 2, radius = std::hypot((xx - yy) / 2, xy);
        if (middle - radius > threshold) {
            const double determinant = xx * yy - xy * xy;
            return {yy / determinant, -xy / determinant, xx / determinant};
        }
        if (middle + radius > threshold) {  // of rank one: its eigenvalue times a projector
            const double square = (middle + radius) * (middle + radius);
            return {xx / square, xy / square, yy / square};
        }
        return {0, 0, 0};
    }

    std::array<double, 3> unit_;
};

}  // namespace viscontact
