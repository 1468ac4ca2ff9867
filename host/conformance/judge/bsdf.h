// A user's BSDF, its value times the cosine, its density and its samples, judged by what holds of every BSDF.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "conformance/inputs/grids.h"
#include "conformance/judge/lobes.h"
#include "runtime/device_evaluator.h"

namespace vndf::conformance {

inline constexpr std::size_t bsdf_samples = std::size_t{1} << 17;  // for each lobe

struct BsdfFindings {
    std::vector<Finding> value, density, sample;
    std::vector<LobePicture> pictures;  // of every lobe; rows are the sampler's
    std::size_t tests = 0;              // statistical ones
    std::string diagnosis;              // of what fails, or empty
};

// wo is in front. family_rate: of false alarms over all tests.
BsdfFindings check_bsdf(runtime::DeviceEvaluator& evaluator, const Function& value, const Function& density,
                        const Function& sample, const Scope& scope, bool quick, std::size_t rows,
                        std::uint64_t seed, double family_rate);

}  // namespace vndf::conformance
