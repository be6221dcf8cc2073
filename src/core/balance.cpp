#include "rows.hpp"
#include "search.hpp"

namespace viscontact {

double imbalance(const Motion &sums, const Motion &targets, const Free &free, double arm) {
    const double force =
        std::max({std::abs(targets[0]), std::abs(sums[0]), std::numeric_limits<double>::min()});
    double error = 0;
    for (int k = 0; k < 3; ++k)
        if (free[k])
            error = std::max(error, std::abs(sums[k] - targets[k]) / (force * (k ? arm : 1.0)));
    return sums[0] == sums[0] ? error : NONE;
}

namespace {

struct Weighed {
    Moments moments;
    Motion sums{};
    double least = BEYOND;

    void add(const Weighed &other) {
        moments.add(other.moments);
        viscontact::add(sums, other.sums);
        least = std::min(least, other.least);
    }
};

// Multiplies a row by a plane, finds its least value, cuts it off below zero, and weighs both.
FOR_PROCESSORS
void weigh_row(Weighed &found, const Plane &plane, const Motion &factor, const Doubles &pressure,
               std::ptrdiff_t i) {
    double *here = pressure.row(i);
    const double *y = plane.y.data(), *place = plane.across_y.data();
    const double level = factor[0] + factor[1] * plane.x[i], tilt = factor[2];
    double least = found.least, sum = 0, along = 0, places = 0, squares = 0;
#pragma omp simd reduction(min : least) reduction(+ : sum, along, places, squares)
    for (std::ptrdiff_t j = 0; j < pressure.columns; ++j) {
        const double scaled = here[j] * (level + tilt * y[j]);
        least = scaled < least ? scaled : least;
        const double cut = scaled < 0 ? 0.0 : scaled;
        here[j] = cut;
        sum += cut;
        along += cut * y[j];
        places += cut * place[j];
        squares += cut * place[j] * place[j];
    }
    found.least = least;
    plane.add_row(found.sums, sum, along, i);
    found.moments.add_row(sum, places, squares, plane.across_x[i]);
}

// Balances a pressure that is weighed; multiplies each of its rows by a plane once at least.
template <class Weigh>
bool balance_weighed(Weighed found, const Plane &plane, const Motion &targets, const Free &free,
                     double cell_area, double arm, Weigh weigh) {
    for (int round = 0; round < 20; ++round) {
        Motion lacking, resultants;
        for (int k = 0; k < 3; ++k) lacking[k] = targets[k] / cell_area - found.sums[k];
        // A correction to 1, so that the factor is 1 where all balances are met.
        Motion factor = times(plane.inverse(found.moments, free), lacking);
        factor[0] += 1;
        if (factor[0] != factor[0]) return false;
        found = weigh(factor);
        if (found.least >= 0) {
            for (int k = 0; k < 3; ++k) resultants[k] = found.sums[k] * cell_area;
            return imbalance(resultants, targets, free, arm) < 1e-9;
        }
    }
    return false;
}

FOR_PROCESSORS
void difference_row(const Doubles &ahead, const Doubles &pressure, double scale,
                    const Singles &step, std::ptrdiff_t i) {
    const double *to = ahead.row(i), *from = pressure.row(i);
    float *out = step.row(i);
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < step.columns; ++j)
        out[j] = static_cast<float>((to[j] - from[j]) * scale);
}

// Steps on a row, and returns the least value.
FOR_PROCESSORS
double step_row(const Doubles &pressure, const Singles &direction, double length,
                const Doubles &ahead, std::ptrdiff_t i) {
    const double *p = pressure.row(i);
    const float *d = direction.row(i);
    double *out = ahead.row(i), lowest = BEYOND;
#pragma omp simd reduction(min : lowest)
    for (std::ptrdiff_t j = 0; j < pressure.columns; ++j) {
        const double here = p[j] + length * d[j];
        out[j] = here;
        lowest = here < lowest ? here : lowest;
    }
    return lowest;
}

Weighed weighed(const Plane &plane, const Doubles &pressure, const Motion &factor) {
    return total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Weighed here;
        for (std::ptrdiff_t i = begin; i < end; ++i) weigh_row(here, plane, factor, pressure, i);
        return here;
    }));
}

}  // namespace

std::array<double, 2> weigh(const Plane &plane, const Doubles &pressure, const Motion &targets,
                            const Free &free, double cell_area, double arm) {
    const auto parts = plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        double least = BEYOND, unknown = 0;
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            const double *row = pressure.row(i);
#pragma omp simd reduction(min : least) reduction(+ : unknown)
            for (std::ptrdiff_t j = 0; j < pressure.columns; ++j) {
                least = row[j] < least ? row[j] : least;
                unknown += row[j] == row[j] ? 0.0 : 1.0;
            }
        }
        return unknown > 0 ? NONE : least;
    });
    double least = BEYOND;
    for (const double part : parts)
        if (!(part >= least)) least = part;
    for (const double part : parts)
        if (part != part) least = part;  // not a number
    Motion resultants = sums(plane, pressure);
    for (double &each : resultants) each *= cell_area;
    return {least, imbalance(resultants, targets, free, arm)};
}

bool balance(const Plane &plane, const Doubles &pressure, const Motion &targets, const Free &free,
             double cell_area, double arm) {
    const Weighed found = weighed(plane, pressure, {1, 0, 0});
    if (!(free[0] || free[1] || free[2])) return true;
    return balance_weighed(found, plane, targets, free, cell_area, arm,
                           [&](const Motion &factor) { return weighed(plane, pressure, factor); });
}

bool trial(const Plane &plane, const Doubles &pressure, const Singles &direction, double length,
           const Doubles &ahead, const Motion &targets, const Free &free, double cell_area,
           double arm, double scale, const Singles &step) {
    const Weighed found = total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Weighed here;
        double lowest = BEYOND;
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            lowest = std::min(lowest, step_row(pressure, direction, length, ahead, i));
            weigh_row(here, plane, {1, 0, 0}, ahead, i);
        }
        here.least = lowest;
        return here;
    }));
    if (!(found.least < 0)) return false;
    // The step is written with each factor, of which the first one does nearly always.
    const auto weigh = [&](const Motion &factor) {
        return total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            Weighed here;
            for (std::ptrdiff_t i = begin; i < end; ++i) {
                weigh_row(here, plane, factor, ahead, i);
                difference_row(ahead, pressure, scale, step, i);
            }
            return here;
        }));
    };
    if (free[0] || free[1] || free[2])
        return balance_weighed(found, plane, targets, free, cell_area, arm, weigh);
    weigh({1, 0, 0});
    return true;
}

void difference(const Plane &plane, const Doubles &ahead, const Doubles &pressure, double scale,
                const Singles &step) {
    plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = begin; i < end; ++i)
            difference_row(ahead, pressure, scale, step, i);
    });
}

double move(const Plane &plane, const Doubles &pressure, const Doubles &displacement,
            const Singles &step, const Singles &change, double length) {
    const auto least = plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        double lowest = BEYOND;
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            double *p = pressure.row(i), *u = displacement.row(i);
            const float *by = step.row(i), *changed = change.row(i);
#pragma omp simd reduction(min : lowest)
            for (std::ptrdiff_t j = 0; j < step.columns; ++j) {
                p[j] += length * by[j];
                u[j] += length * changed[j];
                lowest = p[j] < lowest ? p[j] : lowest;
            }
        }
        return lowest;
    });
    return *std::min_element(least.begin(), least.end());
}

Motion sums(const Plane &plane, const Doubles &values) {
    return added(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Motion total{};
        const double *y = plane.y.data();
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            const double *here = values.row(i);
            double sum = 0, along = 0;
#pragma omp simd reduction(+ : sum, along)
            for (std::ptrdiff_t j = 0; j < values.columns; ++j) {
                sum += here[j];
                along += here[j] * y[j];
            }
            plane.add_row(total, sum, along, i);
        }
        return total;
    }));
}

}  // namespace viscontact
