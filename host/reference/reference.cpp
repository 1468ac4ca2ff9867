// The names of the registry, bound to the reference's templates for double and long double.
#include "reference/reference.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "reference/arc_maps.h"
#include "reference/materials.h"
#include "reference/terms.h"
#include "reference/world.h"

namespace vndf::reference {
namespace {

// --- Scalars to arguments ---

// NaN stays NaN.
template <class R>
R clamped_alpha(const R& alpha, Precision precision) {
    const Real<R> least = precision == Precision::f32 ? Real<R>(1e-8f) : Real<R>(1e-8), largest = 1e3;
    return alpha < least ? R(least) : alpha > largest ? R(largest) : alpha;
}

template <class T>
T least_u(Precision precision) {
    return precision == Precision::f32 ? T(0x1p-33) : T(0x1p-65);
}

template <class R>
R clamped_u(const R& u, Precision precision) {
    using T = Real<R>;
    const T low = least_u<T>(precision);
    const T high = precision == Precision::f32 ? T(1 - 0x1p-24) : T(1 - 0x1p-53);
    return u < low ? R(low) : u > high ? R(high) : u;
}

template <class R>
Vec3<R> vec3(const R* in) {
    return {in[0], in[1], in[2]};
}

enum class Layout { wo_alpha_u, wo_alpha1_u, wo_n_alpha1_u, wo_cap_alpha_u, wo_ng_alpha_u, alpha_u };
constexpr bool one_alpha(Layout layout) {
    return layout == Layout::wo_alpha1_u || layout == Layout::wo_n_alpha1_u;
}
constexpr std::size_t first_alpha(Layout layout) {
    return layout == Layout::alpha_u                                            ? 0
           : layout == Layout::wo_n_alpha1_u || layout == Layout::wo_ng_alpha_u ? 6
           : layout == Layout::wo_cap_alpha_u                                   ? 7
                                                                                : 3;
}
constexpr std::size_t scalars(Layout layout) {
    return first_alpha(layout) + (one_alpha(layout) ? 1 : 2) + 2;
}

template <class R>
Arguments<R> arguments(Layout layout, const R* in, Precision precision) {
    Arguments<R> a;
    if (layout != Layout::alpha_u) {
        a.wo = normalised(vec3(in));
        in += 3;
    }
    if (layout == Layout::wo_n_alpha1_u) {
        a.n = normalised(vec3(in));
        in += 3;
    }
    if (layout == Layout::wo_ng_alpha_u) {
        a.ng = normalised(vec3(in));
        in += 3;
    }
    if (layout == Layout::wo_cap_alpha_u) {
        const Light<R> cap = light_of(vec3(in), in[3], precision);
        a.l = cap.l, a.one_minus_cos = cap.one_minus_cos, a.cap_part = cap.part;
        in += 4;
    }
    a.alpha_x = clamped_alpha(*in++, precision);
    a.alpha_y = one_alpha(layout) ? a.alpha_x : clamped_alpha(*in++, precision);
    a.u1 = clamped_u(in[0], precision);
    a.u2 = clamped_u(in[1], precision);
    a.v1 = 1 - a.u1;
    a.v2 = 1 - a.u2;
    a.least_u = least_u<Real<R>>(precision);
    a.rotation = R(0);
    return a;
}

template <class R>
R finite(const R& x, Precision precision) {
    const R bound = largest<R>(precision);
    return x > bound ? bound : x < -bound ? R(-bound) : x;
}

// --- Samplers ---

template <class R, Sample<R> (*map)(const Arguments<R>&), Layout layout>
void evaluate_sampler(const R* in, R* out, Precision precision) {
    const Sample<R> s = map(arguments(layout, in, precision));
    out[0] = s.direction.x, out[1] = s.direction.y, out[2] = s.direction.z;
}
template <class R, Sample<R> (*map)(const Arguments<R>&), Layout layout>
void evaluate_sampler_pdf(const R* in, R* out, Precision precision) {
    const Sample<R> s = map(arguments(layout, in, precision));
    out[0] = s.direction.x, out[1] = s.direction.y, out[2] = s.direction.z;
    out[3] = finite(s.pdf, precision);
}

using D = Dual<double, 12>;

template <Sample<D> (*map)(const Arguments<D>&), Layout layout>
double sampler_condition(const double* in, Precision precision) {
    constexpr std::size_t n = scalars(layout);
    D x[n];
    for (std::size_t i = 0; i < n; ++i) {
        // A clamped number varies as the one that stands for it.
        const bool u = i + 2 >= n, alpha = !u && i >= first_alpha(layout);
        x[i] = D::variable(u       ? clamped_u(in[i], precision)
                           : alpha ? clamped_alpha(in[i], precision)
                                   : in[i],
                           i);
    }
    Arguments<D> a = arguments(layout, x, precision);
    a.rotation = D::variable(0, n);
    const Vec3<D> d = map(a).direction;
    double sum = 0;
    for (std::size_t i = 0; i <= n; ++i)
        sum +=
            (i < n ? std::abs(x[i].value) : 1) * std::hypot(d.x.partial[i], d.y.partial[i], d.z.partial[i]);
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

struct Condition {
    std::string_view name;
    double (*function)(const double*, Precision);
};

template <class R>
struct Entry {
    std::string_view name;
    Evaluation<R> function;
};

// Expands X(name, map, layout) for every sampler.
#define VNDF_REFERENCE_SAMPLERS(X)                                                        \
    X(vndf_ggx_sample_wm_heitz_deon2014, ggx_heitz_deon2014, wo_alpha_u)                  \
    X(vndf_ggx_sample_wm_heitz_deon2014_exact, ggx_heitz_deon2014_exact, wo_alpha_u)      \
    X(vndf_ggx_sample_wm_heitz_deon2014_lobe, ggx_heitz_deon2014, wo_alpha_u)             \
    X(vndf_ggx_sample_wm_heitz_deon2014_exact_lobe, ggx_heitz_deon2014_exact, wo_alpha_u) \
    X(vndf_ggx_sample_wm_heitz2017, ggx_heitz2017, wo_alpha_u)                            \
    X(vndf_ggx_sample_wm_heitz2017_lobe, ggx_heitz2017, wo_alpha_u)                       \
    X(vndf_ggx_sample_wm_heitz2018, ggx_heitz2018, wo_alpha_u)                            \
    X(vndf_ggx_sample_wm_heitz2018_lobe, ggx_heitz2018, wo_alpha_u)                       \
    X(vndf_ggx_sample_wm_dupuy2023, ggx_dupuy2023, wo_alpha_u)                            \
    X(vndf_ggx_sample_wm_dupuy2023_lobe, ggx_dupuy2023, wo_alpha_u)                       \
    X(vndf_ggx_sample_wm_benyoub2024, ggx_benyoub2024, wo_n_alpha1_u)                     \
    X(vndf_ggx_sample_wi_eto2023, ggx_eto2023, wo_alpha_u)                                \
    X(vndf_ggx_sample_wi_eto2023_lobe, ggx_eto2023, wo_alpha_u)                           \
    X(vndf_ggx_sample_wi_eto2023_polygon, ggx_eto2023_polygon, wo_alpha_u)                \
    X(vndf_ggx_sample_wi_eto2023_polygon_lobe, ggx_eto2023_polygon, wo_alpha_u)           \
    X(vndf_ggx_sample_wi_conic2026, ggx_conic2026, wo_alpha_u)                            \
    X(vndf_ggx_sample_wi_conic2026_lobe, ggx_conic2026, wo_alpha_u)                       \
    X(vndf_ggx_sample_wi_conic2026_isotropic, ggx_conic2026, wo_alpha1_u)                 \
    X(vndf_ggx_sample_wi_cone2026, ggx_cone2026, wo_cap_alpha_u)                          \
    X(vndf_ggx_sample_wi_cone2026_lobe, ggx_cone2026, wo_cap_alpha_u)                     \
    X(vndf_ggx_sample_wi_tilted2026, ggx_tilted2026, wo_ng_alpha_u)                       \
    X(vndf_ggx_sample_wi_tilted2026_lobe, ggx_tilted2026, wo_ng_alpha_u)                  \
    X(vndf_ggx_sample_wm_walter2007, ggx_walter2007, alpha_u)                             \
    X(vndf_beckmann_sample_wm_heitz_deon2014, beckmann_heitz_deon2014, wo_alpha_u)        \
    X(vndf_beckmann_sample_wm_jakob2014, beckmann_jakob2014, wo_alpha_u)                  \
    X(vndf_beckmann_sample_wm_heitz_deon2014_lobe, beckmann_heitz_deon2014, wo_alpha_u)   \
    X(vndf_beckmann_sample_wm_jakob2014_lobe, beckmann_jakob2014, wo_alpha_u)             \
    X(vndf_beckmann_sample_wm_walter2007, beckmann_walter2007, alpha_u)

#define VNDF_CONDITION(name, map, layout)               \
    {#name, sampler_condition<map<D>, Layout::layout>}, \
        {#name "_with_pdf", sampler_condition<map<D>, Layout::layout>},
constexpr Condition conditions[] = {VNDF_REFERENCE_SAMPLERS(VNDF_CONDITION)};
#undef VNDF_CONDITION

// --- Terms ---

// The scalars of one call, taken in order.
template <class R>
struct Reader {
    const R* in;
    Precision precision;
    R scalar() { return *in++; }
    R u() { return clamped_u(*in++, precision); }
    R alpha() { return clamped_alpha(*in++, precision); }
    Vec3<R> vector() {
        in += 3;
        return vec3(in - 3);
    }
    View<R> stretched(const Vec3<R>& w) {
        const R ax = alpha(), ay = alpha();
        return view(w, ax, ay);
    }
};

template <class R, R (*term)(Reader<R>)>
void evaluate_term(const R* in, R* out, Precision precision) {
    *out = finite(term({in, precision}), precision);
}
template <class R, Vec3<R> (*function)(Reader<R>)>
void evaluate_vector(const R* in, R* out, Precision precision) {
    const Vec3<R> w = function({in, precision});
    out[0] = w.x, out[1] = w.y, out[2] = w.z;
}

template <class R, std::pair<R, R> (*pair)(Reader<R>)>
void evaluate_pair(const R* in, R* out, Precision precision) {
    const std::pair<R, R> p = pair({in, precision});
    out[0] = finite(p.first, precision), out[1] = finite(p.second, precision);
}

template <class N, class R>
struct Terms {
    static R ndf(Reader<R> in) {
        const Vec3<R> m = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return N::template ndf<R>(m, ax, ay);
    }
    static R p22(Reader<R> in) {
        const R x = in.scalar(), y = in.scalar(), ax = in.alpha(), ay = in.alpha();
        return N::template p22<R>(squared(R(x / ax)) + squared(R(y / ay))) / ax / ay;
    }
    static R lambda(Reader<R> in) {
        const Vec3<R> w = in.vector();
        return reference::lambda<N>(in.stretched(w));
    }
    static R sigma(Reader<R> in) {
        const Vec3<R> w = in.vector();
        return N::template sigma<R>(in.stretched(w));
    }
    static R g1(Reader<R> in) {
        const Vec3<R> w = in.vector();
        return reference::g1<N>(in.stretched(w));
    }
    static R g2(Reader<R> in) {
        const Vec3<R> wo = in.vector(), wi = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return reference::g2<N>(view(wo, ax, ay), view(wi, ax, ay));
    }
    static R weight(Reader<R> in) {
        const Vec3<R> wo = in.vector(), wi = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return reference::weight<N>(view(wo, ax, ay), view(wi, ax, ay));
    }
    static R g2_separable(Reader<R> in) {
        const Vec3<R> wo = in.vector(), wi = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return reference::g1<N>(view(wo, ax, ay)) * reference::g1<N>(view(wi, ax, ay));
    }
    static R pdf_wm(Reader<R> in) {
        const Vec3<R> wo = in.vector(), wm = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return reference::pdf_wm<N>(wo, wm, ax, ay);
    }
    static R pdf_wi(Reader<R> in) {
        const Vec3<R> wo = in.vector(), wi = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return reference::pdf_wi<N>(wo, wi, ax, ay);
    }
    static std::pair<R, R> pdf_wi_both(Reader<R> in) {
        const Vec3<R> wo = in.vector(), wi = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return {reference::pdf_wi<N>(wo, wi, ax, ay), reference::pdf_wi<N>(wi, wo, ax, ay)};
    }
    static std::pair<R, R> eval_pdf(Reader<R> in) {
        const Vec3<R> wo = in.vector(), wi = in.vector();
        const R ax = in.alpha(), ay = in.alpha();
        return {brdf<N>(wo, wi, ax, ay), reference::pdf_wi<N>(wo, wi, ax, ay)};
    }
    static R pdf_wm_walter2007(Reader<R> in) { return ndf(in) * in.in[2]; }
};

// About n.
template <class N, class R>
struct WorldTerms {
    static Vec3<R> one(Reader<R>& in) {
        const Vec3<R> w = in.vector();
        return upright(about(in.vector(), {w}));
    }
    static View<R> viewed(Reader<R> in) {
        const Vec3<R> w = one(in);
        const R alpha = in.alpha();
        return view(w, alpha, alpha);
    }
    struct Two {
        View<R> o, i;
    };
    static Two both(Reader<R> in) {
        const Vec3<R> wo = in.vector(), n = in.vector(), wi = in.vector();
        const R alpha = in.alpha();
        return {view(upright(about(n, {wo})), alpha, alpha), view(upright(about(n, {wi})), alpha, alpha)};
    }
    static R ndf(Reader<R> in) {
        const Vec3<R> m = one(in);
        const R alpha = in.alpha();
        return N::template ndf<R>(m, alpha, alpha);
    }
    static R lambda(Reader<R> in) { return reference::lambda<N>(viewed(in)); }
    static R sigma(Reader<R> in) { return N::template sigma<R>(viewed(in)); }
    static R g1(Reader<R> in) { return reference::g1<N>(viewed(in)); }
    static R g2(Reader<R> in) {
        const Two v = both(in);
        return reference::g2<N>(v.o, v.i);
    }
    static R weight(Reader<R> in) {
        const Two v = both(in);
        return reference::weight<N>(v.o, v.i);
    }
    static R pdf_wm(Reader<R> in) {
        const Vec3<R> wo = in.vector(), n = in.vector(), wm = in.vector();
        return pdf_wm_world<N>(wo, n, wm, in.alpha());
    }
    static R pdf_wi(Reader<R> in) {
        const Vec3<R> wo = in.vector(), n = in.vector(), wi = in.vector();
        return pdf_wi_world<N>(wo, n, wi, in.alpha());
    }
};

// By cosines.
template <class N, class R>
struct CosineTerms {
    static Vec3<R> direction(const R& cosine) {
        const R square = (1 - cosine) * (1 + cosine);
        return {square > 0 ? R(std::sqrt(square)) : R(0), R(0), cosine};
    }
    static View<R> viewed(const R& cosine, const R& alpha) { return view(direction(cosine), alpha, alpha); }
    static R ndf(Reader<R> in) {
        const Vec3<R> m = direction(in.scalar());
        const R alpha = in.alpha();
        return N::template ndf<R>(m, alpha, alpha);
    }
    static R lambda(Reader<R> in) {
        const R c = in.scalar();
        return reference::lambda<N>(viewed(c, in.alpha()));
    }
    static R sigma(Reader<R> in) {
        const R c = in.scalar();
        return N::template sigma<R>(viewed(c, in.alpha()));
    }
    static R g1(Reader<R> in) {
        const R c = in.scalar();
        return reference::g1<N>(viewed(c, in.alpha()));
    }
    static R g2(Reader<R> in) {
        const R o = in.scalar(), i = in.scalar(), alpha = in.alpha();
        return reference::g2<N>(viewed(o, alpha), viewed(i, alpha));
    }
    static R weight(Reader<R> in) {
        const R o = in.scalar(), i = in.scalar(), alpha = in.alpha();
        return reference::weight<N>(viewed(o, alpha), viewed(i, alpha));
    }
    static R pdf_wm(Reader<R> in) {
        const R o = in.scalar(), m = in.scalar(), cosine = in.scalar();
        return cosine > 0 ? R(cosine * visible_by_cosines<N>(direction(o), direction(m), in.alpha())) : R(0);
    }
    static R pdf_wi(Reader<R> in) {
        const R o = in.scalar(), m = in.scalar();
        return visible_by_cosines<N>(direction(o), direction(m), in.alpha()) / 4;
    }
};

template <class R, Bound<R> (*bound)(const View<R>&, const Vec3<R>&)>
R ggx_pdf_wi_bounded_of(Reader<R> in) {
    const Vec3<R> wo = in.vector(), wi = in.vector();
    const View<R> v = in.stretched(wo);
    return wo.z > 0 ? ggx_pdf_wi_bounded(wo, wi, v, bound(v, wo), in.precision)
                    : pdf_wi<Ggx, R>(wo, wi, v.alpha_x, v.alpha_y);
}
template <class R>
R ggx_pdf_wi_conic2026_of(Reader<R> in) {
    const Vec3<R> wo = in.vector(), wi = in.vector();
    const R ax = in.alpha(), ay = in.alpha();
    return ggx_pdf_wi_conic2026(wo, wi, ax, ay);
}
template <class R>
R ggx_sigma_visible_of(Reader<R> in) {
    const Vec3<R> w = in.vector();
    return sigma_visible(in.stretched(w));
}
template <class R>
R ggx_reflection_probability_of(Reader<R> in) {
    const Vec3<R> w = in.vector();
    const View<R> v = in.stretched(w);
    return v.up > 0 ? R(ggx_sigma_visible(v) / Ggx::sigma(v)) : R(1);
}
template <class R>
Light<R> cap_in(Reader<R>& in) {
    const Vec3<R> l = in.vector();
    return light_of(l, in.scalar(), in.precision);
}
template <class R>
R ggx_pdf_wi_cone2026_of(Reader<R> in) {
    const Vec3<R> wo = in.vector();
    const Light<R> cap = cap_in(in);
    const Vec3<R> wi = in.vector();
    const R ax = in.alpha(), ay = in.alpha();
    return ggx_pdf_wi_cone2026(wo, wi, cap, ax, ay);
}
template <class R>
R ggx_sigma_cap_of(Reader<R> in) {
    const Vec3<R> wo = in.vector();
    const Light<R> cap = cap_in(in);
    const R ax = in.alpha(), ay = in.alpha();
    return ggx_sigma_cap(wo, cap, ax, ay);
}
template <class R>
R ggx_cap_probability_of(Reader<R> in) {
    const Vec3<R> wo = in.vector();
    const Light<R> cap = cap_in(in);
    const R ax = in.alpha(), ay = in.alpha();
    const R p = ggx_sigma_cap(wo, cap, ax, ay) / Ggx::sigma(view(normalised(wo), ax, ay));
    return p < 1 ? p : R(1);
}
template <class R>
R ggx_pdf_wi_tilted2026_of(Reader<R> in) {
    const Vec3<R> wo = in.vector(), ng = normalised(in.vector()), wi = in.vector();
    const R ax = in.alpha(), ay = in.alpha();
    return ggx_pdf_wi_tilted2026(wo, ng, wi, ax, ay);
}
template <class R>
R ggx_sigma_tilted_of(Reader<R> in) {
    const Vec3<R> wo = normalised(in.vector()), ng = normalised(in.vector());
    const R ax = in.alpha(), ay = in.alpha();
    return ggx_sigma_tilted(wo, ng, ax, ay);
}
template <class R>
R ggx_cap_mass_of(Reader<R> in) {
    const Vec3<R> wo = normalised(in.vector());
    const Light<R> cap = cap_in(in);
    const R ax = in.alpha(), ay = in.alpha();
    return ggx_cap_mass(wo, cap, ax, ay);
}
template <class R, int vertices>
R ggx_polygon_mass_of(Reader<R> in) {
    const Vec3<R> wo = normalised(in.vector());
    std::vector<Vec3<R>> at;
    for (int i = 0; i < vertices; ++i) at.push_back(normalised(in.vector()));
    const R ax = in.alpha(), ay = in.alpha();
    return ggx_polygon_mass(wo, at, ax, ay);
}
template <class R>
void evaluate_cap_inverse(const R* in, R* out, Precision precision) {
    Reader<R> reader{in, precision};
    const Vec3<R> wo = reader.vector();
    const Light<R> cap = cap_in(reader);
    const Vec3<R> wi = reader.vector();
    const R ax = reader.alpha(), ay = reader.alpha();
    const DiskPoint<R> u = ggx_invert_cone2026(wo, wi, cap, ax, ay);
    out[0] = u.u1, out[1] = u.u2;
}
template <class R>
void evaluate_inverse(const R* in, R* out, Precision precision) {
    Reader<R> reader{in, precision};
    const Vec3<R> wo = reader.vector(), wi = reader.vector();
    const DiskPoint<R> u = ggx_invert_conic2026(wo, wi, reader.stretched(wo));
    out[0] = u.u1, out[1] = std::clamp(u.u2, R(0), R(1));
}
// About n: what counts of wm and wo is their part along n and the rest.
template <class R>
R ggx_pdf_wm_benyoub2024_of(Reader<R> in) {
    const Vec3<R> wo = in.vector(), n = normalised(in.vector()), wm = in.vector();
    const R alpha = in.alpha();
    const Frame<R> f = frame(n);
    return pdf_wm<Ggx>(to_local(f, wo), to_local(f, wm), alpha, alpha);
}

template <class R, R (*f)(const R&, const R&)>
R of_two(Reader<R> in) {
    const R a = in.scalar();
    return f(a, in.scalar());
}
template <class R, R (*f)(const R&, const R&, const R&)>
R of_three(Reader<R> in) {
    const R a = in.scalar(), b = in.scalar();
    return f(a, b, in.scalar());
}
template <class R>
R ggx_slope_cdf_inverse_of(Reader<R> in) {
    const R c = in.scalar(), u = in.u();
    return ggx_slope_cdf_inverse<R>(c, u, 1 - u);
}
template <class R>
R beckmann_slope_cdf_inverse_of(Reader<R> in) {
    const R c = in.scalar();
    return beckmann_slope_cdf_inverse(c, in.u());
}

template <class R>
Vec3<R> reflect_of(Reader<R> in) {
    const Vec3<R> wo = in.vector();
    return reflect(wo, in.vector());
}
template <class R>
Vec3<R> refract_of(Reader<R> in) {
    const Vec3<R> wo = in.vector(), wm = in.vector();
    return refract(wo, wm, in.scalar());
}
template <class R>
Vec3<R> tangent_of(Reader<R> in) {
    return tangent(in.vector());
}
template <class R>
Vec3<R> tangent_along_of(Reader<R> in) {
    const Vec3<R> n = in.vector();
    return tangent_along(n, in.vector());
}
template <class R, Vec3<R> (*map)(const Vec3<R>&, const Vec3<R>&, const Vec3<R>&)>
Vec3<R> by_frame(Reader<R> in) {
    const Vec3<R> w = in.vector(), n = in.vector();
    return map(w, n, in.vector());
}
template <class R>
R jacobian_reflect_of(Reader<R> in) {
    const Vec3<R> wo = in.vector();
    return 1 / (4 * std::abs(dot(wo, in.vector())));
}
template <class R>
R jacobian_refract_of(Reader<R> in) {
    const Vec3<R> wo = in.vector(), wi = in.vector();
    return jacobian_refract(wo, wi, in.scalar());
}

template <class R>
R lambert_pdf_of(Reader<R> in) {
    return lambert_pdf(in.vector());
}
template <class R>
Vec3<R> lambert_direction_of(Reader<R> in) {
    const R u1 = in.u();
    return lambert_direction(u1, in.u());
}

template <class R>
using Slope2 = R (*)(const R&, const R&);

// clang-format off
template <class R>
constexpr Entry<R> entries[] = {
#define VNDF_ENTRIES(name, map, layout)                                  \
    {#name, evaluate_sampler<R, map<R>, Layout::layout>},                \
    {#name "_with_pdf", evaluate_sampler_pdf<R, map<R>, Layout::layout>},
    VNDF_REFERENCE_SAMPLERS(VNDF_ENTRIES)
#undef VNDF_ENTRIES
#define VNDF_ENTRIES(ndf, N, term) {"vndf_" #ndf "_" #term, evaluate_term<R, Terms<N, R>::term>},
#define VNDF_BOTH(term) VNDF_ENTRIES(ggx, Ggx, term) VNDF_ENTRIES(beckmann, Beckmann, term)
    VNDF_BOTH(ndf) VNDF_BOTH(p22) VNDF_BOTH(lambda) VNDF_BOTH(sigma) VNDF_BOTH(g1) VNDF_BOTH(g2)
    VNDF_BOTH(g2_separable) VNDF_BOTH(pdf_wm) VNDF_BOTH(pdf_wi) VNDF_BOTH(pdf_wm_walter2007)
    VNDF_BOTH(weight)
#undef VNDF_ENTRIES
#define VNDF_ENTRIES(ndf, N, term)                                            \
    {"vndf_" #ndf "_" #term "_world", evaluate_term<R, WorldTerms<N, R>::term>}, \
    {"vndf_" #ndf "_" #term "_cosines", evaluate_term<R, CosineTerms<N, R>::term>},
    VNDF_BOTH(ndf) VNDF_BOTH(lambda) VNDF_BOTH(sigma) VNDF_BOTH(g1) VNDF_BOTH(g2) VNDF_BOTH(weight)
    VNDF_BOTH(pdf_wm) VNDF_BOTH(pdf_wi)
#undef VNDF_ENTRIES
#define VNDF_ENTRIES(ndf, N, term) {"vndf_" #ndf "_" #term "_lobe", evaluate_term<R, Terms<N, R>::term>},
    VNDF_BOTH(sigma) VNDF_BOTH(g1) VNDF_BOTH(g2) VNDF_BOTH(weight) VNDF_BOTH(pdf_wm) VNDF_BOTH(pdf_wi)
#undef VNDF_ENTRIES
#define VNDF_ENTRIES(ndf, N, pair)                                              \
    {"vndf_" #ndf "_" #pair, evaluate_pair<R, Terms<N, R>::pair>},              \
    {"vndf_" #ndf "_" #pair "_lobe", evaluate_pair<R, Terms<N, R>::pair>},
    VNDF_BOTH(pdf_wi_both) VNDF_BOTH(eval_pdf)
#undef VNDF_ENTRIES
#undef VNDF_BOTH
    {"vndf_ggx_pdf_wi_eto2023_lobe", evaluate_term<R, ggx_pdf_wi_bounded_of<R, bound<R>>>},
    {"vndf_ggx_pdf_wi_eto2023_polygon_lobe", evaluate_term<R, ggx_pdf_wi_bounded_of<R, polygon_bound<R>>>},
    {"vndf_ggx_pdf_wi_eto2023", evaluate_term<R, ggx_pdf_wi_bounded_of<R, bound<R>>>},
    {"vndf_ggx_pdf_wi_eto2023_polygon", evaluate_term<R, ggx_pdf_wi_bounded_of<R, polygon_bound<R>>>},
    {"vndf_ggx_pdf_wi_conic2026", evaluate_term<R, ggx_pdf_wi_conic2026_of<R>>},
    {"vndf_ggx_pdf_wi_conic2026_lobe", evaluate_term<R, ggx_pdf_wi_conic2026_of<R>>},
    {"vndf_ggx_sigma_visible", evaluate_term<R, ggx_sigma_visible_of<R>>},
    {"vndf_ggx_reflection_probability", evaluate_term<R, ggx_reflection_probability_of<R>>},
    {"vndf_ggx_invert_wi_conic2026", evaluate_inverse<R>},
    {"vndf_ggx_pdf_wi_cone2026", evaluate_term<R, ggx_pdf_wi_cone2026_of<R>>},
    {"vndf_ggx_pdf_wi_cone2026_lobe", evaluate_term<R, ggx_pdf_wi_cone2026_of<R>>},
    {"vndf_ggx_sigma_tilted", evaluate_term<R, ggx_sigma_tilted_of<R>>},
    {"vndf_ggx_cap_mass", evaluate_term<R, ggx_cap_mass_of<R>>},
    {"vndf_ggx_triangle_mass", evaluate_term<R, ggx_polygon_mass_of<R, 3>>},
    {"vndf_ggx_quad_mass", evaluate_term<R, ggx_polygon_mass_of<R, 4>>},
    {"vndf_ggx_pdf_wi_tilted2026", evaluate_term<R, ggx_pdf_wi_tilted2026_of<R>>},
    {"vndf_ggx_pdf_wi_tilted2026_lobe", evaluate_term<R, ggx_pdf_wi_tilted2026_of<R>>},
    {"vndf_ggx_sigma_cap", evaluate_term<R, ggx_sigma_cap_of<R>>},
    {"vndf_ggx_cap_probability", evaluate_term<R, ggx_cap_probability_of<R>>},
    {"vndf_ggx_invert_wi_cone2026", evaluate_cap_inverse<R>},
    {"vndf_ggx_pdf_wm_benyoub2024", evaluate_term<R, ggx_pdf_wm_benyoub2024_of<R>>},
    {"vndf_ggx_slope_pdf", evaluate_term<R, of_two<R, ggx_slope_pdf<R>>>},
    {"vndf_ggx_slope_cdf", evaluate_term<R, of_two<R, ggx_slope_cdf<R>>>},
    {"vndf_ggx_slope_cdf_inverse", evaluate_term<R, ggx_slope_cdf_inverse_of<R>>},
    {"vndf_beckmann_slope_pdf", evaluate_term<R, of_two<R, static_cast<Slope2<R>>(beckmann_slope_pdf<R>)>>},
    {"vndf_beckmann_slope_cdf", evaluate_term<R, of_two<R, beckmann_slope_cdf<R>>>},
    {"vndf_beckmann_slope_cdf_inverse", evaluate_term<R, beckmann_slope_cdf_inverse_of<R>>},
    {"vndf_fresnel_conductor", evaluate_term<R, of_three<R, fresnel_conductor<R>>>},
    {"vndf_fresnel_dielectric", evaluate_term<R, of_two<R, fresnel_dielectric<R>>>},
    {"vndf_fresnel_cos_theta_t", evaluate_term<R, of_two<R, transmitted_cosine<R>>>},
    {"vndf_fresnel_schlick", evaluate_term<R, of_three<R, fresnel_schlick<R>>>},
    {"vndf_fresnel_f82", evaluate_term<R, of_three<R, fresnel_f82<R>>>},
    {"vndf_transmittance", evaluate_term<R, of_two<R, transmittance<R>>>},
    {"vndf_eta_dispersed", evaluate_term<R, of_three<R, eta_dispersed<R>>>},
    {"vndf_lambert_pdf_wi", evaluate_term<R, lambert_pdf_of<R>>},
    {"vndf_lambert_sample_wi", evaluate_vector<R, lambert_direction_of<R>>},
    {"vndf_reflect", evaluate_vector<R, reflect_of<R>>},
    {"vndf_refract", evaluate_vector<R, refract_of<R>>},
    {"vndf_tangent", evaluate_vector<R, tangent_of<R>>},
    {"vndf_tangent_along", evaluate_vector<R, tangent_along_of<R>>},
    {"vndf_to_local", evaluate_vector<R, by_frame<R, to_frame<R>>>},
    {"vndf_to_world", evaluate_vector<R, by_frame<R, from_frame<R>>>},
    {"vndf_jacobian_reflect", evaluate_term<R, jacobian_reflect_of<R>>},
    {"vndf_jacobian_refract", evaluate_term<R, jacobian_refract_of<R>>},
};
// clang-format on

template <class Table>
auto find(const Table& table, std::string_view name) {
    const auto at =
        std::find_if(std::begin(table), std::end(table), [&](const auto& e) { return e.name == name; });
    return at == std::end(table) ? nullptr : at->function;
}

}  // namespace

template <class R>
Evaluation<R> find_evaluation(std::string_view name) {
    return find(entries<R>, name);
}
template Evaluation<double> find_evaluation(std::string_view);
template Evaluation<long double> find_evaluation(std::string_view);

ConditionFunction find_condition(std::string_view sampler) {
    return find(conditions, sampler);
}

double condition(std::string_view sampler, const double* in, Precision precision) {
    const ConditionFunction f = find_condition(sampler);
    if (!f) throw std::invalid_argument("no condition number for " + std::string(sampler));
    return f(in, precision);
}

double rim_margin(std::string_view name, const double* in, Precision precision) {
    Reader<double> reader{in, precision};
    const Vec3<double> wo = normalised(reader.vector());
    if (name == "vndf_ggx_cap_mass") return std::abs(cap_kappa(wo, cap_in(reader)));
    if (name != "vndf_ggx_sigma_tilted" || wo.z > 0) return std::numeric_limits<double>::infinity();
    return std::abs(dot(wo, normalised(reader.vector())));
}

double cap_margin(std::string_view density, const double* in, Precision precision) {
    constexpr double no_cap = std::numeric_limits<double>::infinity();
    if (density.starts_with("vndf_ggx_pdf_wi_cone2026")) {
        Reader<double> reader{in, precision};
        reader.vector();
        const Light<double> cap = cap_in(reader);
        return chord_margin(reader.vector(), cap) / (precision == Precision::f32 ? 0x1p-24 : 0x1p-53);
    }
    if (density.starts_with("vndf_ggx_pdf_wi_tilted2026")) {
        Reader<double> reader{in, precision};
        const Vec3<double> wo = normalised(reader.vector()), ng = normalised(reader.vector());
        // Of a wo across ng the cone of ng is another one, or none.
        const double margin = std::min(std::abs(horizon_margin(reader.vector(), ng)), std::abs(dot(wo, ng)));
        return margin / (precision == Precision::f32 ? 0x1p-24 : 0x1p-53);
    }
    const bool polygon = density.starts_with("vndf_ggx_pdf_wi_eto2023_polygon");
    if (!density.starts_with("vndf_ggx_pdf_wi_eto2023")) return no_cap;  // other arguments, too
    Reader<double> reader{in, precision};
    const Vec3<double> wo = reader.vector(), wi = reader.vector();
    if (!(wo.z > 0)) return no_cap;
    const View<double> v = reader.stretched(wo);
    const Margin<double> margin = eto_margin(wo, wi, v, polygon ? polygon_bound(v, wo) : bound(v, wo));
    return margin.inside / (margin.per_unit * (precision == Precision::f32 ? 0x1p-24 : 0x1p-53));
}

}  // namespace vndf::reference
