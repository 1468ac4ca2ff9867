// What a file has that is shown otherwise than it says: counted, not repeated.
#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace vndf::gltf {

class Warnings {
  public:
    // `what` is the same line each time; `first` is where or what it was, shown of the first time.
    void add(const std::string& what, const std::string& first, std::size_t count = 1) {
        if (count == 0) return;
        const auto [found, is_new] = number_of_.try_emplace(what, list_.size());
        if (is_new) list_.emplace_back(first.empty() ? what : what + ": " + first, 0);
        list_[found->second].second += count;
    }
    const std::vector<std::pair<std::string, std::size_t>>& list() const { return list_; }

  private:
    std::vector<std::pair<std::string, std::size_t>> list_;
    std::unordered_map<std::string, std::size_t> number_of_;
};

}  // namespace vndf::gltf
