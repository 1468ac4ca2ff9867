// Seeded mistakes in impl/caps.h: rows of Mutant (mutants.h).
{"1 + z by addition behind the surface",    "impl/caps.h",
 "cap.p = front ? larger : smaller;",       "cap.p = VNDF_R(1.0) + cap.z;",
 "vndf_ggx_sample_wm_heitz_deon2014_exact", {"pointwise, back", "density of the exact sample"}},
