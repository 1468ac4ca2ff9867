// Seeded mistakes in ggx_lobe.h: rows of Mutant (mutants.h).
{"squares of a nearly vertical view direction underflow",
 "ggx_lobe.h",
 "VNDF_REAL kx = v.alpha_x * wo.x * VNDF_R(134217728.0), ky = v.alpha_y * wo.y * VNDF_R(134217728.0);\n"
 "    VNDF_REAL l2 = VNDF_FMA(kx, kx, ky * ky);\n"
 "    v.axis = vndf_impl_axis_of(l2, wo.z * VNDF_R(134217728.0));",
 "VNDF_REAL kx = v.alpha_x * wo.x, ky = v.alpha_y * wo.y, l2 = VNDF_FMA(kx, kx, ky * ky);\n"
 "    v.axis = vndf_impl_axis_of(l2, wo.z);",
 "vndf_ggx_sample_wm_heitz_deon2014_exact",
 {"pointwise, core"}},
