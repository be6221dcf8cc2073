#include "search.hpp"

#include <limits>

// Work on rows is compiled for newer processors as well, where the C library chooses between them.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define FOR_PROCESSORS __attribute__((target_clones("avx2", "default")))
#else
#define FOR_PROCESSORS
#endif

namespace viscontact {

namespace {

constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
constexpr double BEYOND = std::numeric_limits<double>::infinity();

template <class Part>
Part total_of(const std::vector<Part> &parts) {
    Part total{};
    for (const Part &part : parts) total.add(part);
    return total;
}

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
FOR_PROCESSORS
void open_row(Opened &found, const Plane &plane, const Doubles &pressure, const Doubles &displacement,
              const Doubles &open_gap, double compliance, const Motion &motion, double scale,
              const Flags &contact, const Field<Gap> &gap, std::ptrdiff_t i) {
    const double *p = pressure.row(i), *u = displacement.row(i), *open = open_gap.row(i), *y = plane.y.data();
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
void take_row(const StepAhead &step, const Doubles &pressure, const Doubles &displacement, std::ptrdiff_t i) {
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
FOR_PROCESSORS
double fit_row(const Plane &plane, const Motion &by, const Flags &contact, const Field<Gap> &gap,
               std::ptrdiff_t i) {
    const Flag *touches = contact.row(i);
    Gap *here = gap.row(i);
    const double *y = plane.y.data();
    const Gap level = static_cast<Gap>(by[0] + by[1] * plane.x[i]);
    const double tilt = by[2];
    Gap largest = 0, least = 0;
    const std::ptrdiff_t columns = plane.columns();
#pragma omp simd reduction(max : largest) reduction(min : least)
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const Gap levelled = here[j] - (level + static_cast<Gap>(tilt * y[j]));
        here[j] = levelled;
        const Gap held = touches[j] ? levelled : Gap(0);
        largest = held > largest ? held : largest;
        least = levelled < least ? levelled : least;
    }
    return std::max<double>(largest, -least);
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
            open_row(here, plane, pressure, displacement, open_gap, compliance, motion, 1 / unit, contact,
                     gap, i);
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
            largest = std::max(largest, fit_row(plane, in_unit, contact, gap, i));
        return largest;
    });
    found.error = *std::max_element(errors.begin(), errors.end());
    // Comparisons lose what is not a number.
    if (opened.unknown || correction[0] != correction[0]) found.error = found.largest = NONE;
    return found;
}

template Measured measure<double>(const Plane &, const Doubles &, const Doubles &, const Doubles &, double,
                                  const Motion &, const Free &, double, const Flags &, const Doubles &,
                                  const StepAhead *);
template Measured measure<float>(const Plane &, const Doubles &, const Doubles &, const Doubles &, double,
                                 const Motion &, const Free &, double, const Flags &, const Singles &,
                                 const StepAhead *);

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
        found.inverse = plane.inverse(total_of(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
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
                    if (row < 0 || row >= active.rows || column < 0 || column >= active.columns) continue;
                    stiffness.row(row)[column] += sign * near[3 * (down + 1) + right + 1];
                }
        }
    }
}

namespace {

// Restricts a row to the active cells, and adds its sums.
FOR_PROCESSORS
void restrict_row(Motion &total, const Plane &plane, const Singles &vector, const Flags &active,
                  std::ptrdiff_t i) {
    float *here = vector.row(i);
    const Flag *on = active.row(i);
    const double *y = plane.y.data();
    double sum = 0, along = 0;
    const std::ptrdiff_t columns = plane.columns();
#pragma omp simd reduction(+ : sum, along)
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        here[j] = on[j] ? here[j] : 0.0f;
        sum += here[j];
        along += here[j] * y[j];
    }
    plane.add_row(total, sum, along, i);
}

// Takes a plane from the active cells of a row. In double precision, so that what is left of the
// resultants is rounding of cells.
FOR_PROCESSORS
void level_row(const Plane &plane, const Motion &by, const Singles &vector, const Flags &active,
               std::ptrdiff_t i) {
    float *here = vector.row(i);
    const Flag *on = active.row(i);
    const double *y = plane.y.data();
    const double level = by[0] + by[1] * plane.x[i], tilt = by[2];
    const std::ptrdiff_t columns = plane.columns();
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < columns; ++j)
        here[j] = static_cast<float>(here[j] - on[j] * (level + tilt * y[j]));
}

FOR_PROCESSORS
void correct_row(const Singles &found, const Singles &residual, const Singles &stiffness, float correction,
                 float shift, std::ptrdiff_t i) {
    float *here = found.row(i);
    const float *gap = residual.row(i), *stiff = stiffness.row(i);
    const std::ptrdiff_t columns = found.columns;
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < columns; ++j)
        here[j] = here[j] - correction * (stiff[j] > 0 ? stiff[j] : 0.0f) * gap[j] + shift;
}

FOR_PROCESSORS
std::array<double, 2> inner_row(const Singles &field, const Singles &first, const Singles &second,
                                std::ptrdiff_t i) {
    const float *a = field.row(i), *b = first.row(i), *c = second.row(i);
    double one = 0, other = 0;
    const std::ptrdiff_t columns = field.columns;
#pragma omp simd reduction(+ : one, other)
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const double here = a[j];
        one += here * b[j];
        other += here * c[j];
    }
    return {one, other};
}

template <class Number, std::size_t Count>
std::array<Number, Count> added(const std::vector<std::array<Number, Count>> &parts) {
    std::array<Number, Count> total{};
    for (const auto &part : parts)
        for (std::size_t k = 0; k < Count; ++k) total[k] += part[k];
    return total;
}

}  // namespace

double direct(const Plane &plane, const Singles &found, const Singles &direction, const Singles &residual,
              const Singles &last_residual, const Flags &active, const Singles &stiffness, double correction,
              double shift, const Matrix &inverse, double last_slope, bool changed) {
    const bool conjugates = last_slope > 0, projects_both = conjugates && changed;
    using Both = std::array<double, 6>;
    const Both both = added(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Motion of_found{}, of_last{};
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            correct_row(found, residual, stiffness, static_cast<float>(correction),
                        static_cast<float>(shift), i);
            restrict_row(of_found, plane, found, active, i);
            if (projects_both) restrict_row(of_last, plane, direction, active, i);
        }
        return Both{of_found[0], of_found[1], of_found[2], of_last[0], of_last[1], of_last[2]};
    }));
    const Motion by = times(inverse, {both[0], both[1], both[2]});
    const Motion last_by = times(inverse, {both[3], both[4], both[5]});
    const auto slopes = added(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        std::array<double, 2> total{};
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            level_row(plane, by, found, active, i);
            if (projects_both) level_row(plane, last_by, direction, active, i);
            const auto here = inner_row(found, residual, last_residual, i);
            total[0] += here[0], total[1] += here[1];
        }
        return total;
    }));
    const double factor = conjugates ? std::max((slopes[0] - slopes[1]) / last_slope, 0.0) : 0.0;
    const float share = static_cast<float>(factor);
    plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            float *here = found.row(i);
            const float *last = direction.row(i);
#pragma omp simd
            for (std::ptrdiff_t j = 0; j < found.columns; ++j) here[j] = share * last[j] - here[j];
        }
        return true;
    });
    return slopes[0];
}

double imbalance(const Motion &sums, const Motion &targets, const Free &free, double arm) {
    const double force =
        std::max({std::abs(targets[0]), std::abs(sums[0]), std::numeric_limits<double>::min()});
    double error = 0;
    for (int k = 0; k < 3; ++k)
        if (free[k]) error = std::max(error, std::abs(sums[k] - targets[k]) / (force * (k ? arm : 1.0)));
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

}  // namespace

namespace {

// Balances a pressure that is weighed; multiplies each of its rows by a plane once at least.
template <class Weigh>
bool balance_weighed(Weighed found, const Plane &plane, const Motion &targets, const Free &free, double cell_area,
                     double arm, Weigh weigh) {
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
void difference_row(const Doubles &ahead, const Doubles &pressure, double scale, const Singles &step,
                    std::ptrdiff_t i) {
    const double *to = ahead.row(i), *from = pressure.row(i);
    float *out = step.row(i);
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < step.columns; ++j) out[j] = static_cast<float>((to[j] - from[j]) * scale);
}

// Steps on a row, and returns the least value.
FOR_PROCESSORS
double step_row(const Doubles &pressure, const Singles &direction, double length, const Doubles &ahead,
                std::ptrdiff_t i) {
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

bool balance(const Plane &plane, const Doubles &pressure, const Motion &targets, const Free &free,
             double cell_area, double arm) {
    const Weighed found = weighed(plane, pressure, {1, 0, 0});
    if (!(free[0] || free[1] || free[2])) return true;
    return balance_weighed(found, plane, targets, free, cell_area, arm,
                           [&](const Motion &factor) { return weighed(plane, pressure, factor); });
}

bool trial(const Plane &plane, const Doubles &pressure, const Singles &direction, double length,
           const Doubles &ahead, const Motion &targets, const Free &free, double cell_area, double arm,
           double scale, const Singles &step) {
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
        for (std::ptrdiff_t i = begin; i < end; ++i) difference_row(ahead, pressure, scale, step, i);
        return true;
    });
}

std::array<double, 2> inner(const Plane &plane, const Singles &field, const Singles &first,
                            const Singles &second) {
    return added(plane.each([&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        std::array<double, 2> total{};
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            const auto here = inner_row(field, first, second, i);
            total[0] += here[0], total[1] += here[1];
        }
        return total;
    }));
}

double move(const Plane &plane, const Doubles &pressure, const Doubles &displacement, const Singles &step,
            const Singles &change, double length) {
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
