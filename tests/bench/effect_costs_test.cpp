// What is counted of effects' programs, and what is timed, are the same programs.
#include "support/catch.h"
#include "support/skip.h"

#ifdef CLVNDF_BENCH
#include "bench/effect_costs.h"

using namespace vndf;

TEST_CASE("of every program whose effects are timed the instructions are committed") {
    const auto programs = bench::effect_programs();
    CHECK(programs.size() > 20);
    for (const bench::EffectCost& cost : programs) {
        CAPTURE(cost.program);
        for (const bench::EffectCounts& counts : {cost.sample, cost.eval_pdf}) {
            CHECK(counts.llvm > 0);
            CHECK(counts.sm_80_slots > 0);
            CHECK(counts.sm_80_registers > 0);
        }
    }
}
#else
TEST_CASE("of every program whose effects are timed the instructions are committed") {
    VNDF_SKIP("built without Google Benchmark, and so without clvndf bench");
}
#endif
