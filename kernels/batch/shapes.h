// The registry's argument and result tokens, spelt out: the scalars of a function in order, and how a call is
// made of them. Read by the OpenCL entry points, by the host build of the same functions and by the registry.
//
//   VNDF_SCALARS_<token>(S)  S(wo_x) S(wo_y) ... : one S(...) for each scalar
//   VNDF_CALL_<token>        the call's arguments, made of variables named like the scalars
//   VNDF_ARGUMENTS_<token>   the call's arguments as documented
//   VNDF_RESULTS_<result>(S) S(wm_x, .x) ... : one S(scalar, member of the returned vector) for each result
//   VNDF_TYPE_<result>       the type returned; <result>_PDF is what a sampler's _with_pdf form returns
#ifndef VNDF_BATCH_SHAPES_H
#define VNDF_BATCH_SHAPES_H

#define VNDF_SCALARS2(S, v) S(v##_x) S(v##_y)
#define VNDF_SCALARS3(S, v) S(v##_x) S(v##_y) S(v##_z)
#define VNDF_CALL2(v) VNDF_MAKE2(v##_x, v##_y)
#define VNDF_CALL3(v) VNDF_MAKE3(v##_x, v##_y, v##_z)

#define VNDF_SCALARS_U(S) S(u1) S(u2)
#define VNDF_CALL_U VNDF_MAKE2(u1, u2)
#define VNDF_ARGUMENTS_U "u"

#define VNDF_SCALARS_WO_ALPHA_U(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS2(S, alpha) VNDF_SCALARS_U(S)
#define VNDF_CALL_WO_ALPHA_U VNDF_CALL3(wo), VNDF_CALL2(alpha), VNDF_CALL_U
#define VNDF_ARGUMENTS_WO_ALPHA_U "wo, alpha, u"

#define VNDF_SCALARS_WO_ALPHA1_U(S) VNDF_SCALARS3(S, wo) S(alpha) VNDF_SCALARS_U(S)
#define VNDF_CALL_WO_ALPHA1_U VNDF_CALL3(wo), alpha, VNDF_CALL_U
#define VNDF_ARGUMENTS_WO_ALPHA1_U "wo, alpha, u"

#define VNDF_SCALARS_WO_N_ALPHA1_U(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, n) S(alpha) VNDF_SCALARS_U(S)
#define VNDF_CALL_WO_N_ALPHA1_U VNDF_CALL3(wo), VNDF_CALL3(n), alpha, VNDF_CALL_U
#define VNDF_ARGUMENTS_WO_N_ALPHA1_U "wo, n, alpha, u"

#define VNDF_SCALARS_ALPHA_U(S) VNDF_SCALARS2(S, alpha) VNDF_SCALARS_U(S)
#define VNDF_CALL_ALPHA_U VNDF_CALL2(alpha), VNDF_CALL_U
#define VNDF_ARGUMENTS_ALPHA_U "alpha, u"

#define VNDF_SCALARS_WM_ALPHA(S) VNDF_SCALARS3(S, wm) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WM_ALPHA VNDF_CALL3(wm), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WM_ALPHA "wm, alpha"

#define VNDF_SCALARS_W_ALPHA(S) VNDF_SCALARS3(S, w) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_W_ALPHA VNDF_CALL3(w), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_W_ALPHA "w, alpha"

#define VNDF_SCALARS_SLOPE_ALPHA(S) VNDF_SCALARS2(S, slope) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_SLOPE_ALPHA VNDF_CALL2(slope), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_SLOPE_ALPHA "slope, alpha"

#define VNDF_SCALARS_WO_WI_ALPHA(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, wi) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_WI_ALPHA VNDF_CALL3(wo), VNDF_CALL3(wi), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_WI_ALPHA "wo, wi, alpha"

#define VNDF_SCALARS_WO_WM_ALPHA(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, wm) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_WM_ALPHA VNDF_CALL3(wo), VNDF_CALL3(wm), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_WM_ALPHA "wo, wm, alpha"

#define VNDF_SCALARS_WO_N_WM_ALPHA1(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, n) VNDF_SCALARS3(S, wm) S(alpha)
#define VNDF_CALL_WO_N_WM_ALPHA1 VNDF_CALL3(wo), VNDF_CALL3(n), VNDF_CALL3(wm), alpha
#define VNDF_ARGUMENTS_WO_N_WM_ALPHA1 "wo, n, wm, alpha"

#define VNDF_SCALARS_COS_THETA_X(S) S(cos_theta) S(x)
#define VNDF_CALL_COS_THETA_X cos_theta, x
#define VNDF_ARGUMENTS_COS_THETA_X "cos_theta, x"

#define VNDF_SCALARS_COS_THETA_U1(S) S(cos_theta) S(u1)
#define VNDF_CALL_COS_THETA_U1 cos_theta, u1
#define VNDF_ARGUMENTS_COS_THETA_U1 "cos_theta, u1"

#define VNDF_SCALARS_COS_THETA_ETA_K(S) S(cos_theta) S(eta) S(k)
#define VNDF_CALL_COS_THETA_ETA_K cos_theta, eta, k
#define VNDF_ARGUMENTS_COS_THETA_ETA_K "cos_theta, eta, k"

#define VNDF_SCALARS_COS_THETA_ETA(S) S(cos_theta) S(eta)
#define VNDF_CALL_COS_THETA_ETA cos_theta, eta
#define VNDF_ARGUMENTS_COS_THETA_ETA "cos_theta, eta"

#define VNDF_SCALARS_DISTANCE_SIGMA(S) S(distance) S(sigma)
#define VNDF_CALL_DISTANCE_SIGMA distance, sigma
#define VNDF_ARGUMENTS_DISTANCE_SIGMA "distance, sigma"

#define VNDF_SCALARS_ETA_DISPERSION(S) S(eta) S(dispersion) S(wavelength)
#define VNDF_CALL_ETA_DISPERSION eta, dispersion, wavelength
#define VNDF_ARGUMENTS_ETA_DISPERSION "eta, dispersion, wavelength"

#define VNDF_SCALARS_COS_THETA_F0_F90(S) S(cos_theta) S(f0) S(f90)
#define VNDF_CALL_COS_THETA_F0_F90 cos_theta, f0, f90
#define VNDF_ARGUMENTS_COS_THETA_F0_F90 "cos_theta, f0, f90"

#define VNDF_SCALARS_COS_THETA_F0_TINT(S) S(cos_theta) S(f0) S(tint)
#define VNDF_CALL_COS_THETA_F0_TINT cos_theta, f0, tint
#define VNDF_ARGUMENTS_COS_THETA_F0_TINT "cos_theta, f0, tint"

#define VNDF_SCALARS_WI(S) VNDF_SCALARS3(S, wi)
#define VNDF_CALL_WI VNDF_CALL3(wi)
#define VNDF_ARGUMENTS_WI "wi"

#define VNDF_SCALARS_WO_WM(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, wm)
#define VNDF_CALL_WO_WM VNDF_CALL3(wo), VNDF_CALL3(wm)
#define VNDF_ARGUMENTS_WO_WM "wo, wm"

#define VNDF_SCALARS_WO_WM_ETA(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, wm) S(eta)
#define VNDF_CALL_WO_WM_ETA VNDF_CALL3(wo), VNDF_CALL3(wm), eta
#define VNDF_ARGUMENTS_WO_WM_ETA "wo, wm, eta"

#define VNDF_SCALARS_WO_WI_ETA(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, wi) S(eta)
#define VNDF_CALL_WO_WI_ETA VNDF_CALL3(wo), VNDF_CALL3(wi), eta
#define VNDF_ARGUMENTS_WO_WI_ETA "wo, wi, eta"

// Of a cap of directions.
#define VNDF_SCALARS_CAP(S) VNDF_SCALARS3(S, l) S(one_minus_cos)
#define VNDF_CALL_CAP VNDF_CALL3(l), one_minus_cos

#define VNDF_SCALARS_WO_CAP_ALPHA(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS_CAP(S) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_CAP_ALPHA VNDF_CALL3(wo), VNDF_CALL_CAP, VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_CAP_ALPHA "wo, l, one_minus_cos, alpha"

#define VNDF_SCALARS_WO_CAP_ALPHA_U(S) VNDF_SCALARS_WO_CAP_ALPHA(S) VNDF_SCALARS_U(S)
#define VNDF_CALL_WO_CAP_ALPHA_U VNDF_CALL_WO_CAP_ALPHA, VNDF_CALL_U
#define VNDF_ARGUMENTS_WO_CAP_ALPHA_U "wo, l, one_minus_cos, alpha, u"

#define VNDF_SCALARS_WO_CAP_WI_ALPHA(S) \
    VNDF_SCALARS3(S, wo) VNDF_SCALARS_CAP(S) VNDF_SCALARS3(S, wi) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_CAP_WI_ALPHA VNDF_CALL3(wo), VNDF_CALL_CAP, VNDF_CALL3(wi), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_CAP_WI_ALPHA "wo, l, one_minus_cos, wi, alpha"

// Of a spherical triangle or quadrilateral.
#define VNDF_SCALARS_WO_ABC_ALPHA(S) \
    VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, a) VNDF_SCALARS3(S, b) VNDF_SCALARS3(S, c) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_ABC_ALPHA VNDF_CALL3(wo), VNDF_CALL3(a), VNDF_CALL3(b), VNDF_CALL3(c), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_ABC_ALPHA "wo, a, b, c, alpha"

#define VNDF_SCALARS_WO_ABCD_ALPHA(S) \
    VNDF_SCALARS3(S, wo)              \
    VNDF_SCALARS3(S, a) VNDF_SCALARS3(S, b) VNDF_SCALARS3(S, c) VNDF_SCALARS3(S, d) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_ABCD_ALPHA \
    VNDF_CALL3(wo), VNDF_CALL3(a), VNDF_CALL3(b), VNDF_CALL3(c), VNDF_CALL3(d), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_ABCD_ALPHA "wo, a, b, c, d, alpha"

// With a geometric normal in the local frame.
#define VNDF_SCALARS_WO_NG_ALPHA(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, ng) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_NG_ALPHA VNDF_CALL3(wo), VNDF_CALL3(ng), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_NG_ALPHA "wo, ng, alpha"

#define VNDF_SCALARS_WO_NG_ALPHA_U(S) VNDF_SCALARS_WO_NG_ALPHA(S) VNDF_SCALARS_U(S)
#define VNDF_CALL_WO_NG_ALPHA_U VNDF_CALL_WO_NG_ALPHA, VNDF_CALL_U
#define VNDF_ARGUMENTS_WO_NG_ALPHA_U "wo, ng, alpha, u"

#define VNDF_SCALARS_WO_NG_WI_ALPHA(S) \
    VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, ng) VNDF_SCALARS3(S, wi) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_WO_NG_WI_ALPHA VNDF_CALL3(wo), VNDF_CALL3(ng), VNDF_CALL3(wi), VNDF_CALL2(alpha)
#define VNDF_ARGUMENTS_WO_NG_WI_ALPHA "wo, ng, wi, alpha"

// About a normal, by cosines, and frames.
#define VNDF_SCALARS_W_N_ALPHA1(S) VNDF_SCALARS3(S, w) VNDF_SCALARS3(S, n) S(alpha)
#define VNDF_CALL_W_N_ALPHA1 VNDF_CALL3(w), VNDF_CALL3(n), alpha
#define VNDF_ARGUMENTS_W_N_ALPHA1 "w, n, alpha"

#define VNDF_SCALARS_WM_N_ALPHA1(S) VNDF_SCALARS3(S, wm) VNDF_SCALARS3(S, n) S(alpha)
#define VNDF_CALL_WM_N_ALPHA1 VNDF_CALL3(wm), VNDF_CALL3(n), alpha
#define VNDF_ARGUMENTS_WM_N_ALPHA1 "wm, n, alpha"

#define VNDF_SCALARS_WO_N_WI_ALPHA1(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS3(S, n) VNDF_SCALARS3(S, wi) S(alpha)
#define VNDF_CALL_WO_N_WI_ALPHA1 VNDF_CALL3(wo), VNDF_CALL3(n), VNDF_CALL3(wi), alpha
#define VNDF_ARGUMENTS_WO_N_WI_ALPHA1 "wo, n, wi, alpha"

#define VNDF_SCALARS_COS_ALPHA1(S) S(cos_theta) S(alpha)
#define VNDF_CALL_COS_ALPHA1 cos_theta, alpha
#define VNDF_ARGUMENTS_COS_ALPHA1 "cos_theta, alpha"

#define VNDF_SCALARS_COS_M_ALPHA1(S) S(cos_theta_m) S(alpha)
#define VNDF_CALL_COS_M_ALPHA1 cos_theta_m, alpha
#define VNDF_ARGUMENTS_COS_M_ALPHA1 "cos_theta_m, alpha"

#define VNDF_SCALARS_COS_O_I_ALPHA1(S) S(cos_theta_o) S(cos_theta_i) S(alpha)
#define VNDF_CALL_COS_O_I_ALPHA1 cos_theta_o, cos_theta_i, alpha
#define VNDF_ARGUMENTS_COS_O_I_ALPHA1 "cos_theta_o, cos_theta_i, alpha"

#define VNDF_SCALARS_COS_O_M_ALPHA1(S) S(cos_theta_o) S(cos_theta_m) S(alpha)
#define VNDF_CALL_COS_O_M_ALPHA1 cos_theta_o, cos_theta_m, alpha
#define VNDF_ARGUMENTS_COS_O_M_ALPHA1 "cos_theta_o, cos_theta_m, alpha"

#define VNDF_SCALARS_COS_O_M_OM_ALPHA1(S) S(cos_theta_o) S(cos_theta_m) S(wo_dot_wm) S(alpha)
#define VNDF_CALL_COS_O_M_OM_ALPHA1 cos_theta_o, cos_theta_m, wo_dot_wm, alpha
#define VNDF_ARGUMENTS_COS_O_M_OM_ALPHA1 "cos_theta_o, cos_theta_m, wo_dot_wm, alpha"

#define VNDF_SCALARS_N(S) VNDF_SCALARS3(S, n)
#define VNDF_CALL_N VNDF_CALL3(n)
#define VNDF_ARGUMENTS_N "n"

#define VNDF_SCALARS_N_W(S) VNDF_SCALARS3(S, n) VNDF_SCALARS3(S, w)
#define VNDF_CALL_N_W VNDF_CALL3(n), VNDF_CALL3(w)
#define VNDF_ARGUMENTS_N_W "n, w"

#define VNDF_SCALARS_W_N_T(S) VNDF_SCALARS3(S, w) VNDF_SCALARS3(S, n) VNDF_SCALARS3(S, t)
#define VNDF_CALL_W_N_T VNDF_CALL3(w), VNDF_CALL3(n), VNDF_CALL3(t)
#define VNDF_ARGUMENTS_W_N_T "w, n, t"

// Of a lobe, set up on the spot.
#define VNDF_SCALARS_CONIC2026_LOBE_U(S) VNDF_SCALARS_WO_ALPHA_U(S)
#define VNDF_CALL_CONIC2026_LOBE_U vndf_ggx_conic2026_lobe(VNDF_CALL3(wo), VNDF_CALL2(alpha)), VNDF_CALL_U
#define VNDF_ARGUMENTS_CONIC2026_LOBE_U "lobe, u"

#define VNDF_SCALARS_CONIC2026_LOBE_WI(S) VNDF_SCALARS_WO_WI_ALPHA(S)
#define VNDF_CALL_CONIC2026_LOBE_WI vndf_ggx_conic2026_lobe(VNDF_CALL3(wo), VNDF_CALL2(alpha)), VNDF_CALL3(wi)
#define VNDF_ARGUMENTS_CONIC2026_LOBE_WI "lobe, wi"

#define VNDF_SCALARS_CONE2026_LOBE_U(S) VNDF_SCALARS_WO_CAP_ALPHA_U(S)
#define VNDF_CALL_CONE2026_LOBE_U vndf_ggx_cone2026_lobe(VNDF_CALL_WO_CAP_ALPHA), VNDF_CALL_U
#define VNDF_ARGUMENTS_CONE2026_LOBE_U "lobe, u"

#define VNDF_SCALARS_CONE2026_LOBE_WI(S) VNDF_SCALARS_WO_CAP_WI_ALPHA(S)
#define VNDF_CALL_CONE2026_LOBE_WI vndf_ggx_cone2026_lobe(VNDF_CALL_WO_CAP_ALPHA), VNDF_CALL3(wi)
#define VNDF_ARGUMENTS_CONE2026_LOBE_WI "lobe, wi"

#define VNDF_ARGUMENTS_LOBE_CAP "lobe, l, one_minus_cos"

#define VNDF_SCALARS_TILTED2026_LOBE_U(S) VNDF_SCALARS_WO_NG_ALPHA_U(S)
#define VNDF_CALL_TILTED2026_LOBE_U vndf_ggx_tilted2026_lobe(VNDF_CALL_WO_NG_ALPHA), VNDF_CALL_U
#define VNDF_ARGUMENTS_TILTED2026_LOBE_U "lobe, u"

#define VNDF_SCALARS_TILTED2026_LOBE_WI(S) VNDF_SCALARS_WO_NG_WI_ALPHA(S)
#define VNDF_CALL_TILTED2026_LOBE_WI vndf_ggx_tilted2026_lobe(VNDF_CALL_WO_NG_ALPHA), VNDF_CALL3(wi)
#define VNDF_ARGUMENTS_TILTED2026_LOBE_WI "lobe, wi"

#define VNDF_ARGUMENTS_LOBE_NG "lobe, ng"

#define VNDF_SCALARS_LOBE_U(S) VNDF_SCALARS_WO_ALPHA_U(S)
#define VNDF_CALL_LOBE_U vndf_ggx_lobe_of(VNDF_CALL3(wo), VNDF_CALL2(alpha)), VNDF_CALL_U
#define VNDF_ARGUMENTS_LOBE_U "lobe, u"

#define VNDF_SCALARS_LOBE_WI(S) VNDF_SCALARS_WO_WI_ALPHA(S)
#define VNDF_CALL_LOBE_WI vndf_ggx_lobe_of(VNDF_CALL3(wo), VNDF_CALL2(alpha)), VNDF_CALL3(wi)
#define VNDF_ARGUMENTS_LOBE_WI "lobe, wi"

#define VNDF_SCALARS_LOBE_WM(S) VNDF_SCALARS_WO_WM_ALPHA(S)
#define VNDF_CALL_LOBE_WM vndf_ggx_lobe_of(VNDF_CALL3(wo), VNDF_CALL2(alpha)), VNDF_CALL3(wm)
#define VNDF_ARGUMENTS_LOBE_WM "lobe, wm"

#define VNDF_SCALARS_LOBE(S) VNDF_SCALARS3(S, wo) VNDF_SCALARS2(S, alpha)
#define VNDF_CALL_LOBE vndf_ggx_lobe_of(VNDF_CALL3(wo), VNDF_CALL2(alpha))
#define VNDF_ARGUMENTS_LOBE "lobe"

#define VNDF_SCALARS_BECKMANN_LOBE(S) VNDF_SCALARS_LOBE(S)
#define VNDF_CALL_BECKMANN_LOBE vndf_beckmann_lobe_of(VNDF_CALL3(wo), VNDF_CALL2(alpha))
#define VNDF_ARGUMENTS_BECKMANN_LOBE "lobe"

#define VNDF_SCALARS_BECKMANN_LOBE_U(S) VNDF_SCALARS_WO_ALPHA_U(S)
#define VNDF_CALL_BECKMANN_LOBE_U VNDF_CALL_BECKMANN_LOBE, VNDF_CALL_U
#define VNDF_ARGUMENTS_BECKMANN_LOBE_U "lobe, u"

#define VNDF_SCALARS_BECKMANN_LOBE_WI(S) VNDF_SCALARS_WO_WI_ALPHA(S)
#define VNDF_CALL_BECKMANN_LOBE_WI VNDF_CALL_BECKMANN_LOBE, VNDF_CALL3(wi)
#define VNDF_ARGUMENTS_BECKMANN_LOBE_WI "lobe, wi"

#define VNDF_SCALARS_BECKMANN_LOBE_WM(S) VNDF_SCALARS_WO_WM_ALPHA(S)
#define VNDF_CALL_BECKMANN_LOBE_WM VNDF_CALL_BECKMANN_LOBE, VNDF_CALL3(wm)
#define VNDF_ARGUMENTS_BECKMANN_LOBE_WM "lobe, wm"

#define VNDF_ARGUMENTS_WO_ALPHA "wo, alpha"

#define VNDF_RESULTS_VALUE(S) S(value, )
#define VNDF_RESULTS_PDF_BOTH(S) S(pdf, .x) S(pdf_back, .y)
#define VNDF_RESULTS_EVAL_PDF(S) S(value, .x) S(pdf, .y)
#define VNDF_RESULTS_U(S) S(u1, .x) S(u2, .y)
#define VNDF_RESULTS_WM(S) S(wm_x, .x) S(wm_y, .y) S(wm_z, .z)
#define VNDF_RESULTS_WI(S) S(wi_x, .x) S(wi_y, .y) S(wi_z, .z)
#define VNDF_RESULTS_T(S) S(t_x, .x) S(t_y, .y) S(t_z, .z)
#define VNDF_RESULTS_V(S) S(v_x, .x) S(v_y, .y) S(v_z, .z)
#define VNDF_RESULTS_WM_PDF(S) VNDF_RESULTS_WM(S) S(pdf, .w)
#define VNDF_RESULTS_WI_PDF(S) VNDF_RESULTS_WI(S) S(pdf, .w)

#define VNDF_TYPE_VALUE VNDF_REAL
#define VNDF_TYPE_PDF_BOTH VNDF_REAL2
#define VNDF_TYPE_EVAL_PDF VNDF_REAL2
#define VNDF_TYPE_U VNDF_REAL2
#define VNDF_TYPE_WM VNDF_REAL3
#define VNDF_TYPE_WI VNDF_REAL3
#define VNDF_TYPE_T VNDF_REAL3
#define VNDF_TYPE_V VNDF_REAL3
#define VNDF_TYPE_WM_PDF VNDF_REAL4
#define VNDF_TYPE_WI_PDF VNDF_REAL4

#endif
