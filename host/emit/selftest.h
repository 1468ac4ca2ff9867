// Known answers, compared where the emitted functions run, under whatever flags their user has.
#pragma once

#include <set>
#include <string>

#include "emit/emit.h"

namespace vndf::emit {

// What it calls beside the functions asked for.
std::set<std::string> selftest_needs(const Options& options);

// Its source. Throws InputError if none of the functions returns numbers.
std::string selftest(const Options& options);

}  // namespace vndf::emit
