// Numbers of Python for planes, and back.
#pragma once

#include "arrays.hpp"

using Triple = std::tuple<double, double, double>;
using FreeTriple = std::tuple<bool, bool, bool>;
using Entries = std::tuple<Triple, Triple, Triple>;

inline viscontact::Motion motion(const Triple &of) {
    return {std::get<0>(of), std::get<1>(of), std::get<2>(of)};
}

inline viscontact::Free free_of(const FreeTriple &of) {
    return {std::get<0>(of), std::get<1>(of), std::get<2>(of)};
}

inline Triple triple(const viscontact::Motion &of) { return {of[0], of[1], of[2]}; }

inline Entries entries(const viscontact::Matrix &of) {
    return {{of[0], of[1], of[2]}, {of[3], of[4], of[5]}, {of[6], of[7], of[8]}};
}

inline viscontact::Matrix matrix(const Entries &of) {
    const auto &[first, second, third] = of;
    const viscontact::Motion rows[] = {motion(first), motion(second), motion(third)};
    viscontact::Matrix found;
    for (int i = 0; i < 3; ++i) std::copy(rows[i].begin(), rows[i].end(), found.begin() + 3 * i);
    return found;
}
