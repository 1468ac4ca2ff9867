// The host build is that of another language (language_build.h).
#include "runtime/host_build.h"

extern "C" vndf::runtime::HostFunction find_function_of_language(const char* name);

vndf::runtime::HostFunction vndf::runtime::find_host_function_float_strict(const char* name) {
    return find_function_of_language(name);
}
