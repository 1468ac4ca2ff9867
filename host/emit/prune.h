// What a set of functions computes and never uses: members of structs, local numbers, parameters.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "emit/declarations.h"

namespace vndf::emit {

// Without them. The functions of these names keep their parameters and results; so do all results their values, since
// nothing here has an effect but its result.
// The structs of those names keep their members: they are the user's.
std::vector<Declaration> pruned(std::vector<Declaration> all, const std::set<std::string>& names,
                                const std::set<std::string>& structs);

}  // namespace vndf::emit
