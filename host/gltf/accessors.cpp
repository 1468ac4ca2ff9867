#include "gltf/accessors.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

namespace vndf::gltf {
namespace {

// Sums and products of two such numbers, or of one with an element's size, stay below 2^64.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 40, most_elements = 0xFFFFFFFF;

struct Shape {
    const char* name;
    std::size_t columns, rows;
};
constexpr std::array<Shape, 7> shapes{{{"SCALAR", 1, 1},
                                       {"VEC2", 1, 2},
                                       {"VEC3", 1, 3},
                                       {"VEC4", 1, 4},
                                       {"MAT2", 2, 2},
                                       {"MAT3", 3, 3},
                                       {"MAT4", 4, 4}}};

const Shape& shape_of(const Item& type) {
    const std::string name = type.text();
    const auto found =
        std::find_if(shapes.begin(), shapes.end(), [&](const Shape& shape) { return name == shape.name; });
    if (found == shapes.end())
        type.fail(in_quotes(name) + " is no type; SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 and MAT4 are");
    return *found;
}

Component component_of(const Item& item) {
    const std::uint64_t number = item.whole(0, 0xFFFF);
    if (number < 5120 || number > 5126 || number == 5124)
        item.fail(fmt::format("{} is no type of components; 5120 to 5123, 5125 and 5126 are", number));
    return static_cast<Component>(number);
}

// Columns of a matrix begin at multiples of four bytes.
std::size_t bytes_of(const Shape& shape, Component component) {
    const std::size_t column = shape.rows * size_of(component);
    return shape.columns == 1 ? column : shape.columns * ((column + 3) / 4 * 4);
}

template <class T>
T loaded(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

std::uint32_t whole_at(const char* bytes, Component component) {
    switch (component) {
        case Component::u8:
            return loaded<std::uint8_t>(bytes);
        case Component::u16:
            return loaded<std::uint16_t>(bytes);
        default:
            return loaded<std::uint32_t>(bytes);
    }
}

}  // namespace

std::size_t size_of(Component component) {
    switch (component) {
        case Component::i8:
        case Component::u8:
            return 1;
        case Component::i16:
        case Component::u16:
            return 2;
        default:
            return 4;
    }
}

const char* Accessor::element(std::size_t i) const {
    const char* const base = data_ ? data_ + i * stride_ : nullptr;
    std::size_t low = 0, high = sparse_count_;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        const std::uint32_t index =
            whole_at(sparse_indices_ + middle * size_of(sparse_component_), sparse_component_);
        if (index == i) return sparse_values_ + middle * element_size_;
        (index < i ? low : high) = index < i ? middle + 1 : middle;
    }
    return base;
}

double Accessor::number(std::size_t i, std::size_t c) const {
    const char* const bytes = element(i);
    if (!bytes) return 0;
    const char* const from = bytes + c * size_of(component_);
    const auto scaled = [&](double x, double largest) {
        return normalized_ ? std::max(x / largest, -1.0) : x;
    };
    switch (component_) {
        case Component::i8:
            return scaled(loaded<std::int8_t>(from), 127);
        case Component::u8:
            return scaled(loaded<std::uint8_t>(from), 255);
        case Component::i16:
            return scaled(loaded<std::int16_t>(from), 32767);
        case Component::u16:
            return scaled(loaded<std::uint16_t>(from), 65535);
        case Component::u32:
            return loaded<std::uint32_t>(from);
        default:
            return loaded<float>(from);
    }
}

std::uint32_t Accessor::whole(std::size_t i) const {
    const char* const bytes = element(i);
    return bytes ? whole_at(bytes, component_) : 0;
}

Accessors::Accessors(const Item& root, std::optional<std::string_view> bin, Resources& resources,
                     const Limits& limits)
    : sparse_left_(limits.sparse_elements) {
    read_buffers(root["buffers"], bin, resources);
    read_views(root["bufferViews"]);
    const Item items = root["accessors"];
    accessors_.reserve(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) accessors_.push_back(read_accessor(items.at(i)));
}

void Accessors::read_buffers(const Item& buffers, std::optional<std::string_view> bin, Resources& resources) {
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const Item buffer = buffers.at(i), uri = buffer["uri"];
        const std::uint64_t length = buffer["byteLength"].whole(1, most_bytes);
        if (!uri && !(i == 0 && bin)) buffer.fail("has no uri, and there is no chunk of bytes for it");
        const std::string_view bytes = uri ? resources.of_uri(uri) : *bin;
        if (bytes.size() < length)
            buffer["byteLength"].fail(fmt::format("{} bytes, where there are {}", length, bytes.size()));
        buffers_.push_back(bytes.substr(0, length));
    }
}

void Accessors::read_views(const Item& views) {
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Item view = views.at(i);
        const std::string_view buffer = buffers_[view["buffer"].index(buffers_.size(), "buffer")];
        const std::uint64_t offset = view["byteOffset"].whole_or(0, 0, most_bytes),
                            length = view["byteLength"].whole(1, most_bytes);
        if (offset + length > buffer.size())
            view.fail(fmt::format("{} bytes from {} on do not fit its buffer of {} bytes", length, offset,
                                  buffer.size()));
        views_.push_back({buffer.substr(offset, length), view["byteStride"].whole_or(0, 4, 252)});
    }
}

const char* Accessors::range(const Item& item, std::size_t count, std::size_t size,
                             std::size_t& stride) const {
    const View& view = views_[item["bufferView"].index(views_.size(), "bufferView")];
    const std::uint64_t offset = item["byteOffset"].whole_or(0, 0, most_bytes);
    if (stride == 0) stride = view.stride == 0 ? size : view.stride;
    if (stride < size)
        item.fail(
            fmt::format("elements of {} bytes overlap: its bufferView's byteStride is {}", size, stride));
    if (offset + stride * (count - 1) + size > view.bytes.size())
        item.fail(
            fmt::format("{} elements of {} bytes, {} apart from byte {} on, do not fit its bufferView of {} "
                        "bytes",
                        count, size, stride, offset, view.bytes.size()));
    return view.bytes.data() + offset;
}

Accessor Accessors::read_accessor(const Item& item) {
    Accessor accessor(item);
    const Shape& shape = shape_of(item["type"]);
    accessor.type_ = shape.name;
    accessor.component_ = component_of(item["componentType"]);
    accessor.count_ = item["count"].whole(1, most_elements);
    accessor.element_size_ = bytes_of(shape, accessor.component_);
    accessor.normalized_ = item["normalized"].truth_or(false);
    if (accessor.normalized_ && size_of(accessor.component_) > 2)
        item["normalized"].fail("only integers of 8 or 16 bits can be");
    if (item["bufferView"])
        accessor.data_ = range(item, accessor.count_, accessor.element_size_, accessor.stride_);
    if (const Item sparse = item["sparse"]) read_sparse(sparse, accessor);
    return accessor;
}

void Accessors::read_sparse(const Item& sparse, Accessor& accessor) {
    accessor.sparse_count_ = sparse["count"].whole(1, accessor.count_);
    if (accessor.sparse_count_ > sparse_left_)
        sparse["count"].fail("more elements of sparse accessors than are read");
    sparse_left_ -= accessor.sparse_count_;
    const Item indices = sparse["indices"], values = sparse["values"];
    accessor.sparse_component_ = component_of(indices["componentType"]);
    const Component component = accessor.sparse_component_;
    if (component != Component::u8 && component != Component::u16 && component != Component::u32)
        indices["componentType"].fail("indices are unsigned integers: 5121, 5123 or 5125");
    std::size_t index_size = size_of(component), value_size = accessor.element_size_;
    accessor.sparse_indices_ = range(indices, accessor.sparse_count_, index_size, index_size);
    accessor.sparse_values_ = range(values, accessor.sparse_count_, value_size, value_size);
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < accessor.sparse_count_; ++i) {
        const std::uint32_t index = whole_at(accessor.sparse_indices_ + i * index_size, component);
        if (index < next || index >= accessor.count_)
            indices.fail(
                fmt::format("index {} at {}: they increase, up to {}", index, i, accessor.count_ - 1));
        next = std::uint64_t{index} + 1;
    }
}

}  // namespace vndf::gltf
