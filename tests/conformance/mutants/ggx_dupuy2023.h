// Seeded mistakes in ggx_dupuy2023.h: rows of Mutant (mutants.h).
{"cap: a warp that does not take the sample",
 "ggx_dupuy2023.h",
 "vndf_impl_cap_half(lobe, u)",
 "vndf_impl_cap_half(lobe, VNDF_MAKE2(VNDF_R(0.25), VNDF_R(0.25)))",
 "vndf_ggx_sample_wm_dupuy2023",
 {"KS of pivot 1", "KS of pivot 2", "pointwise"}},
    {"u rounded differently in the form with a density",
     "ggx_dupuy2023.h",
     "vndf_impl_direction_pdf(vndf_impl_ggx_dupuy2023(vndf_ggx_lobe_of(wo, alpha), u))",
     "vndf_impl_direction_pdf(vndf_impl_ggx_dupuy2023(vndf_ggx_lobe_of(wo, alpha), VNDF_MAKE2(u.x, u.y * "
     "VNDF_R(0.9999999))))",
     "vndf_ggx_sample_wm_dupuy2023_with_pdf",
     {"same direction as the plain form"}},
