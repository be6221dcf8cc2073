#include <algorithm>
#include <cmath>
#include <vector>

#include "cell.hpp"
#include "rim.hpp"
#include "rows.hpp"

namespace viscontact {

namespace {

FOR_PROCESSORS
std::int32_t count(const Flag *row, std::ptrdiff_t cells) {
    std::int32_t found = 0;
#pragma omp simd reduction(+ : found)
    for (std::ptrdiff_t j = 0; j < cells; ++j) found += row[j];
    return found;
}

// Marked cells whose partners in another row are not.
FOR_PROCESSORS
std::int32_t count_without(const Flag *row, const Flag *other, std::ptrdiff_t cells) {
    std::int32_t found = 0;
#pragma omp simd reduction(+ : found)
    for (std::ptrdiff_t j = 0; j < cells; ++j) found += row[j] & ~other[j];
    return found;
}

// Cells in contact, and the numbers of chords of consecutive ones along x and y.
std::array<std::ptrdiff_t, 3> chords(const Field<Flag> &contact) {
    std::array<std::ptrdiff_t, 3> found{};
    const std::vector<Flag> nothing(contact.columns, 0);
    for (std::ptrdiff_t i = 0; i < contact.rows; ++i) {
        const Flag *row = contact.row(i), *before = i ? contact.row(i - 1) : nothing.data();
        found[0] += count(row, contact.columns);
        found[1] += count_without(row, before, contact.columns);
        found[2] += row[0] + count_without(row + 1, row, contact.columns - 1);
    }
    return found;
}

}  // namespace

double Segments::of(const Field<Flag> &contact, const Field<double> &gap) const {
    const auto [cells, lines_x, lines_y] = chords(contact);
    if (cells == 0) return whole;
    const double count = static_cast<double>(cells);
    const double along_x = count / static_cast<double>(lines_x);
    const double along_y = count / static_cast<double>(lines_y);
    // Crossings at the body's outline have no such error.
    std::ptrdiff_t at_end = 0, outside = 0;
    for (std::ptrdiff_t i = 0; i < gap.rows; ++i) {
        const double *row = gap.row(i);
        int here = 0;
        for (std::ptrdiff_t j = 0; j < gap.columns; ++j) here += std::abs(row[j]) == BEYOND;
        outside += here;
    }
    for (std::ptrdiff_t i = 0; outside && i < contact.rows; ++i) {
        const Flag *row = contact.row(i);
        for (std::ptrdiff_t j = 0; j < contact.columns; ++j) {
            if (!row[j]) continue;
            const auto beyond = [&](std::ptrdiff_t r, std::ptrdiff_t c) {
                return std::isinf(at(gap, {r, c}, 0.0));
            };
            at_end += beyond(i - 1, j) + beyond(i + 1, j) + beyond(i, j - 1) + beyond(i, j + 1);
        }
    }
    double by_gap = 1;
    if (at_end) {
        const double ends = 2 * count * (1 / along_x + 1 / along_y);
        by_gap = std::max(1 - static_cast<double>(at_end) / ends, 0.0);
    }
    const double lost = loss / std::max(std::sqrt(along_x * along_y), 1.0);
    return whole * (1 - by_gap * std::min(lost, 1 - least));
}

}  // namespace viscontact
