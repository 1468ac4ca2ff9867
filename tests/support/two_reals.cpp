// One program of three objects: the library in float, in double, and (MAIN) what calls both.
#include <cstdio>

#ifdef MAIN
double part_float(double);
double part_double(double);
int main() {
    const double single = part_float(0.3), twice = part_double(0.3);
    std::printf("%.17g %.17g\n", single, twice);
    return !(single != twice && single - twice < 1e-5 && twice - single < 1e-5);
}
#else
#include "vndf/vndf.h"

double NAME(double u) {
    const VNDF_REAL3 wo = {VNDF_REAL(0.6), 0, VNDF_REAL(0.8)};
    const VNDF_REAL2 alpha = {VNDF_REAL(0.5), VNDF_REAL(0.1)};
    const vndf_ggx_conic2026 lobe = vndf_ggx_conic2026_lobe(wo, alpha);
    return vndf_ggx_sample_wi_conic2026_lobe(lobe, VNDF_REAL2{VNDF_REAL(u), VNDF_REAL(u)}).x;
}
#endif
