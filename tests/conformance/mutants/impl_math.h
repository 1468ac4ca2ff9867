// Seeded mistakes in impl/math.h: rows of Mutant (mutants.h).
{"a digit of log(2) mistyped", "impl/math.h",         "-2.12194440e-4f", "-2.13194440e-4f",
 "vndf_beckmann_ndf",          {"pointwise, maximum"}},
    {"the start of the cube root mistyped",     "impl/math.h",       "0x54a2fa8e", "0x55a2fa8e",
     "vndf_ggx_sample_wm_heitz_deon2014_exact", {"pointwise, front"}},
    {"the power of two in one step", "impl/math.h",       "VNDF_INT first = exponent >> 1;",
     "VNDF_INT first = exponent;",   "vndf_beckmann_ndf", {"pointwise, maximum"}},
