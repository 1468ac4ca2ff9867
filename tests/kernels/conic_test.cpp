// The zero-waste reflections: what holds of them and of nothing else. Slices of the claims; conic_claims counts in full.
#include <algorithm>
#include <cmath>
#include <cstring>

#define VNDF_REAL double
#include "vndf/ggx_conic2026.h"
#include "vndf/ggx_eto2023_polygon.h"

#include "runtime/device_evaluator.h"
#include "support/catch.h"
#include "support/conic_claims.h"

using namespace vndf;
using namespace vndf::claims;

namespace {

vndf_ggx_conic2026 lobe_of(const Lobe& at) {
    return vndf_ggx_conic2026_lobe({at.x, at.y, at.z}, {at.alpha_x, at.alpha_y});
}

}  // namespace

TEST_CASE("no reflection falls below the horizon") {
    CHECK(count_below(std::uint64_t{1} << 21) == 0);
}

TEST_CASE("no direction above the horizon is lost, and the inverse is one") {
    const Lost lost = count_lost(std::uint64_t{1} << 19);
    CHECK(lost.outside == 0);
    CHECK(lost.worst_round_trip < 1e-16);
}

TEST_CASE("the reflection probability is the integral along the horizon's curve") {
    CHECK(worst_probability(1000) < 1e-12);
}

TEST_CASE("the density of reflections above the horizon has the integral 1") {
    CHECK(worst_integral(12) < 1e-10);
}

TEST_CASE("the reflection probability has its closed values") {
    for (const double alpha : {0.01, 0.3, 1., 7.}) {
        const double other = 0.4 * alpha;
        CHECK(vndf_ggx_reflection_probability({0, 0, 1}, {alpha, other}) ==
              Catch::Approx(1 / std::sqrt((1 + alpha * alpha) * (1 + other * other))).epsilon(1e-14));
    }
    for (const double z : {1e-5, 0.2, 0.9})
        CHECK(vndf_ggx_reflection_probability({std::sqrt(1 - z * z), 0, z}, {1, 1}) ==
              Catch::Approx(1 / (1 + z)).epsilon(1e-14));
    CHECK(vndf_ggx_reflection_probability({0.6, 0, -0.8}, {1, 0.2}) == 1);
    CHECK(vndf_ggx_sigma_visible({0.6, 0, -0.8}, {1, 0.2}) == vndf_ggx_sigma({0.6, 0, -0.8}, {1, 0.2}));
}

// With the axes e1 and e2 exchanged two samples in a million are wrong, too few for any sample to show: the order itself.
TEST_CASE("the axes of the cone are its eigenvectors, the minor one of the ellipse first") {
    Random random(1);
    double off = 0, order = 0;
    for (int i = 0; i < 20000; ++i) {
        const Lobe at = random_lobe(random, 1e-3, 4);
        const vndf_ggx_conic2026 l = lobe_of(at);
        const double t =
            std::sqrt(std::pow(at.alpha_x * at.x, 2) + std::pow(at.alpha_y * at.y, 2) + at.z * at.z);
        const double s[3] = {at.alpha_x * at.x / t, at.alpha_y * at.y / t, at.z / t};
        const double a[3] = {at.alpha_x, at.alpha_y, 1};
        double e[3][3] = {{l.e, l.f, 1}, {l.e1x, l.e1y, l.e1z}, {l.e2x, l.e2y, l.e2z}};
        for (auto& axis : e) {
            const double length = std::hypot(axis[0], axis[1], axis[2]);
            for (double& component : axis) component /= length;
        }
        double q[3][3], size = 0;
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                q[j][k] = 0;
                for (int m = 0; m < 3; ++m)
                    for (int n = 0; n < 3; ++n)
                        q[j][k] +=
                            e[j][m] * e[k][n] *
                            ((n == 2 ? s[m] : 0) + (m == 2 ? s[n] : 0) - (m == n ? s[2] * a[m] * a[m] : 0));
                size = std::max(size, std::abs(q[j][k]));
            }
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < j; ++k) off = std::max(off, std::abs(q[j][k]) / size);
        order = std::max(order, (q[1][1] - q[2][2]) / size);  // -mu1 <= -mu2
        CHECK(l.share >= 0);
    }
    CHECK(off < 1e-13);
    CHECK(order < 1e-14);
}

TEST_CASE("a lobe for many samples gives the bits of the single call") {
    Random random(2);
    for (int i = 0; i < 4096; ++i) {
        Lobe at = random_lobe(random, 1e-8, 1e3);
        if (i % 4 == 0) at.z = -at.z;
        if (i % 4 == 1) at.z = 0;
        const vndf_double3 wo{at.x, at.y, at.z};
        const vndf_double2 alpha{at.alpha_x, at.alpha_y}, u{random.uniform(), random.uniform()};
        const vndf_double4 a = vndf_ggx_sample_wi_conic2026_with_pdf(wo, alpha, u),
                           b = vndf_ggx_sample_wi_conic2026_lobe_with_pdf(lobe_of(at), u);
        const vndf_double3 c = vndf_ggx_sample_wi_conic2026_lobe(lobe_of(at), u);
        CHECK(std::memcmp(&a, &b, sizeof a) == 0);
        CHECK((c.x == a.x && c.y == a.y && c.z == a.z));
        for (const vndf_double3& wi : {c, vndf_double3{c.x, c.y, -c.z}})  // both sides of the horizon
            CHECK(vndf_ggx_pdf_wi_conic2026_lobe(lobe_of(at), wi) ==
                  vndf_ggx_pdf_wi_conic2026(wo, wi, alpha));
    }
}

// An item makes its lobe once, from a row of wo and alpha, and draws 16 samples of it.
const char* const many_samples = R"(
__kernel void many_samples(__global const float *rows, __global const float *u1, __global const float *u2,
                           __global float *out) {
    const size_t item = get_global_id(0);
    __global const float *row = rows + 5 * item;
    const struct vndf_ggx_conic2026 lobe =
        vndf_ggx_conic2026_lobe((float3)(row[0], row[1], row[2]), (float2)(row[3], row[4]));
    for (size_t i = 16 * item; i < 16 * item + 16; ++i) {
        const float4 wi = vndf_ggx_sample_wi_conic2026_lobe_with_pdf(lobe, (float2)(u1[i], u2[i]));
        vstore4(wi, i, out);
        if (any(wi.xyz != vndf_ggx_sample_wi_conic2026_lobe(lobe, (float2)(u1[i], u2[i])))) out[4 * i] = NAN;
        out[4 * i + 3] += 2 * vndf_ggx_pdf_wi_conic2026_lobe(lobe, wi.xyz);
    }
}
)";

TEST_CASE("on the device, too, a lobe for many samples gives the bits of the single call") {
    constexpr std::size_t items = 256, samples = 16 * items;
    const Function &sampler = *find_function("vndf_ggx_sample_wi_conic2026_with_pdf"),
                   &density = *find_function("vndf_ggx_pdf_wi_conic2026");
    runtime::ProgramOptions options;
    options.functions = {sampler.name, density.name};
    options.more_source = many_samples;
    runtime::DeviceEvaluator device(runtime::choose_device().device, runtime::Math::strict,
                                    runtime::Real::f32, options);
    std::vector<float> rows, u1(samples), u2(samples), out(4 * samples);
    std::vector<std::vector<float>> lobe(5);
    Random random(5);
    for (std::size_t item = 0; item < items; ++item) {
        const Lobe at = random_lobe(random, 1e-4, 10);
        for (const double value : {at.x, at.y, item % 4 ? at.z : -at.z, at.alpha_x, at.alpha_y})
            rows.push_back(static_cast<float>(value));
        for (std::size_t k = 0; k < 5; ++k) lobe[k].insert(lobe[k].end(), 16, rows[5 * item + k]);
    }
    device.uniforms(1, 0, samples, u1.data(), u2.data());

    const runtime::Program& program = device.program();
    const auto copy_of = [&](std::vector<float>& values) {
        return cl::Buffer(program.context(), CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                          values.size() * sizeof(float), values.data());
    };
    const cl::Buffer lobes = copy_of(rows), first = copy_of(u1), second = copy_of(u2), result = copy_of(out);
    cl::Kernel kernel = program.kernel("many_samples");
    kernel.setArg(0, lobes);
    kernel.setArg(1, first);
    kernel.setArg(2, second);
    kernel.setArg(3, result);
    program.launch(kernel, items);
    program.queue().enqueueReadBuffer(result, CL_TRUE, 0, out.size() * sizeof(float), out.data());

    std::vector<float> x(samples), y(samples), z(samples), pdf(samples), separate(samples);
    device.run(sampler, samples,
               {lobe[0].data(), lobe[1].data(), lobe[2].data(), lobe[3].data(), lobe[4].data(), u1.data(),
                u2.data()},
               {x.data(), y.data(), z.data(), pdf.data()});
    device.run(density, samples,
               {lobe[0].data(), lobe[1].data(), lobe[2].data(), x.data(), y.data(), z.data(), lobe[3].data(),
                lobe[4].data()},
               {separate.data()});
    std::size_t differing = 0;
    for (std::size_t i = 0; i < samples; ++i)
        differing += out[4 * i] != x[i] || out[4 * i + 1] != y[i] || out[4 * i + 2] != z[i] ||
                     out[4 * i + 3] != pdf[i] + 2 * separate[i];
    CHECK(differing == 0);
}

TEST_CASE("the isotropic form is the general map for one alpha") {
    Random random(3);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const Lobe at = random_lobe(random, 1e-3, 1);
        if (at.z > 0.99) continue;  // where the general form's axes lose digits
        const vndf_double3 wo{at.x, at.y, at.z};
        const vndf_double2 u{random.uniform(), 0.999 * random.uniform()};
        const vndf_double4 a = vndf_ggx_sample_wi_conic2026_with_pdf(wo, {at.alpha_x, at.alpha_x}, u),
                           b = vndf_ggx_sample_wi_conic2026_isotropic_with_pdf(wo, at.alpha_x, u);
        worst = std::max(
            {worst, std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z), std::abs(a.w / b.w - 1)});
    }
    CHECK(worst < 1e-11);
}

TEST_CASE("corners of the domain are as documented") {
    const vndf_double4 nothing = vndf_ggx_sample_wi_conic2026_with_pdf({0, 0, -1}, {0.5, 0.5}, {0.3, 0.6});
    CHECK(nothing.w == 0);
    CHECK(std::hypot(nothing.x, nothing.y, nothing.z) == Catch::Approx(1));
    CHECK(vndf_ggx_pdf_wi_conic2026({0.6, 0, 0.8}, {0.8, 0, -0.6}, {0.5, 0.5}) == 0);
    CHECK(vndf_ggx_pdf_wi({0.6, 0, 0.8}, {0.8, 0, -0.6}, {0.5, 0.5}) > 0);
    CHECK(vndf_ggx_pdf_wi_conic2026({0.6, 0, 0.8}, {0.8, 0, 0}, {0.5, 0.5}) == 0);
    const vndf_double2 u = vndf_ggx_invert_wi_conic2026({0.6, 0, 0.8}, {-0.6, 0, -0.8}, {0.5, 0.5});
    CHECK((u.x == 0 && u.y == 0));
    const vndf_double2 below = vndf_ggx_invert_wi_conic2026({0.6, 0, 0.8}, {0.8, 0, -0.6}, {0.5, 0.5});
    CHECK((below.x >= 0 && below.x <= 1 && below.y >= 0 && below.y <= 1));
    CHECK(std::isnan(vndf_ggx_sigma_visible({NAN, 0, 0.8}, {0.5, 0.5})));
}

// The proof of the polygon: the cap holds every reflection above the horizon, and is inside the one of Equation 6.
TEST_CASE("the polygon's cap holds every reflection above the horizon, and Equation 6 never does better") {
    Random random(4);
    double outside = 0, looser = 0, tighter = 0;
    for (int i = 0; i < 4000; ++i) {
        const Lobe at = random_lobe(random, 1e-3, 10);
        const double z2 = at.z * at.z;
        const vndf_ggx_lobe v = vndf_ggx_lobe_of({at.x, at.y, at.z}, {at.alpha_x, at.alpha_y});
        const vndf_impl_bound polygon = vndf_impl_ggx_polygon(v), equation6 = vndf_impl_ggx_bound(v);
        const double k = 1 - polygon.gap_z / v.axis.z, k6 = 1 - equation6.gap_z / v.axis.z;
        looser = std::max(looser, k - k6);
        tighter = std::max(tighter, k6 - k);
        CHECK(polygon.height == Catch::Approx(v.axis.t + k * v.axis.z).margin(1e-10 * v.axis.t));
        CHECK(polygon.other_z == Catch::Approx((1 + k) * v.axis.z).margin(1e-10 * v.axis.t));
        double lowest = 1;  // of (o_z / cos + k) on the horizon, o_z / cos = 1 / q - 1
        for (int j = 0; j < 512; ++j) {
            const double phi = 2 * VNDF_PI * (j + random.uniform()) / 512;
            const double hx = at.x + std::cos(phi), hy = at.y + std::sin(phi);
            const double h2 = hx * hx + hy * hy + z2;
            const double gx = hx / at.alpha_x, gy = hy / at.alpha_y;
            lowest = std::min(lowest, h2 / (gx * gx + gy * gy + z2) - 1 + k);
        }
        outside = std::max(outside, -lowest);
    }
    CHECK(outside < 1e-12);
    CHECK(looser < 1e-14);
    CHECK(tighter > 0.5);
}
