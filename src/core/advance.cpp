#include "advance.hpp"

namespace viscontact {

namespace {

// Stiffness of the active cells against a uniform displacement, where some have changed.
void follow_active(const Operators &operators, const Iterate &of, std::ptrdiff_t changed) {
    if (changed <= operators.few) {
        follow(of.stiffness, of.active, of.last, operators.near);
        return;
    }
    for (std::ptrdiff_t i = 0; i < of.spare.rows; ++i) {
        const Flag *active = of.active.row(i);
        float *here = of.spare.row(i);
        for (std::ptrdiff_t j = 0; j < of.spare.columns; ++j) here[j] = active[j];
    }
    operators.stiffness->apply(of.spare, 1, of.stiffness, operators.work);
}

}  // namespace

Advanced advance(const Plane &plane, const Operators &operators, const Iterate &of,
                 const Balances &balances, const Matrix &inverse, double correction,
                 double last_slope, double length, double unit) {
    const Released released = release(plane, of.active, of.last, of.residual, balances.free);
    if (released.changed > 0) follow_active(operators, of, released.changed);
    operators.preconditioner->apply(of.residual, 1, of.spare, operators.work);
    Advanced found;
    found.slope =
        direct(plane, of.spare, of.direction, of.residual, of.last_residual, of.active,
               of.stiffness, correction, 0, released.released ? released.inverse : inverse,
               last_slope, released.changed > 0);
    const Singles &direction = of.spare, &way = of.direction;
    found.projected = trial(plane, of.pressure, direction, length, of.ahead, balances.targets,
                            balances.free, balances.cell_area, balances.arm, 1 / unit, way);
    const Singles &step = found.projected ? way : direction;
    operators.convolution->apply(step, 1, of.change, operators.work);
    const auto products = inner(plane, step, of.change, of.residual);
    found.curvature = products[0];
    found.along = products[1];
    return found;
}

}  // namespace viscontact
