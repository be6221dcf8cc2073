#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "rim.hpp"
#include "rows.hpp"

namespace viscontact {

namespace {

// Writes how many corners of each square are inside, 0 in place of all four; returns how many
// squares have all four.
FOR_PROCESSORS
std::ptrdiff_t count_corners(const Flag *near, const Flag *far, std::ptrdiff_t squares,
                             Flag *count) {
    std::int32_t whole = 0;
    for (std::ptrdiff_t j = 0; j < squares; ++j)
        count[j] = near[j] + near[j + 1] + far[j] + far[j + 1];
#pragma omp simd reduction(+ : whole)
    for (std::ptrdiff_t j = 0; j < squares; ++j) whole += count[j] >> 2;
    for (std::ptrdiff_t j = 0; j < squares; ++j) count[j] &= 3;
    return whole;
}

double enclosed_squares(const Field<Flag> &contact, const Rim &rim, double segment) {
    const auto crossing = [](double value) { return std::isnan(value) ? 0.0 : value; };
    double enclosed = 0;
    std::vector<Flag> count(contact.columns);
    const std::ptrdiff_t squares = contact.columns - 1;
    for (std::ptrdiff_t i = 0; i + 1 < contact.rows; ++i) {
        const Flag *near = contact.row(i), *far = contact.row(i + 1);
        const double *along_x = rim.along_x.row(i);
        const double *lower_y = rim.along_y.row(i), *upper_y = rim.along_y.row(i + 1);
        enclosed += static_cast<double>(count_corners(near, far, squares, count.data()));
        each_marked(count.data(), squares, [&](std::ptrdiff_t j) {
            const double left = crossing(along_x[j]), right = crossing(along_x[j + 1]);
            const double lower = crossing(lower_y[j]), upper = crossing(upper_y[j]);
            const double u = left + right, v = lower + upper;
            // One corner inside: a triangle. Two neighbours: a trapezium between the crossings of
            // the two edges that leave their side. Three: the square without a triangle. Signed
            // areas where a crossing lies beyond the square: their sum is that of the polygons.
            if (count[j] == 1)
                enclosed += u * v / 2 + segment;
            else if (count[j] == 3)
                enclosed += 1 - (1 - u) * (1 - v) / 2 - segment;
            else if (near[j] != far[j + 1])
                enclosed += (u + v) / 2;
            else  // opposite corners: two separate triangles
                enclosed +=
                    (near[j] ? left * lower + right * upper : left * upper + right * lower) / 2 +
                    2 * segment;
        });
    }
    return enclosed;
}

// Extent along one axis, by flags and crossings at (line, place on it).
template <class Contact, class Crossing>
double extent(std::ptrdiff_t lines, std::ptrdiff_t places, std::ptrdiff_t first,
              std::ptrdiff_t last, Contact contact, Crossing crossing) {
    double begin = static_cast<double>(lines - 1), end = 0;
    // A crossing lies between half a cell inside and one outside of its inner centre: two lines
    // contain the extreme ones. A chord may cross its line elsewhere.
    const auto each = [&](std::ptrdiff_t line, auto note) {
        for (std::ptrdiff_t at = std::max<std::ptrdiff_t>(line - 1, 0);
             at < std::min(line + 1, lines - 1); ++at)
            for (std::ptrdiff_t place = 0; place < places; ++place)
                if (std::abs(crossing(at, place)) <= 1) note(at, place, static_cast<double>(at));
    };
    each(first, [&](std::ptrdiff_t at, std::ptrdiff_t place, double centre) {
        if (contact(at + 1, place)) begin = std::min(begin, centre + 1 - crossing(at, place));
    });
    each(last, [&](std::ptrdiff_t at, std::ptrdiff_t place, double centre) {
        if (contact(at, place)) end = std::max(end, centre + crossing(at, place));
    });
    return end - begin;
}

}  // namespace

std::array<std::ptrdiff_t, 4> spans(const Field<Flag> &cells) {
    std::ptrdiff_t first_row = -1, last_row = -1, first = cells.columns, last = -1;
    for (std::ptrdiff_t i = 0; i < cells.rows; ++i) {
        const Flag *row = cells.row(i), *end = row + cells.columns;
        const auto *begin = static_cast<const Flag *>(std::memchr(row, 1, cells.columns));
        if (!begin) continue;
        if (first_row < 0) first_row = i;
        last_row = i;
        first = std::min<std::ptrdiff_t>(first, begin - row);
        while (!*(end - 1)) --end;
        last = std::max<std::ptrdiff_t>(last, end - row - 1);
    }
    return {first_row, last_row, last < 0 ? -1 : first, last};
}

Extent extent_of(const Field<Flag> &contact, const Rim &rim, double segment) {
    Extent found{enclosed_squares(contact, rim, segment), 0, 0, 0, 0};
    const auto [first_row, last_row, first_column, last_column] = spans(contact);
    std::vector<Flag> touched(contact.columns, 0);
    for (std::ptrdiff_t i = 0; i < contact.rows; ++i) {
        const Flag *row = contact.row(i);
        found.rows += std::memchr(row, 1, contact.columns) != nullptr;
        for (std::ptrdiff_t j = 0; j < contact.columns; ++j) touched[j] |= row[j];
    }
    found.columns = std::count(touched.begin(), touched.end(), Flag{1});
    if (found.rows == 0) return found;
    found.along_x = extent(
        contact.rows, contact.columns, first_row, last_row,
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return contact.row(line)[place]; },
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return rim.along_x.row(line)[place]; });
    found.along_y = extent(
        contact.columns, contact.rows, first_column, last_column,
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return contact.row(place)[line]; },
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return rim.along_y.row(place)[line]; });
    return found;
}

}  // namespace viscontact
