// Fields on cells, and work on them in blocks of rows by one or several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <thread>
#include <type_traits>
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

// Blocks of rows, and what several threads do with them. The blocks do not depend on the threads.
class Blocks {
  public:
    Blocks(std::ptrdiff_t rows, std::ptrdiff_t columns, int threads)
        : rows_(rows),
          most_(std::max<std::ptrdiff_t>(1, BLOCK_CELLS / std::max<std::ptrdiff_t>(1, columns))) {
        shares_ = rows * columns < SHARED_CELLS
                      ? 1
                      : std::min<std::ptrdiff_t>(std::max(threads, 1), count());
    }

    std::ptrdiff_t count() const { return (rows_ + most_ - 1) / most_; }

    // Threads that work; a block is worked on by that of its number modulo these.
    std::ptrdiff_t shares() const { return shares_; }

    // Works on all blocks, by their number, first row and the row after their last one. The work
    // does not throw. Where the system has no more threads, the caller does what is left.
    template <class Work>
    void each(const Work &work) const {
        const auto share = [&](std::ptrdiff_t begin) {
            for (std::ptrdiff_t block = begin; block < count(); block += shares_)
                work(block, block * most_, std::min(rows_, (block + 1) * most_));
        };
        std::vector<std::thread> others;
        others.reserve(shares_);
        std::ptrdiff_t begun = 1;
        try {
            for (; begun < shares_; ++begun) others.emplace_back(share, begun);
        } catch (const std::exception &) {  // of the system or of memory
        }
        share(0);
        for (; begun < shares_; ++begun) share(begun);
        for (auto &other : others) other.join();
    }

  private:
    std::ptrdiff_t rows_, most_, shares_;
};

// Results of work on blocks of rows, in their order, so that sums over them do not depend on the
// threads.
template <class Work>
auto of_blocks(std::ptrdiff_t rows, std::ptrdiff_t columns, int threads, Work work) {
    using Result = decltype(work(std::ptrdiff_t{}, std::ptrdiff_t{}));
    const Blocks blocks(rows, columns, threads);
    if constexpr (std::is_void_v<Result>) {
        blocks.each(
            [&](std::ptrdiff_t, std::ptrdiff_t first, std::ptrdiff_t last) { work(first, last); });
    } else {
        static_assert(!std::is_same_v<Result, bool>, "threads would write to bits of one word");
        std::vector<Result> found(blocks.count());
        blocks.each([&](std::ptrdiff_t block, std::ptrdiff_t first, std::ptrdiff_t last) {
            found[block] = work(first, last);
        });
        return found;
    }
}

}  // namespace viscontact
