// Quotients and roots of our own (VNDF_SOFTWARE_DIVIDE) are those of hardware that rounds correctly, whatever the device's are
// within 3 ulp: here the processor's, moved.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "parallel.h"
#include "support/catch.h"

namespace {

// By how many ulps what the processor gives is moved, where there is something to round.
thread_local int moved = 0;

float move(float x) {
    const float size = std::abs(x);
    if (!(size > 0) || size > 4) return x;
    return std::bit_cast<float>(std::bit_cast<std::int32_t>(x) + moved);
}

}  // namespace

#define VNDF_REAL float
#define VNDF_SOFTWARE_DIVIDE 1
#define VNDF_IMPL_ROUGH_QUOTIENT(a, b) move((a) / (b))
#define VNDF_IMPL_ROUGH_ROOT(x) move(std::sqrt(x))
#include "../../kernels/vndf/impl/shim.h"

namespace {

constexpr std::array moves{-3, -2, -1, 0, 1, 2, 3};

bool same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

struct Wrong {
    std::uint64_t count = 0;
    float x = 0, y = 0;
    int moved = 0;
    void add(float a, float b) {
        if (count++ == 0) x = a, y = b, moved = ::moved;
    }
};

void check_quotient(float x, float y, Wrong& wrong) {
    if (!same(VNDF_DIVIDE(x, y), x / y)) wrong.add(x, y);
}
void check_root(float x, Wrong& wrong) {
    if (!same(VNDF_SQRT(x), std::sqrt(x))) wrong.add(x, 0);
}

// judge(i, wrong) for 0 <= i < n; none may be wrong.
template <class Judge>
void all_right(std::size_t n, Judge judge) {
    std::vector<Wrong> parts(vndf::thread_count());
    vndf::parallel_for(n, std::size_t{1} << 16, [&](unsigned thread, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) judge(i, parts[thread]);
    });
    for (const Wrong& part : parts) {
        CAPTURE(part.x, part.y, part.moved);
        CHECK(part.count == 0);
    }
}

// Numbers of all kinds and sizes, many with few digits, of which quotients lie half way between subnormal numbers.
float any(std::mt19937_64& random) {
    std::uint32_t bits = static_cast<std::uint32_t>(random());
    const unsigned kind = random() % 8;
    if (kind < 3) bits &= ~0u << (random() % 24);
    if (kind == 3) bits = (bits & 0x807fffff) | (random() % 4 << 23);              // least and subnormal
    if (kind == 4) bits = (bits & 0x807fffff) | ((127 + random() % 4 - 2) << 23);  // near 1
    if (kind == 5) bits = (bits & 0x807fffff) | ((254 - random() % 4) << 23);
    return std::bit_cast<float>(bits);
}

void check_random_quotients(std::size_t n) {
    all_right(n >> 16, [](std::size_t i, Wrong& wrong) {
        std::mt19937_64 random(i);
        for (int k = 0; k < 1 << 16; ++k) {
            moved = moves[random() % moves.size()];
            const float x = any(random);
            check_quotient(x, any(random), wrong);
        }
    });
}

// For odd b the a whose quotient is nearest to the middle between two floats, above it and below: (2 m + 1) b - 2^n a = +-1.
void check_hard_quotients(std::uint32_t stride) {
    all_right((1u << 22) / stride, [&](std::size_t i, Wrong& wrong) {
        const std::uint64_t b = (1u << 23) + 2 * stride * i + 1;
        std::uint64_t inverse = 1;
        for (int k = 0; k < 5; ++k) inverse *= 2 - b * inverse;  // of b modulo 2^64
        for (const int n : {24, 25})
            for (const std::uint64_t sign : {std::uint64_t{1}, ~std::uint64_t{0}}) {
                const std::uint64_t middle = (sign * inverse) & ((std::uint64_t{1} << n) - 1);
                const std::uint64_t a = (middle * b - sign) >> n;
                for (const int by : moves) {
                    moved = by;
                    check_quotient(static_cast<float>(a), static_cast<float>(b), wrong);
                }
            }
    });
}

// Subnormal and least normal quotients next to the middle between two.
void check_subnormal_quotients(std::size_t n) {
    all_right(n >> 12, [](std::size_t i, Wrong& wrong) {
        std::mt19937_64 random(i);
        for (int k = 0; k < 1 << 12; ++k) {
            moved = moves[random() % moves.size()];
            const double middle =
                (static_cast<double>((random() % (1u << 23)) >> random() % 23) + 0.5) * 0x1p-149;
            const double last = ((1u << 23) - 0.5) * 0x1p-149;  // of subnormal ones
            const float y = static_cast<float>(static_cast<double>((1u << 23) + random() % (1u << 23)));
            const float x = static_cast<float>((k % 2 == 0 ? middle : last) * y);
            for (const int by : {-1, 0, 1})
                check_quotient(std::bit_cast<float>(std::bit_cast<std::int32_t>(x) + by), y, wrong);
        }
    });
}

// Every number from 1 to 4, whose roots are those of all normal numbers.
void check_roots(std::uint32_t stride) {
    all_right((1u << 24) / stride, [&](std::size_t i, Wrong& wrong) {
        for (const int by : moves) {
            moved = by;
            check_root(std::bit_cast<float>(0x3f800000u + static_cast<std::uint32_t>(i) * stride), wrong);
        }
    });
}

}  // namespace

TEST_CASE("quotients and roots of our own are correctly rounded: where there is nothing to round, too") {
    const float infinity = std::numeric_limits<float>::infinity(), least = 0x1p-149f,
                largest = 0x1.fffffep127f;
    const std::array some{0.f,  -0.f,  1.f,     -1.f,   least,    -least,    0x1p-126f,    0x1.fffffcp-127f,
                          3e9f, 1e30f, largest, 2.5e9f, infinity, -infinity, std::nanf("")};
    Wrong wrong;
    for (const int by : moves) {
        moved = by;
        for (const float x : some) {
            check_root(x, wrong);
            for (const float y : some) check_quotient(x, y, wrong);
        }
        for (std::uint32_t bits = 1; bits < 1u << 23; bits += 997)
            check_root(std::bit_cast<float>(bits), wrong);
    }
    CAPTURE(wrong.x, wrong.y, wrong.moved);
    CHECK(wrong.count == 0);
}

TEST_CASE("quotients and roots of our own are correctly rounded: the hardest, and some of all") {
    check_hard_quotients(61);
    check_roots(31);
    check_subnormal_quotients(std::size_t{1} << 18);
    check_random_quotients(std::size_t{1} << 22);
}

// Of numbers; integers are divided by 3 in the start of a cube root.
TEST_CASE("every quotient in the headers is one of VNDF_DIVIDE") {
    const std::regex comment("//.*"), quotient("[^/*]/=?[^/*]");
    std::string found;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(CLVNDF_SOURCE_DIR "/kernels/vndf")) {
        if (!entry.is_regular_file() || entry.path().filename() == "divide.h") continue;
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);) {
            const std::string code = std::regex_replace(line, comment, "");
            if (code.find("#include") == std::string::npos &&
                code.find("VNDF_AS_INT(x) / 3") == std::string::npos &&
                code.find("clvndf: ") == std::string::npos && std::regex_search(code, quotient))
                found += entry.path().filename().string() + ": " + line + "\n";
        }
    }
    CHECK(found == "");
}

// Minutes.
TEST_CASE("quotients and roots of our own are correctly rounded: all roots and 10^10 quotients",
          "[.divide-full]") {
    check_hard_quotients(1);
    check_roots(1);
    check_subnormal_quotients(std::size_t{1} << 28);
    all_right(std::size_t{1} << 32, [](std::size_t i, Wrong& wrong) {
        moved = moves[(i * 0x9e3779b9u >> 7) % moves.size()];
        check_root(std::bit_cast<float>(static_cast<std::uint32_t>(i)), wrong);
    });
    check_random_quotients(10'000'000'000);
}
