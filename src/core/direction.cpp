#include "rows.hpp"
#include "search.hpp"

namespace viscontact {

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
void correct_row(const Singles &found, const Singles &residual, const Singles &stiffness,
                 float correction, float shift, std::ptrdiff_t i) {
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

}  // namespace

double direct(const Plane &plane, const Singles &found, const Singles &direction,
              const Singles &residual, const Singles &last_residual, const Flags &active,
              const Singles &stiffness, double correction, double shift, const Matrix &inverse,
              double last_slope, bool changed) {
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
    });
    return slopes[0];
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

}  // namespace viscontact
