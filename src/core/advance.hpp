// One iteration of the search: see passes/contract.py for its meaning.
#pragma once

#include "search.hpp"
#include "spectral_filter.hpp"

namespace viscontact {

// Operators of a patch, and its stiffness around a cell in rows of three.
struct Operators {
    const SpectralFilter<float> *convolution, *preconditioner, *stiffness;
    std::array<float, 9> near;
    float *work;
    std::ptrdiff_t few;  // most changed cells that are followed one by one
};

// Fields that an iteration reads and writes.
struct Iterate {
    Doubles pressure, ahead;
    Flags active, last;
    Singles residual, last_residual;
    Singles direction, spare;  // exchanged by the iteration: the new direction is in `spare`
    Singles change, stiffness;
};

struct Balances {
    Motion targets;
    Free free;
    double cell_area, arm;
};

struct Advanced {
    double slope;
    bool projected;           // the step leads to a pressure that is cut off and balanced
    double curvature, along;  // of the step: its product with its displacement, and the residual
};

// `unit` [Pa m] times a direction [1/m] is a pressure; `length` [Pa m] is that of a trial step.
Advanced advance(const Plane &plane, const Operators &operators, const Iterate &of,
                 const Balances &balances, const Matrix &inverse, double correction,
                 double last_slope, double length, double unit);

}  // namespace viscontact
