// Seeded mistakes in ggx_benyoub2024.h: rows of Mutant (mutants.h).
{"world space: 1.000001 for the length of the reference axis",
 "ggx_benyoub2024.h",
 "w = along_w / (VNDF_R(1.0) + vndf_impl_abs(n.z));\n"
 "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
 "              ez = n.z < VNDF_R(0.0) ? -along_w : along_w;",
 "w = along_w / (VNDF_R(1.000001) + n.z);\n"
 "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
 "              ez = along_w;",
 "vndf_ggx_sample_wm_benyoub2024",
 {"pointwise, front", "pointwise, core"}},
    {"world space: one reference axis for every n",
     "ggx_benyoub2024.h",
     "w = along_w / (VNDF_R(1.0) + vndf_impl_abs(n.z));\n"
     "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
     "              ez = n.z < VNDF_R(0.0) ? -along_w : along_w;",
     "w = along_w / (VNDF_R(1.0) + n.z);\n"
     "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
     "              ez = along_w;",
     "vndf_ggx_sample_wm_benyoub2024",
     {"pointwise, front", "pointwise, core"}},
    {"no way back to the silhouette in world space",
     "ggx_benyoub2024.h",
     "VNDF_REAL back = vndf_impl_max(behind, VNDF_R(0.0)) * v.rcp_l * v.rcp_l;",
     "VNDF_REAL back = VNDF_R(0.0);",
     "vndf_ggx_sample_wm_benyoub2024",
     {"normal faces wo"}},
    // > for >= where it matters.
    {"the way back to the silhouette in world space with a wrong sign along z",
     "ggx_benyoub2024.h",
     "hz = VNDF_FMA(back, vz, hz);",
     "hz = VNDF_FMA(back, -vz, hz);",
     "vndf_ggx_sample_wm_benyoub2024",
     {"normal above the surface"}},
