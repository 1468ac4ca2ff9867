// Seeded mistakes in ggx_benyoub2024.h: rows of Mutant (mutants.h).
{"world space: 1.000001 for the length of the reference axis",
 "ggx_benyoub2024.h",
 "w = VNDF_DIVIDE(along_w, VNDF_R(1.0) + vndf_impl_abs(n.z));\n"
 "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
 "              ez = n.z < VNDF_R(0.0) ? -along_w : along_w;",
 "w = along_w / (VNDF_R(1.000001) + n.z);\n"
 "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
 "              ez = along_w;",
 "vndf_ggx_sample_wm_benyoub2024",
 {"pointwise, front", "pointwise, core"}},
    {"world space: one reference axis for every n",
     "ggx_benyoub2024.h",
     "w = VNDF_DIVIDE(along_w, VNDF_R(1.0) + vndf_impl_abs(n.z));\n"
     "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
     "              ez = n.z < VNDF_R(0.0) ? -along_w : along_w;",
     "w = along_w / (VNDF_R(1.0) + n.z);\n"
     "    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),\n"
     "              ez = along_w;",
     "vndf_ggx_sample_wm_benyoub2024",
     {"pointwise, front", "pointwise, core"}},
    {"world space: the half vector opposite to wo with the length that e has by rounding",
     "ggx_benyoub2024.h",
     "scale = VNDF_DIVIDE(VNDF_R(1.0),",
     "scale = VNDF_DIVIDE(VNDF_R(0.0),",
     "vndf_ggx_sample_wm_benyoub2024",
     {"normal faces wo"}},
    {"world space: a nearly vanishing sum that leans out of the plane across n",
     "ggx_benyoub2024.h",
     "VNDF_REAL lean = VNDF_FMA(hx,",
     "VNDF_REAL lean = VNDF_R(0.0) * VNDF_FMA(hx,",
     "vndf_ggx_sample_wm_benyoub2024",
     {"normal faces wo"}},
    {"world space: no tangent at wo = -n",
     "ggx_benyoub2024.h",
     "VNDF_REAL least = k2 > VNDF_R(0.0) ? VNDF_R(0.0) : vndf_impl_no_length(v.z);",
     "VNDF_REAL least = VNDF_R(0.0);",
     "vndf_ggx_sample_wm_benyoub2024",
     {"as documented at wo = -n"}},
