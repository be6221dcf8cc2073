// Fields on cells, and work on them in blocks of rows by one or several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace viscontact {

// Rows of contiguous numbers at a distance from each other: a field, or its part on a patch.
template <class Number>
struct Field {
    Number *first;
    std::ptrdiff_t rows, columns, distance;

    Number *row(std::ptrdiff_t index) const { return first + index * distance; }
};

// True and false as NumPy stores them; compilers do not vectorise work on `bool`.
using Flag = std::uint8_t;

// Cells that are worked on at once: 128 KB of a field in double precision.
constexpr std::ptrdiff_t BLOCK_CELLS = 1 << 14;

// Cells from which starting threads, 20 us each, is worth while.
constexpr std::ptrdiff_t SHARED_CELLS = 1 << 17;

// Results of work on blocks of rows, in their order. The blocks do not depend on the threads, nor
// do sums over them.
template <class Work>
auto of_blocks(std::ptrdiff_t rows, std::ptrdiff_t columns, int threads, Work work) {
    using Result = decltype(work(std::ptrdiff_t{}, std::ptrdiff_t{}));
    const std::ptrdiff_t most = std::max<std::ptrdiff_t>(1, BLOCK_CELLS / std::max<std::ptrdiff_t>(1, columns));
    const std::ptrdiff_t count = (rows + most - 1) / most;
    std::vector<Result> found(count);
    const auto share = [&](std::ptrdiff_t begin, std::ptrdiff_t step) {
        for (std::ptrdiff_t block = begin; block < count; block += step)
            found[block] = work(block * most, std::min(rows, (block + 1) * most));
    };
    const std::ptrdiff_t shares = rows * columns < SHARED_CELLS ? 1 : std::min<std::ptrdiff_t>(threads, count);
    std::vector<std::thread> others;
    for (std::ptrdiff_t each = 1; each < shares; ++each) others.emplace_back(share, each, shares);
    share(0, shares);
    for (auto &other : others) other.join();
    return found;
}

}  // namespace viscontact
