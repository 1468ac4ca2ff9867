// A part of all functions, for tests of each that take long.
#pragma once

#include <vector>

#include "registry.h"
#include "support/shard.h"

namespace vndf {

// Of all functions every so many, of several parts the one that is `turn` after that of the environment (shard.h).
inline std::vector<const Function*> part_of_all(std::size_t turn) {
    const auto [part, parts] = shard();
    std::vector<const Function*> selected;
    for (std::size_t i = 0; i < functions().size(); ++i)
        if ((i + turn) % parts == part) selected.push_back(&functions()[i]);
    return selected;
}

}  // namespace vndf
