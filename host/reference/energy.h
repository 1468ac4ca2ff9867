// What single scattering loses, by quadrature of the density; means of a reflectance by the cosine law.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <string>

#include "reference/distribution.h"
#include "reference/materials.h"

namespace vndf::reference {

// 1 - E(wo) of a conductor that reflects everything.
template <class N>
double directional_loss(bool separable, const Vec3<double>& wo, double alpha_x, double alpha_y,
                        int fineness = 0) {
    const Distribution reflections(std::is_same_v<N, Ggx> ? "vndf_ggx_pdf_wi" : "vndf_beckmann_pdf_wi",
                                   {{wo.x, wo.y, wo.z}, {0, 0, 1}, alpha_x, alpha_y});
    const QuadratureRule rule = reflections.rule(fineness);
    const View<double> o = view(wo, alpha_x, alpha_y);
    double loss = 0;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const View<double> v = view<double>({rule.x[i], rule.y[i], rule.z[i]}, alpha_x, alpha_y);
        loss += rule.probability[i] * (1 - (separable ? g1<N>(v) : weight<N>(o, v)));
    }
    return loss;
}

}  // namespace vndf::reference
