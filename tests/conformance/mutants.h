// Seeded mistakes: each a change of one text of a kernel source, and what must notice it.
#pragma once

#include <string>
#include <vector>

#include "runtime/evaluator.h"

namespace vndf {

struct Mutant {
    std::string mistake;
    std::string file;  // below kernels/vndf
    std::string old_text, new_text;
    std::string only;                     // the functions it affects, as clvndf check --only takes them
    std::vector<std::string> noticed_by;  // checks, by the beginnings of their names, that must fail
    runtime::Real real = runtime::Real::f32;
};

inline const std::vector<Mutant>& mutants() {
    static const std::vector<Mutant> all{
#include "mutants/beckmann.h"
#include "mutants/beckmann_cosines.h"
#include "mutants/beckmann_heitz_deon2014.h"
#include "mutants/beckmann_world.h"
#include "mutants/bsdf_lambert.h"
#include "mutants/config.h"
#include "mutants/frame.h"
#include "mutants/fresnel.h"
#include "mutants/geometry.h"
#include "mutants/ggx.h"
#include "mutants/ggx_benyoub2024.h"
#include "mutants/ggx_cone2026.h"
#include "mutants/ggx_conic2026.h"
#include "mutants/ggx_cosines.h"
#include "mutants/ggx_dupuy2023.h"
#include "mutants/ggx_eto2023.h"
#include "mutants/ggx_eto2023_polygon.h"
#include "mutants/ggx_heitz2017.h"
#include "mutants/ggx_heitz2018.h"
#include "mutants/ggx_heitz_deon2014.h"
#include "mutants/ggx_lobe.h"
#include "mutants/ggx_tilted2026.h"
#include "mutants/ggx_world.h"
#include "mutants/impl_beckmann_lobe.h"
#include "mutants/impl_beckmann_slopes.h"
#include "mutants/impl_cone.h"
#include "mutants/impl_exact.h"
#include "mutants/impl_lobe.h"
#include "mutants/impl_math.h"
#include "mutants/impl_mirror.h"
#include "mutants/impl_polynomials.h"
#include "mutants/impl_range.h"
#include "mutants/impl_slopes.h"
#include "mutants/impl_stretch.h"
#include "mutants/impl_world.h"
#include "mutants/medium.h"
    };
    return all;
}

}  // namespace vndf
