#include "conformance/judge/digest.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>

#include <fmt/format.h>

#include "conformance/judge/errors.h"
#include "conformance/inputs/grids.h"
#include "parallel.h"
#include "splitmix64.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace vndf::conformance {
namespace {

using runtime::Math;
using runtime::Real;
using Columns = std::vector<std::vector<double>>;

// ---- inputs

// The random numbers of one row.
class Random : public SplitMix64 {
  public:
    explicit Random(std::uint64_t row) : SplitMix64(row << 32) {}

    using SplitMix64::uniform;
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    bool chance(double probability) { return uniform() < probability; }
    // In [2^low, 2^high), every binade alike: nearly log-uniform, without exp or log.
    double binades(int low, int high) {
        const int exponent = low + static_cast<int>(bits() % static_cast<unsigned>(high - low));
        return std::ldexp(1 + uniform(), exponent);
    }
    double azimuth() { return uniform(-3.14159265358979323846, 3.14159265358979323846); }

    double cosine() {
        const double sign = chance(0.3) ? -1 : 1, kind = uniform();
        if (kind < 0.02) return sign;
        if (kind < 0.12) return sign * (1 - binades(-24, 0));
        return sign * (kind < 0.3 ? binades(-30, 0) : uniform());
    }
    double alpha() {
        if (chance(0.01)) return 0;
        return chance(0.05) ? binades(-27, 9) : binades(-13, 1);
    }
    double u() {
        const double kind = uniform();
        if (kind < 0.02) return kind < 0.01 ? 0 : 1;
        if (kind < 0.12) return kind < 0.07 ? binades(-34, 0) : 1 - binades(-24, 0);
        return uniform();
    }
    Stretched normal() {
        const double phi = azimuth();
        return {chance(0.1) ? binades(-20, 0) : std::sqrt(1 - uniform()), phi};
    }
    Direction direction() {
        const double cos_theta = cosine();
        return conformance::direction(cos_theta, azimuth());
    }

  private:
    std::uint64_t state_;
};

Point random_point(Random random, bool world) {
    const Direction wo = random.direction();
    const double alpha = random.alpha(), other = random.chance(0.4) || world ? alpha : random.alpha();
    const Direction n = world ? random.direction() : Direction{0, 0, 1};
    const Stretched normal = random.normal();
    const double u1 = random.u(), u2 = random.u();
    return make_point(wo, {alpha, other}, normal, n, {u1, u2}, random.uniform(0.4, 2.5));
}

// ---- results

template <class T>
auto bits(double result) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Bits>(std::isnan(result) ? std::numeric_limits<T>::quiet_NaN()
                                                  : static_cast<T>(result));
}

bool same_bits(double a, double b) {
    return bits<double>(a) == bits<double>(b);
}

template <class T>
std::uint64_t hash_of(const Columns& results) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (std::size_t i = 0; i < results.front().size(); ++i)
        for (const std::vector<double>& column : results) {
            auto value = bits<T>(column[i]);
            for (std::size_t byte = 0; byte < sizeof value; ++byte, value >>= 8)
                hash = (hash ^ (value & 0xff)) * 0x100000001b3;
        }
    return hash;
}

// The number of steps from one number of type T to another; 0 and -0 are the same place.
template <class T>
std::uint64_t ulps_between(double a, double b) {
    const auto place = [](double x) {
        const auto all = bits<T>(x);
        const auto size = static_cast<std::uint64_t>(all & ~(decltype(all){1} << (8 * sizeof all - 1)));
        return std::signbit(x) ? -size : size;  // modulo 2^64, so that differences are right
    };
    const auto difference = static_cast<std::int64_t>(place(a) - place(b));
    return static_cast<std::uint64_t>(difference < 0 ? -difference : difference);
}

// ---- subnormal numbers

#ifdef __SSE__
// While it lives, this thread replaces subnormal results (0x8000) or arguments (0x40) by 0.
class Flushing {
  public:
    explicit Flushing(unsigned mode) : before_(_mm_getcsr()) { _mm_setcsr(before_ | mode); }
    ~Flushing() { _mm_setcsr(before_); }
    Flushing(const Flushing&) = delete;
    Flushing& operator=(const Flushing&) = delete;
    static constexpr unsigned modes[] = {0x8000, 0x0040, 0x8040};

  private:
    unsigned before_;
};
#else
// Without a switch for it nothing is found out, and nothing exempt.
struct Flushing {
    explicit Flushing(unsigned) {}
    static constexpr unsigned modes[] = {0};
};
#endif

// What the host build returns, and the rows where that depends on subnormal numbers: a device that flushes them, be it
// results, arguments or both, cannot be asked for the same bits there.
struct HostResults {
    Columns columns;
    std::vector<bool> exempt;
    double moved = 0;  // the largest change of a result in exempt rows, over the largest of the row's results
    std::size_t exempt_count() const {
        return static_cast<std::size_t>(std::count(exempt.begin(), exempt.end(), true));
    }
};

// Of the results of a row, but a normal number.
double largest(const Columns& results, std::size_t row) {
    double most = std::numeric_limits<float>::min();
    for (const std::vector<double>& column : results) most = std::max(most, std::abs(column[row]));
    return most;
}

HostResults host_results(const Function& function, const Table& table, Real real,
                         const BitsOptions& options) {
    runtime::HostEvaluator host(options.math, real);
    HostResults results{evaluate(host, function, table), std::vector<bool>(table.rows()), 0};
    if (!options.flushes) return results;
    for (const unsigned mode : Flushing::modes) {
        Columns flushed;
        {
            const Flushing flushing(mode);
            flushed = evaluate(host, function, table);
        }
        for (std::size_t k = 0; k < flushed.size(); ++k)
            for (std::size_t i = 0; i < table.rows(); ++i)
                if (!same_bits(flushed[k][i], results.columns[k][i])) {
                    results.exempt[i] = true;
                    const double change = std::abs(flushed[k][i] - results.columns[k][i]);
                    results.moved = std::max(results.moved, change / largest(results.columns, i));
                }
    }
    return results;
}

// ---- functions

// Calls visit(index in `selected`, inputs, results of the evaluator) for every function; those with the same arguments
// share their inputs.
template <class Visit>
void visit_results(runtime::Evaluator& evaluator, const std::vector<const Function*>& selected,
                   const BitsOptions& options, Visit visit) {
    std::map<std::string, std::vector<std::size_t>> by_arguments;
    for (std::size_t i = 0; i < selected.size(); ++i) by_arguments[selected[i]->arguments].push_back(i);
    double done = 0;
    for (const auto& [_, indices] : by_arguments) {
        const Table table = digest_inputs(*selected[indices.front()], options.rows, evaluator.input_real());
        for (const std::size_t i : indices) {
            options.progress(selected[i]->name, done++ / static_cast<double>(selected.size()));
            visit(i, table, evaluate(evaluator, *selected[i], table));
        }
    }
}

template <class T>
BitDifference difference(const Function& function, const Table& table, const Columns& results,
                         const HostResults& host) {
    BitDifference found{&function, 0, host.exempt_count(), 0, {}};
    std::size_t worst = table.rows();
    for (std::size_t i = 0; i < table.rows(); ++i) {
        bool differs = false;
        for (std::size_t k = 0; k < results.size() && !host.exempt[i]; ++k) {
            if (same_bits(results[k][i], host.columns[k][i])) continue;
            differs = true;
            const std::uint64_t ulps = ulps_between<T>(results[k][i], host.columns[k][i]);
            if (worst == table.rows() || ulps > found.ulps) worst = i, found.ulps = ulps;
        }
        found.differing += differs;
    }
    if (found.differing > 0) found.worst = hex_row(function, table.row(worst));
    return found;
}

}  // namespace

Table digest_inputs(const Function& function, std::size_t rows, Real real) {
    const bool world = column(function, "n_x") >= 0;
    const std::vector<Point> grid = hard_points(function);
    const bool whole = grid.size() <= rows / 2;
    const std::size_t hard = whole ? grid.size() : rows / 2;
    const auto point = [&](std::size_t row) {
        Random random(row);
        if (row >= hard) return random_point(random, world);
        return grid[whole ? row : random.bits() % grid.size()];
    };
    Table table;
    table.columns.assign(function.inputs.size(), std::vector<double>(rows));
    parallel_for(rows, std::size_t{1} << 12, [&](unsigned, std::size_t begin, std::size_t end) {
        std::vector<Point> points;
        for (std::size_t row = begin; row < end; ++row) points.push_back(point(row));
        const Table part = tabulate(function, points, real);
        for (std::size_t j = 0; j < part.columns.size(); ++j)
            std::copy(part.columns[j].begin(), part.columns[j].end(), table.columns[j].begin() + begin);
    });
    return table;
}

std::vector<Digest> digests(runtime::Evaluator& evaluator, const std::vector<const Function*>& selected,
                            const BitsOptions& options) {
    const Real real = evaluator.input_real();
    std::vector<Digest> all(selected.size());
    visit_results(evaluator, selected, options, [&](std::size_t at, const Table& table, Columns results) {
        Digest& digest = all[at];
        digest.function = selected[at];
        if (options.flushes) {
            const HostResults host = host_results(*selected[at], table, real, options);
            digest.exempt = host.exempt_count();
            digest.moved = host.moved;
            for (std::size_t k = 0; k < results.size(); ++k)
                for (std::size_t i = 0; i < table.rows(); ++i)
                    if (host.exempt[i]) results[k][i] = host.columns[k][i];
        }
        digest.hash = real == Real::f32 ? hash_of<float>(results) : hash_of<double>(results);
    });
    return all;
}

std::string format_digests(const std::vector<Digest>& digests) {
    std::string text;
    for (const Digest& digest : digests)
        text += fmt::format("{} {:016x}\n", digest.function->name, digest.hash);
    return text;
}

std::vector<BitDifference> compare_with_host(runtime::Evaluator& evaluator,
                                             const std::vector<const Function*>& selected,
                                             const BitsOptions& options) {
    const Real real = evaluator.input_real();
    std::vector<BitDifference> all(selected.size());
    visit_results(evaluator, selected, options,
                  [&](std::size_t at, const Table& table, const Columns& results) {
                      const Function& function = *selected[at];
                      const HostResults host = host_results(function, table, real, options);
                      all[at] = real == Real::f32 ? difference<float>(function, table, results, host)
                                                  : difference<double>(function, table, results, host);
                  });
    return all;
}

std::string format_differences(const std::vector<BitDifference>& differences, std::size_t rows) {
    std::size_t exempt = 0;
    std::string text;
    for (const BitDifference& d : differences) {
        exempt += d.exempt;
        if (d.differing > 0)
            text += fmt::format("  {} differs in {} of {}, at most {} ulp, at {}\n", d.function->name,
                                d.differing, rows - d.exempt, d.ulps, d.worst);
    }
    return fmt::format(
        "same bits as the host build: {} ({} inputs a function{})\n{}", text.empty() ? "yes" : "no", rows,
        exempt > 0 ? fmt::format("; {} results exempt, which the device's flushing of subnormal "
                                 "numbers can change",
                                 exempt)
                   : "",
        text);
}

}  // namespace vndf::conformance
