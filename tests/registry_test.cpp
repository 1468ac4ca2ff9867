#include "registry.h"

#include <algorithm>
#include <map>
#include <set>

#include "support/catch.h"

namespace {

using namespace vndf;
using Names = std::vector<std::string>;

TEST_CASE("a function takes the scalars that its arguments stand for, in their order") {
    const std::map<std::string, Names> scalars = {
        {"WO_ALPHA_U", {"wo_x", "wo_y", "wo_z", "alpha_x", "alpha_y", "u1", "u2"}},
        {"WO_ALPHA1_U", {"wo_x", "wo_y", "wo_z", "alpha", "u1", "u2"}},
        {"WO_N_ALPHA1_U", {"wo_x", "wo_y", "wo_z", "n_x", "n_y", "n_z", "alpha", "u1", "u2"}},
        {"ALPHA_U", {"alpha_x", "alpha_y", "u1", "u2"}},
        {"WM_ALPHA", {"wm_x", "wm_y", "wm_z", "alpha_x", "alpha_y"}},
        {"W_ALPHA", {"w_x", "w_y", "w_z", "alpha_x", "alpha_y"}},
        {"SLOPE_ALPHA", {"slope_x", "slope_y", "alpha_x", "alpha_y"}},
        {"WO_WI_ALPHA", {"wo_x", "wo_y", "wo_z", "wi_x", "wi_y", "wi_z", "alpha_x", "alpha_y"}},
        {"WO_WM_ALPHA", {"wo_x", "wo_y", "wo_z", "wm_x", "wm_y", "wm_z", "alpha_x", "alpha_y"}},
        {"WO_N_WM_ALPHA1", {"wo_x", "wo_y", "wo_z", "n_x", "n_y", "n_z", "wm_x", "wm_y", "wm_z", "alpha"}},
        {"W_N_ALPHA1", {"w_x", "w_y", "w_z", "n_x", "n_y", "n_z", "alpha"}},
        {"WM_N_ALPHA1", {"wm_x", "wm_y", "wm_z", "n_x", "n_y", "n_z", "alpha"}},
        {"WO_N_WI_ALPHA1", {"wo_x", "wo_y", "wo_z", "n_x", "n_y", "n_z", "wi_x", "wi_y", "wi_z", "alpha"}},
        {"COS_ALPHA1", {"cos_theta", "alpha"}},
        {"COS_M_ALPHA1", {"cos_theta_m", "alpha"}},
        {"COS_O_I_ALPHA1", {"cos_theta_o", "cos_theta_i", "alpha"}},
        {"COS_O_M_ALPHA1", {"cos_theta_o", "cos_theta_m", "alpha"}},
        {"COS_O_M_OM_ALPHA1", {"cos_theta_o", "cos_theta_m", "wo_dot_wm", "alpha"}},
        {"N", {"n_x", "n_y", "n_z"}},
        {"N_W", {"n_x", "n_y", "n_z", "w_x", "w_y", "w_z"}},
        {"W_N_T", {"w_x", "w_y", "w_z", "n_x", "n_y", "n_z", "t_x", "t_y", "t_z"}},
        {"CONIC2026_LOBE_U", {"wo_x", "wo_y", "wo_z", "alpha_x", "alpha_y", "u1", "u2"}},
        {"CONIC2026_LOBE_WI", {"wo_x", "wo_y", "wo_z", "wi_x", "wi_y", "wi_z", "alpha_x", "alpha_y"}},
        {"WO_CAP_ALPHA",
         {"wo_x", "wo_y", "wo_z", "l_x", "l_y", "l_z", "one_minus_cos", "alpha_x", "alpha_y"}},
        {"WO_CAP_ALPHA_U",
         {"wo_x", "wo_y", "wo_z", "l_x", "l_y", "l_z", "one_minus_cos", "alpha_x", "alpha_y", "u1", "u2"}},
        {"WO_CAP_WI_ALPHA",
         {"wo_x", "wo_y", "wo_z", "l_x", "l_y", "l_z", "one_minus_cos", "wi_x", "wi_y", "wi_z", "alpha_x",
          "alpha_y"}},
        {"CONE2026_LOBE_U",
         {"wo_x", "wo_y", "wo_z", "l_x", "l_y", "l_z", "one_minus_cos", "alpha_x", "alpha_y", "u1", "u2"}},
        {"CONE2026_LOBE_WI",
         {"wo_x", "wo_y", "wo_z", "l_x", "l_y", "l_z", "one_minus_cos", "wi_x", "wi_y", "wi_z", "alpha_x",
          "alpha_y"}},
        {"WO_NG_ALPHA", {"wo_x", "wo_y", "wo_z", "ng_x", "ng_y", "ng_z", "alpha_x", "alpha_y"}},
        {"WO_NG_ALPHA_U", {"wo_x", "wo_y", "wo_z", "ng_x", "ng_y", "ng_z", "alpha_x", "alpha_y", "u1", "u2"}},
        {"WO_NG_WI_ALPHA",
         {"wo_x", "wo_y", "wo_z", "ng_x", "ng_y", "ng_z", "wi_x", "wi_y", "wi_z", "alpha_x", "alpha_y"}},
        {"TILTED2026_LOBE_U",
         {"wo_x", "wo_y", "wo_z", "ng_x", "ng_y", "ng_z", "alpha_x", "alpha_y", "u1", "u2"}},
        {"TILTED2026_LOBE_WI",
         {"wo_x", "wo_y", "wo_z", "ng_x", "ng_y", "ng_z", "wi_x", "wi_y", "wi_z", "alpha_x", "alpha_y"}},
        {"WO_ABC_ALPHA",
         {"wo_x", "wo_y", "wo_z", "a_x", "a_y", "a_z", "b_x", "b_y", "b_z", "c_x", "c_y", "c_z", "alpha_x",
          "alpha_y"}},
        {"WO_ABCD_ALPHA",
         {"wo_x", "wo_y", "wo_z", "a_x", "a_y", "a_z", "b_x", "b_y", "b_z", "c_x", "c_y", "c_z", "d_x", "d_y",
          "d_z", "alpha_x", "alpha_y"}},
        {"LOBE_U", {"wo_x", "wo_y", "wo_z", "alpha_x", "alpha_y", "u1", "u2"}},
        {"LOBE_WI", {"wo_x", "wo_y", "wo_z", "wi_x", "wi_y", "wi_z", "alpha_x", "alpha_y"}},
        {"LOBE_WM", {"wo_x", "wo_y", "wo_z", "wm_x", "wm_y", "wm_z", "alpha_x", "alpha_y"}},
        {"LOBE", {"wo_x", "wo_y", "wo_z", "alpha_x", "alpha_y"}},
        {"BECKMANN_LOBE", {"wo_x", "wo_y", "wo_z", "alpha_x", "alpha_y"}},
        {"BECKMANN_LOBE_U", {"wo_x", "wo_y", "wo_z", "alpha_x", "alpha_y", "u1", "u2"}},
        {"BECKMANN_LOBE_WI", {"wo_x", "wo_y", "wo_z", "wi_x", "wi_y", "wi_z", "alpha_x", "alpha_y"}},
        {"BECKMANN_LOBE_WM", {"wo_x", "wo_y", "wo_z", "wm_x", "wm_y", "wm_z", "alpha_x", "alpha_y"}},
        {"COS_THETA_X", {"cos_theta", "x"}},
        {"COS_THETA_U1", {"cos_theta", "u1"}},
        {"COS_THETA_ETA_K", {"cos_theta", "eta", "k"}},
        {"COS_THETA_ETA", {"cos_theta", "eta"}},
        {"DISTANCE_SIGMA", {"distance", "sigma"}},
        {"ETA_DISPERSION", {"eta", "dispersion", "wavelength"}},
        {"COS_THETA_F0_F90", {"cos_theta", "f0", "f90"}},
        {"COS_THETA_F0_TINT", {"cos_theta", "f0", "tint"}},
        {"U", {"u1", "u2"}},
        {"WI", {"wi_x", "wi_y", "wi_z"}},
        {"WO_WM", {"wo_x", "wo_y", "wo_z", "wm_x", "wm_y", "wm_z"}},
        {"WO_WM_ETA", {"wo_x", "wo_y", "wo_z", "wm_x", "wm_y", "wm_z", "eta"}},
        {"WO_WI_ETA", {"wo_x", "wo_y", "wo_z", "wi_x", "wi_y", "wi_z", "eta"}},
    };
    std::set<std::string> used;
    for (const Function& f : functions()) {
        CAPTURE(f.name);
        REQUIRE(scalars.count(f.arguments));
        CHECK(f.inputs == scalars.at(f.arguments));
        used.insert(f.arguments);
    }
    CHECK(used.size() == scalars.size());
}

TEST_CASE("a function returns a direction, a value or two, and with_pdf a density behind it") {
    for (const Function& f : functions()) {
        CAPTURE(f.name);
        Names expected = {"value"};
        if (f.result == "WM") expected = {"wm_x", "wm_y", "wm_z"};
        if (f.result == "WI") expected = {"wi_x", "wi_y", "wi_z"};
        if (f.result == "T") expected = {"t_x", "t_y", "t_z"};
        if (f.result == "V") expected = {"v_x", "v_y", "v_z"};
        if (f.result == "U") expected = {"u1", "u2"};
        if (f.result == "PDF_BOTH") expected = {"pdf", "pdf_back"};
        if (f.result == "EVAL_PDF") expected = {"value", "pdf"};
        CHECK((f.kind == Kind::pair) == (f.result == "PDF_BOTH" || f.result == "EVAL_PDF"));
        if (f.with_pdf) expected.push_back("pdf");
        CHECK(f.outputs == expected);
        CHECK(f.name.ends_with("_with_pdf") == f.with_pdf);
    }
}

TEST_CASE("every sampler is followed by its with_pdf form, and its density is a registered function") {
    std::size_t samplers = 0;
    for (std::size_t i = 0; i < functions().size(); ++i) {
        const Function& f = functions()[i];
        if (f.kind != Kind::sampler || f.with_pdf) continue;
        CAPTURE(f.name);
        REQUIRE(i + 1 < functions().size());
        CHECK(functions()[i + 1].name == f.name + "_with_pdf");
        CHECK(functions()[i + 1].with_pdf);
        const Function* density = find_function(f.density);
        REQUIRE(density != nullptr);
        CHECK(density->kind == Kind::density);
        for (const Bounds& bounds : {f.float_bounds, f.double_bounds}) {
            const SamplerBounds& s = bounds.sampler;
            CHECK(s.front > 0);
            // A number where a wo can be back-facing, and only there.
            const bool back = f.domain == Domain::sphere && f.inputs.front() == "wo_x";
            CHECK((back ? s.back > 0 : s.back == 0));
            CHECK(std::min({s.core, s.core_max, s.pdf, s.pdf_core_max}) > 0);
            CHECK((f.method == Method::exact ? s.agreement > 0 : s.agreement == 0));
        }
        ++samplers;
    }
    CHECK(samplers >= 15);
    CHECK(functions().size() >= 2 * samplers + 38);
}

TEST_CASE("a function is found by its exact name alone") {
    for (const Function& f : functions()) CHECK(find_function(f.name) == &f);
    CHECK(find_function("vndf_ggx_sample_wm_dupuy") == nullptr);
    CHECK(find_function("VNDF_GGX_LAMBDA") == nullptr);
    CHECK(find_function("") == nullptr);
}

TEST_CASE("the nearest names are those that a slip of the keyboard leads to") {
    CHECK(nearest_names("vndf_ggx_lamda").front() == "vndf_ggx_lambda");
    CHECK(nearest_names("vndf_beckman_g1").front() == "vndf_beckmann_g1");
    CHECK(nearest_names("ggx_sample_wm_dupuy2023").front() == "vndf_ggx_sample_wm_dupuy2023");
    CHECK(nearest_names("vndf_reflect", 2) == Names{"vndf_reflect", "vndf_refract"});
    CHECK(nearest_names("x", 1000).size() == functions().size());
}

}  // namespace
