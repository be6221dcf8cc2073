#include "rows.hpp"
#include "search.hpp"

namespace viscontact {

namespace {

struct Pressing {
    double squares = 0;
    Motion sums{};
    Moments moments;

    void add(const Pressing &other) {
        squares += other.squares;
        viscontact::add(sums, other.sums);
        moments.add(other.moments);
    }
};

// Overlap of a row with springs, and stiffness of those that it presses and of those that bear.
FOR_PROCESSORS
void press_row(Pressing &found, const Plane &plane, const Doubles &gap, const Motion &motion,
               const Doubles &bearing, double share, std::ptrdiff_t i) {
    const double *open = gap.row(i), *bears = bearing.row(i);
    const double *y = plane.y.data(), *place = plane.across_y.data();
    const double level = motion[0] + motion[1] * plane.x[i], tilt = motion[2];
    double sum = 0, along = 0, square = 0, stiff = 0, places = 0, squares = 0;
    const std::ptrdiff_t columns = plane.columns();
#pragma omp simd reduction(+ : sum, along, square, stiff, places, squares)
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const double above = level + tilt * y[j] - open[j];
        const double overlap = above > 0 ? above : 0.0;
        const double weight = (above > 0 ? 1.0 : 0.0) + share * bears[j];
        sum += overlap;
        along += overlap * y[j];
        square += overlap * overlap;
        stiff += weight;
        places += weight * place[j];
        squares += weight * place[j] * place[j];
    }
    found.squares += square;
    plane.add_row(found.sums, sum, along, i);
    found.moments.add_row(stiff, places, squares, plane.across_x[i]);
}

}  // namespace

Pressed press(const Plane &plane, const Doubles &gap, const Motion &motion, const Doubles &bearing,
              double share, const Free &free) {
    const Pressing all = total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Pressing here;
        for (std::ptrdiff_t i = begin; i < end; ++i)
            press_row(here, plane, gap, motion, bearing, share, i);
        return here;
    }));
    return {all.squares, all.sums, plane.inverse(all.moments, free)};
}

}  // namespace viscontact
