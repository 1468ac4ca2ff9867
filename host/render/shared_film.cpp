#include "render/shared_film.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace vndf::render {
namespace {

constexpr std::size_t parts_of_share = 4;  // so that who is done early finds more
constexpr std::uint32_t most_pixels = 1u << 16;

std::string bytes_of(const Part& part) {
    const std::uint64_t head[] = {part.first, part.pixels, part.sample, part.samples};
    std::string bytes(sizeof head + part.film.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), head, sizeof head);
    std::memcpy(bytes.data() + sizeof head, part.film.data(), part.film.size() * sizeof(float));
    return bytes;
}

Part part_of(const std::string& bytes) {
    std::uint64_t head[4];
    std::memcpy(head, bytes.data(), sizeof head);
    Part part{static_cast<std::uint32_t>(head[0]), static_cast<std::uint32_t>(head[1]), head[2], head[3],
              std::vector<float>((bytes.size() - sizeof head) / sizeof(float))};
    std::memcpy(part.film.data(), bytes.data() + sizeof head, part.film.size() * sizeof(float));
    return part;
}

std::uint32_t pixels_of_part(std::uint32_t pixels, std::size_t shares) {
    const auto wanted = static_cast<std::uint32_t>((pixels - 1) / (parts_of_share * shares) + 1);
    return std::clamp<std::uint32_t>(wanted, VNDF_CHUNK, most_pixels);
}

}  // namespace

SharedFilm::SharedFilm(const Settings& settings, State state, std::size_t shares)
    : pixels_(settings.width * settings.height),
      part_pixels_(pixels_of_part(pixels_, shares)),
      parts_((pixels_ - 1) / part_pixels_ + 1),
      next_sample_(state.samples),
      began_in_the_middle_(state.ahead > 0),
      state_(std::move(state)),
      growing_(state_) {}

// The pixels of a task and their film as it is now.
Part SharedFilm::part(std::size_t number) const {
    const auto begin = static_cast<std::uint32_t>(number % parts_) * part_pixels_;
    const std::uint32_t end = std::min(begin + part_pixels_, pixels_);
    Part part;
    // What goes on in the middle of a sample has some pixels of it.
    part.first = number < parts_ ? std::clamp(growing_.ahead, begin, end) : begin;
    part.pixels = end - part.first;
    for (std::size_t k = 0; k < VNDF_FILM_PLANES; ++k) {
        const auto plane =
            growing_.film.begin() + static_cast<std::ptrdiff_t>(k * (pixels_ + std::size_t{1}));
        part.film.insert(part.film.end(), plane + part.first, plane + end);
    }
    return part;
}

std::optional<std::string> SharedFilm::task(std::size_t number, std::uint64_t end, std::uint64_t samples) {
    if (number / parts_ == rounds_.size()) {
        if (next_sample_ >= end) return std::nullopt;
        const bool middle = rounds_.empty() && began_in_the_middle_;
        rounds_.push_back({next_sample_, middle ? 1 : std::min(samples, end - next_sample_)});
        next_sample_ += rounds_.back().samples;
    }
    Part next = part(number);
    next.sample = rounds_[number / parts_].sample;
    next.samples = rounds_[number / parts_].samples;
    return bytes_of(next);
}

bool SharedFilm::take(std::size_t number, const std::string& traced) {
    const Part part = part_of(traced);
    const auto put = [&](State& state) {
        for (std::size_t k = 0; k < VNDF_FILM_PLANES; ++k)
            std::copy_n(part.film.begin() + static_cast<std::ptrdiff_t>(k * part.pixels), part.pixels,
                        state.film.begin() +
                            static_cast<std::ptrdiff_t>(k * (pixels_ + std::size_t{1}) + part.first));
    };
    put(growing_);
    if (part.samples == 1) put(state_), state_.ahead = part.first + part.pixels;
    if ((number + 1) % parts_ != 0) return false;
    growing_.samples = part.sample + part.samples, growing_.ahead = 0;
    state_ = growing_;
    return true;
}

std::string trace_part(Wavefront& wavefront, const std::string& task) {
    Part part = part_of(task);
    wavefront.add(part);
    return bytes_of(part);
}

}  // namespace vndf::render
