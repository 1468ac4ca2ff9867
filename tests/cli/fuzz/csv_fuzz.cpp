// libFuzzer target: the reader and the writer of numbers against a second reading of the format. The first
// byte says what the rest is.
#include <cstdint>
#include <cstdio>

#include "support/csv_oracle.h"

using namespace vndf::test;

namespace {

void require_right(const std::string& fault) {
    if (fault.empty()) return;
    std::fprintf(stderr, "%s\n", fault.c_str());
    std::abort();
}

template <class R>
void check_written(std::string_view bytes) {
    R number = 0;
    std::memcpy(&number, bytes.data(), std::min(bytes.size(), sizeof number));
    require_right(miswritten(number));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::vector<std::string> columns{"a", "b", "c"};
    const std::size_t chunk = 1 + (data[0] >> 4);
    switch (data[0] & 7) {
        case 0:
            require_right(misread<float>(text, columns, chunk));
            break;
        case 1:
            require_right(misread<double>(text, columns, chunk));
            break;
        case 2:
            require_right(misread<float>("b,a,c\n" + text, columns, chunk));
            break;
        case 3:
            require_right(misread<double>("c,a,b\n" + text, columns, chunk));
            break;
        case 4:
            check_written<float>(text);
            check_written<double>(text);
            break;
        default:
            require_right(misread_number<float>(text));
            require_right(misread_number<double>(text));
    }
    return 0;
}
