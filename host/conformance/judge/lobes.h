// Statistical checks of a sampler's directions for one lobe: what the samples say about their density.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "conformance/judge/errors.h"
#include "conformance/judge/statistics.h"
#include "reference/distribution.h"

namespace vndf::conformance {

// How far a distribution is known to be from the registered density; zero for exact samplers.
struct KnownBias {
    double distance = 0;    // of the cumulative distributions of the pivots
    double chi_square = 0;  // sum (p - q)^2 / q over the cells of any histogram
    double mean = 0;        // of the mean of any component, in its standard deviations
};

// One of so many samples is in the histogram of directions.
inline constexpr std::size_t histogram_share = 4;

// Whether an input of a sampler chooses the lobe: all but random numbers do.
bool is_of_lobe(const std::string& input);

// One test of one lobe.
struct LobeTest {
    std::string name;  // "chi2 of the pivots", ...
    bool is_p = true;
    double figure = 1;  // p, or what may be no larger than the limit: of means the deviation in tolerances
    std::string detail;
    double limit = 1;
    std::string unit = "tolerances";

    bool passed() const { return is_p ? figure >= limit : figure <= limit; }
};

// Counts in cells beside what is expected there, row by row.
struct CellCounts {
    std::vector<std::uint32_t> observed;
    std::vector<double> expected;
};

// A mean against its expectation.
struct MeanTest {
    std::string name;  // "x", "stretched z", ...
    double difference = 0, tolerance = 0;
    double error = 0;  // the standard error of the mean
};

// What the tests of a lobe looked at, to be drawn.
struct LobePicture {
    static constexpr std::size_t cells = 32;  // of a histogram of a sampler's, either way

    std::vector<double> row;  // the sampler's inputs; u is not read
    // Empty where the type cannot tell directions of the lobe apart; the pivots of a BSDF, which has none, always.
    CellCounts pivots;      // [pivot 1][pivot 2]
    CellCounts directions;  // [theta][phi] between the edges of `bins`, and one more for those outside
    reference::Bins bins;
    std::vector<MeanTest> means;
    std::vector<std::string> notes;  // further figures in words, a line each
    std::vector<LobeTest> tests;

    bool passed() const;
};

// Keeps, for each kind of test, the worst lobe.
class WorstLobes {
  public:
    // The rows that come are inputs of this function.
    explicit WorstLobes(const Function& sampler) : sampler_(sampler) {}

    void add(const LobeTest& test, const std::vector<double>& row);
    void append_to(std::vector<Finding>& findings) const;

  private:
    const Function& sampler_;
    std::map<std::string, Finding> findings_;
};

// The tests that a lobe of this sampler takes, judged or not: the run's count for Sidak.
std::size_t tests_per_lobe(const Function& sampler);

// The n directions (x, y, z), drawn for the sampler's inputs `row` (u is not read), against the reference: the
// pivots (32 x 32 chi-squared, two Kolmogorov-Smirnov), the histogram of the first quarter of the directions, first
// and second moments. T is float or double, `level` the rate of false alarms of one test. `picture` takes what they looked at.
template <class T>
std::vector<LobeTest> test_lobe(const Function& sampler, const std::vector<double>& row, std::size_t n,
                                const T* x, const T* y, const T* z, double level, const KnownBias& bias,
                                LobePicture* picture = nullptr);

}  // namespace vndf::conformance
