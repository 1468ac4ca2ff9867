#include "conformance/judge/finding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vndf::conformance {

std::string to_string(Concern concern) {
    return concern == Concern::wrong     ? "wrong"
           : concern == Concern::inexact ? "inexact"
                                         : "outside the domain";
}

bool Finding::passed() const {
    return biased ? std::abs(figure - limit) <= 0.1 * limit : severity() <= 1;
}

double Finding::severity() const {
    constexpr double beyond = std::numeric_limits<double>::infinity();
    if (std::isnan(figure)) return beyond;
    if (is_p) return std::log(std::max(figure, 1e-300)) / std::log(limit);
    if (figure == 0) return 0;
    return limit > 0 ? figure / limit : beyond;
}

}  // namespace vndf::conformance
