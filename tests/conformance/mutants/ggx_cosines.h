// Seeded mistakes in ggx_cosines.h: rows of Mutant (mutants.h).
{"by cosines: all normals seen alike",
 "ggx_cosines.h",
 "vndf_impl_of_next_cosine(cos_theta_m, o), wo_dot_wm);",
 "vndf_impl_of_next_cosine(cos_theta_m, o), wo_dot_wm > VNDF_R(0.0) ? VNDF_R(1.0) : VNDF_R(0.0));",
 "vndf_ggx_pdf_wm_cosines",
 {"pointwise, maximum", "integral"}},
