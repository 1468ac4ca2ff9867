// Seeded mistakes in bsdf_lambert.h: rows of Mutant (mutants.h).
{"a uniform hemisphere", "bsdf_lambert.h",         "radius = VNDF_SQRT(u2);",
 "radius = u2;",         "vndf_lambert_sample_wi", {"pointwise, maximum"}},
    {"a density over a whole sphere",   "bsdf_lambert.h",      "VNDF_1_PI * vndf_impl_max(wi.z, VNDF_R(0.0))",
     "VNDF_1_PI * vndf_impl_abs(wi.z)", "vndf_lambert_pdf_wi", {"pointwise, maximum"}},
