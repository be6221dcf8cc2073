#include "fourier.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscontact {

namespace {

constexpr double PI = 3.14159265358979323846;

// Factors of a length. Fours are first and last; a single four is first, or last.
std::vector<int> radices(std::ptrdiff_t length, bool four_last) {
    std::vector<int> found;
    for (const int radix : {4, 2, 3, 5})
        while (length % radix == 0) {
            found.push_back(radix);
            length /= radix;
        }
    if (length != 1) throw std::invalid_argument("a length has prime factors of 2, 3 and 5 only");
    const auto fours = std::count(found.begin(), found.end(), 4);
    if (fours > 1 || (fours == 1 && four_last))
        std::rotate(found.begin(), found.begin() + 1, found.end());
    return found;
}

}  // namespace

template <class Real>
Passes<Real>::Passes(std::ptrdiff_t length, bool four_last) : length_(length) {
    if (length < 1) throw std::invalid_argument("a line has one number at least");
    std::ptrdiff_t left = length, distance = 1;
    for (const int radix : radices(length, four_last)) {
        const std::ptrdiff_t count = left / radix;
        passes_.push_back({radix, count, distance, factors_.size()});
        for (std::ptrdiff_t p = 0; p < count; ++p)
            for (int k = 1; k < radix; ++k) {
                const double angle = -2 * PI * static_cast<double>(p * k % left) / left;
                factors_.push_back(static_cast<Real>(std::cos(angle)));
                factors_.push_back(static_cast<Real>(std::sin(angle)));
            }
        left = count;
        distance *= radix;
    }
}

template class Passes<float>;
template class Passes<double>;

}  // namespace viscontact
