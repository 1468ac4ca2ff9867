// What a sampler of reflections costs in noise: the part of its samples that is lost below the surface, the variance of
// one sample, and the error of many stratified ones.
#pragma once

#include <string>
#include <vector>

namespace vndf::bench {

struct LobeNoise {
    // A registered function, or one followed by /tries2 or /tries4: the first of so many of its samples that is above
    // the surface.
    std::string sampler;
    double alpha_x, alpha_y, cos_theta;
    double rejected = 0;  // part of the samples whose reflection is below the surface
    // Of brdf cos(theta_i) L(wi) / density, 0 for rejected samples: GGX without Fresnel. White light is L = 1, smooth
    // light L = (1 + wi.x) / 2.
    double mean = 0, variance = 0;
    double smooth_mean = 0, smooth_variance = 0;
    // Standard deviation of the mean of 1024 points of Sobol's sequence over 64 Owen scrambles.
    double sobol_rmse = 0, smooth_sobol_rmse = 0;
};

// Whether the function is one of those samplers.
bool has_noise(const std::string& sampler);

// Over roughness, anisotropy and angle of incidence; 2^16 random and 2^16 Sobol samples each, in double on the host. The
// means of one lobe under one light are the same integral.
std::vector<LobeNoise> lobe_noise();

}  // namespace vndf::bench
