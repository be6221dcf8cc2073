#include "rows.hpp"
#include "search.hpp"

namespace viscontact {

namespace {

// Moments of the marked cells of a row.
FOR_PROCESSORS
void add_marked(Moments &total, const Plane &plane, const Flag *marked, std::ptrdiff_t row) {
    std::int32_t count = 0;
    double along = 0, squares = 0;
    const std::ptrdiff_t columns = plane.columns();
#pragma omp simd reduction(+ : count)
    for (std::ptrdiff_t j = 0; j < columns; ++j) count += marked[j];
    if (count == 0) return;
    if (!plane.mirrored_y) {
        const double *y = plane.across_y.data();
#pragma omp simd reduction(+ : along, squares)
        for (std::ptrdiff_t j = 0; j < columns; ++j) {
            const double place = marked[j] ? y[j] : 0.0;
            along += place;
            squares += place * place;
        }
    }
    total.add_row(static_cast<double>(count), along, squares, plane.across_x[row]);
}

struct Opened {
    double largest = -BEYOND;
    bool unknown = false;
    Moments moments;
    Motion sums{};

    void add(const Opened &other) {
        largest = std::max(largest, other.largest);
        unknown |= other.unknown;
        moments.add(other.moments);
        viscontact::add(sums, other.sums);
    }
};

template <class Gap>
FOR_PROCESSORS void open_row(Opened &found, const Plane &plane, const Doubles &pressure,
                             const Doubles &displacement, const Doubles &open_gap,
                             double compliance, const Motion &motion, double scale,
                             const Flags &contact, const Field<Gap> &gap, std::ptrdiff_t i) {
    const double *p = pressure.row(i), *u = displacement.row(i), *open = open_gap.row(i),
                 *y = plane.y.data();
    Flag *touches = contact.row(i);
    Gap *out = gap.row(i);
    const double level = motion[0] + motion[1] * plane.x[i], tilt = motion[2];
    double largest = found.largest, sum = 0, along = 0, zero = 0;
    const std::ptrdiff_t columns = plane.columns();
    for (std::ptrdiff_t j = 0; j < columns; ++j) touches[j] = p[j] > 0;
#pragma omp simd reduction(max : largest) reduction(+ : sum, along, zero)
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const double displaced = compliance * u[j];
        largest = displaced > largest ? displaced : largest;
        zero += displaced * 0.0;  // but for what is not finite
        const double here = displaced + open[j] - (level + tilt * y[j]);
        out[j] = static_cast<Gap>(here * scale);
        const double held = p[j] > 0 ? here : 0.0;
        sum += held;
        along += held * y[j];
    }
    found.largest = largest;
    found.unknown |= zero != 0;
    plane.add_row(found.sums, sum, along, i);
    add_marked(found.moments, plane, touches, i);
}

// Takes a step on a row.
FOR_PROCESSORS
void take_row(const StepAhead &step, const Doubles &pressure, const Doubles &displacement,
              std::ptrdiff_t i) {
    double *p = pressure.row(i), *u = displacement.row(i);
    const double *to = step.ahead.row(i), length = std::min(step.part, 1.0) * step.unit;
    const float *by = step.step.row(i), *changed = step.change.row(i);
    const std::ptrdiff_t columns = pressure.columns;
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < columns; ++j) u[j] += length * changed[j];
    if (step.part >= 1) {
        std::copy(to, to + columns, p);
        return;
    }
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const double here = p[j] + length * by[j];
        p[j] = here < 0 ? 0.0 : here;  // below zero by rounding
    }
}

// Levels a row of gaps by a plane, and returns the largest gap under pressure or penetration.
template <class Gap>
FOR_PROCESSORS double fit_row(const Plane &plane, const Motion &by, const Flags &contact,
                              const Field<Gap> &gap, std::ptrdiff_t i) {
    const Flag *touches = contact.row(i);
    Gap *here = gap.row(i);
    const double *y = plane.y.data();
    const Gap level = static_cast<Gap>(by[0] + by[1] * plane.x[i]);
    const double tilt = by[2];
    Gap largest = 0, least = 0, unknown = 0;
    const std::ptrdiff_t columns = plane.columns();
#pragma omp simd reduction(max : largest) reduction(min : least) reduction(+ : unknown)
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const Gap levelled = here[j] - (level + static_cast<Gap>(tilt * y[j]));
        here[j] = levelled;
        const Gap held = touches[j] ? levelled : Gap(0);
        largest = held > largest ? held : largest;
        least = levelled < least ? levelled : least;
        unknown += levelled == levelled ? Gap(0) : Gap(1);
    }
    return unknown > 0 ? NONE : std::max<double>(largest, -least);
}

// Comparisons lose what is not a number.
void take_larger(double &largest, double value) {
    if (value > largest || value != value) largest = value;
}

}  // namespace

template <class Gap>
Measured measure(const Plane &plane, const Doubles &pressure, const Doubles &displacement,
                 const Doubles &open_gap, double compliance, const Motion &motion, const Free &free,
                 double unit, const Flags &contact, const Field<Gap> &gap, const StepAhead *step) {
    const auto opened = total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Opened here;
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            if (step) take_row(*step, pressure, displacement, i);
            open_row(here, plane, pressure, displacement, open_gap, compliance, motion, 1 / unit,
                     contact, gap, i);
        }
        return here;
    }));
    Measured found;
    found.inverse = plane.inverse(opened.moments, free);
    found.largest = opened.largest;
    // Fitted as a correction, so that a motion which the contact does not determine is unchanged.
    const Motion correction = times(found.inverse, opened.sums);
    Motion in_unit;
    for (int k = 0; k < 3; ++k) {
        found.motion[k] = motion[k] + correction[k];
        in_unit[k] = correction[k] / unit;
    }
    const auto errors = plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        double largest = 0;
        for (std::ptrdiff_t i = begin; i < end; ++i)
            take_larger(largest, fit_row(plane, in_unit, contact, gap, i));
        return largest;
    });
    found.error = 0;
    for (const double error : errors) take_larger(found.error, error);
    if (opened.unknown || correction[0] != correction[0]) found.error = found.largest = NONE;
    return found;
}

template Measured measure<double>(const Plane &, const Doubles &, const Doubles &, const Doubles &,
                                  double, const Motion &, const Free &, double, const Flags &,
                                  const Doubles &, const StepAhead *);
template Measured measure<float>(const Plane &, const Doubles &, const Doubles &, const Doubles &,
                                 double, const Motion &, const Free &, double, const Flags &,
                                 const Singles &, const StepAhead *);

namespace {

struct Count {
    std::ptrdiff_t released = 0, changed = 0;

    void add(const Count &other) { released += other.released, changed += other.changed; }
};

}  // namespace

Released release(const Plane &plane, const Flags &active, const Flags &last, const Singles &gap,
                 const Free &free) {
    const std::ptrdiff_t columns = plane.columns();
    const auto counted = total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Count here;
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            Flag *now = active.row(i);
            const Flag *before = last.row(i);
            float *open = gap.row(i);
            std::ptrdiff_t released = 0, changed = 0;
#pragma omp simd reduction(+ : released, changed)
            for (std::ptrdiff_t j = 0; j < columns; ++j) {
                const bool was = now[j], is = was | (open[j] < 0);
                released += is & !was;
                changed += is != before[j];
                now[j] = is;
                open[j] = is ? open[j] : 0.0f;
            }
            here.released += released, here.changed += changed;
        }
        return here;
    }));
    Released found{counted.released, counted.changed, {}};
    if (counted.released > 0) {
        found.inverse =
            plane.inverse(total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
                              Moments here;
                              for (std::ptrdiff_t i = begin; i < end; ++i)
                                  add_marked(here, plane, active.row(i), i);
                              return here;
                          })),
                          free);
    }
    return found;
}

void follow(const Singles &stiffness, const Flags &active, const Flags &last,
            const std::array<float, 9> &near) {
    for (std::ptrdiff_t i = 0; i < active.rows; ++i) {
        const Flag *now = active.row(i), *before = last.row(i);
        for (std::ptrdiff_t j = 0; j < active.columns; ++j) {
            if (now[j] == before[j]) continue;
            const float sign = now[j] ? 1.0f : -1.0f;
            for (int down = -1; down <= 1; ++down)
                for (int right = -1; right <= 1; ++right) {
                    const std::ptrdiff_t row = i + down, column = j + right;
                    if (row < 0 || row >= active.rows || column < 0 || column >= active.columns)
                        continue;
                    stiffness.row(row)[column] += sign * near[3 * (down + 1) + right + 1];
                }
        }
    }
}

}  // namespace viscontact
