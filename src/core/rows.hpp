// Rows of fields that are worked on for newer processors as well, and sums over blocks.
#pragma once

#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "fields.hpp"

// Work on rows is compiled for newer processors as well, where the C library chooses between them.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define FOR_PROCESSORS __attribute__((target_clones("avx2", "default")))
#else
#define FOR_PROCESSORS
#endif

namespace viscontact {

constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
constexpr double BEYOND = std::numeric_limits<double>::infinity();

// Visits the places of a row of bytes that are not zero, of which there are few.
template <class Visit>
void each_marked(const Flag *marks, std::ptrdiff_t count, const Visit &visit) {
    constexpr std::ptrdiff_t EIGHT = sizeof(std::uint64_t);
    std::ptrdiff_t j = 0;
    for (; j + EIGHT <= count; j += EIGHT) {
        std::uint64_t eight;
        std::memcpy(&eight, marks + j, EIGHT);
        for (std::ptrdiff_t k = j; eight && k < j + EIGHT; ++k)
            if (marks[k]) visit(k);
    }
    for (; j < count; ++j)
        if (marks[j]) visit(j);
}

template <class Part>
Part total_of(const std::vector<Part> &parts) {
    Part total{};
    for (const Part &part : parts) total.add(part);
    return total;
}

template <class Number, std::size_t Count>
std::array<Number, Count> added(const std::vector<std::array<Number, Count>> &parts) {
    std::array<Number, Count> total{};
    for (const auto &part : parts)
        for (std::size_t k = 0; k < Count; ++k) total[k] += part[k];
    return total;
}

}  // namespace viscontact
