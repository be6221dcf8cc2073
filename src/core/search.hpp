// Passes of the search for the pressure of one contact: see passes/contract.py for their meaning.
#pragma once

#include "plane.hpp"

namespace viscontact {

using Flags = Field<Flag>;
using Doubles = Field<double>;
using Singles = Field<float>;

struct Measured {
    Motion motion;   // that fits best
    Matrix inverse;  // of the Gram matrix over the cells under pressure
    double largest;  // displacement
    double error;    // largest gap under pressure, or penetration, in the unit of gaps
};

// Step towards a pressure that was set aside, at most all the way.
struct StepAhead {
    Doubles ahead;
    Singles step, change;
    double part, unit;
};

// After a step, if there is one.
template <class Gap>
Measured measure(const Plane &plane, const Doubles &pressure, const Doubles &displacement,
                 const Doubles &open_gap, double compliance, const Motion &motion, const Free &free,
                 double unit, const Flags &contact, const Field<Gap> &gap, const StepAhead *step);

struct Released {
    std::ptrdiff_t released, changed;  // cells added to the active ones; those unlike the last ones
    Matrix inverse;                    // over the active cells, where some were added
};

Released release(const Plane &plane, const Flags &active, const Flags &last, const Singles &gap,
                 const Free &free);

// Adds the stiffness between changed cells and those around them, `near` in rows of three.
void follow(const Singles &stiffness, const Flags &active, const Flags &last,
            const std::array<float, 9> &near);

double direct(const Plane &plane, const Singles &found, const Singles &direction,
              const Singles &residual, const Singles &last_residual, const Flags &active,
              const Singles &stiffness, double correction, double shift, const Matrix &inverse,
              double last_slope, bool changed);

// Writes the pressure after a step, cut off and balanced, to `ahead`, and the way to it to `step`;
// whether a step led to tension and the cut pressure could be balanced.
bool trial(const Plane &plane, const Doubles &pressure, const Singles &direction, double length,
           const Doubles &ahead, const Motion &targets, const Free &free, double cell_area,
           double arm, double scale, const Singles &step);

bool balance(const Plane &plane, const Doubles &pressure, const Motion &targets, const Free &free,
             double cell_area, double arm);

// Least pressure and imbalance of a pressure, in that order.
std::array<double, 2> weigh(const Plane &plane, const Doubles &pressure, const Motion &targets,
                            const Free &free, double cell_area, double arm);

double imbalance(const Motion &sums, const Motion &targets, const Free &free, double arm);

void difference(const Plane &plane, const Doubles &ahead, const Doubles &pressure, double scale,
                const Singles &step);

std::array<double, 2> inner(const Plane &plane, const Singles &field, const Singles &first,
                            const Singles &second);

double move(const Plane &plane, const Doubles &pressure, const Doubles &displacement,
            const Singles &step, const Singles &change, double length);

Motion sums(const Plane &plane, const Doubles &values);

// Overlap of a body with springs of one cell each, by its rigid motion.
struct Pressed {
    double squares;  // sum of the squares of the overlaps
    Motion sums;     // of the overlaps
    Matrix inverse;  // of the Gram matrix over pressed springs and a share of those that bear
};

Pressed press(const Plane &plane, const Doubles &gap, const Motion &motion, const Doubles &bearing,
              double share, const Free &free);

}  // namespace viscontact
