// Buffers, their views and accessors: every range is checked when the file is opened, so that reading cannot leave them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "gltf/container.h"
#include "gltf/json.h"

namespace vndf::gltf {

enum class Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };
std::size_t size_of(Component component);

// Elements of one to 16 numbers each.
class Accessor {
  public:
    std::size_t count() const { return count_; }
    const std::string& type() const { return type_; }  // SCALAR, VEC2, ...
    Component component() const { return component_; }
    bool normalized() const { return normalized_; }
    const Item& item() const { return item_; }

    // Number `c` of element `i`: as it is, or of a normalised integer what it means.
    double number(std::size_t i, std::size_t c) const;
    // Of unsigned integers.
    std::uint32_t whole(std::size_t i) const;

  private:
    friend class Accessors;
    explicit Accessor(const Item& item) : item_(item) {}
    const char* element(std::size_t i) const;  // null: all zeros

    Item item_;
    std::string type_;
    std::size_t count_ = 0, stride_ = 0, element_size_ = 0;
    Component component_ = Component::f32;
    bool normalized_ = false;
    const char* data_ = nullptr;
    // A sparse accessor's: elements with these numbers, which increase, are others.
    std::size_t sparse_count_ = 0;
    Component sparse_component_ = Component::u32;
    const char* sparse_indices_ = nullptr;
    const char* sparse_values_ = nullptr;
};

class Accessors {
  public:
    Accessors(const Item& root, std::optional<std::string_view> bin, Resources& resources,
              const Limits& limits);
    // That an index in the file names.
    const Accessor& of(const Item& index) const {
        return accessors_[index.index(accessors_.size(), "accessor")];
    }
    // The bytes of the view that an index in the file names.
    std::string_view view(const Item& index) const {
        return views_[index.index(views_.size(), "bufferView")].bytes;
    }

  private:
    struct View {
        std::string_view bytes;
        std::size_t stride = 0;  // 0: elements follow each other
    };
    void read_buffers(const Item& buffers, std::optional<std::string_view> bin, Resources& resources);
    void read_views(const Item& views);
    Accessor read_accessor(const Item& item);
    void read_sparse(const Item& sparse, Accessor& accessor);
    // `count` elements of `size` bytes, `stride` apart (0: the view's), from byteOffset of the view that `item` names.
    const char* range(const Item& item, std::size_t count, std::size_t size, std::size_t& stride) const;

    std::vector<std::string_view> buffers_;
    std::vector<View> views_;
    std::vector<Accessor> accessors_;
    std::uint64_t sparse_left_;
};

}  // namespace vndf::gltf
