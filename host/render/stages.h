// Where the stages of kernels/render run: on a device, or as C++.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "runtime/program.h"

namespace vndf::render {

class Stages {
  public:
    using Buffer = std::size_t;

    // What a stage is given, in its order: a buffer, or a value of the type that it takes.
    struct Argument {
        Argument(Buffer b) : buffer(b) {}
        Argument(const std::uint32_t& value) : value(&value), size(sizeof value) {}
        Argument(const std::int32_t& value) : value(&value), size(sizeof value) {}
        Argument(const float& value) : value(&value), size(sizeof value) {}
        template <class Struct>
        Argument(const Struct* value) : value(value), size(sizeof *value) {}

        Buffer buffer = 0;
        const void* value = nullptr;
        std::size_t size = 0;
    };
    using Arguments = std::initializer_list<Argument>;

    virtual ~Stages() = default;

    // Filled with zeros.
    virtual Buffer buffer(std::size_t bytes) = 0;
    virtual void write(Buffer to, const void* from, std::size_t bytes, std::size_t offset = 0) = 0;
    virtual void read(Buffer from, void* to, std::size_t bytes, std::size_t offset = 0) = 0;
    // Runs vndf_render_<stage> on at least `items` items, in whole groups.
    virtual void launch(const std::string& stage, std::size_t items, Arguments arguments) = 0;
    virtual std::string describe() const = 0;
    // Of all buffers.
    virtual std::size_t bytes() const = 0;
    // Camera rays that an item of the stage `packets` takes; 1: there is no such stage.
    virtual unsigned packet() const = 0;
    // Whether the program has a stage, of those that only some effects have.
    virtual bool has(const std::string& stage) const = 0;
    // Spent in a stage so far, where stages are timed.
    virtual double seconds(const std::string&) const { return 0; }

    template <class T>
    Buffer upload(const std::vector<T>& values) {
        const Buffer made = buffer(values.size() * sizeof(T));
        if (!values.empty()) write(made, values.data(), values.size() * sizeof(T));
        return made;
    }
};

// "-DVNDF_..." for the compiler: for the stages that know no materials, and for those that do.
struct Switches {
    std::string paths, materials;
    unsigned packet =
        0;  // camera rays traced together, 1 or a multiple of eight; 0: what the device does best
};

// On a device. timed: each stage is waited for, and its time kept.
std::unique_ptr<Stages> device_stages(const runtime::Device& device, runtime::Math math,
                                      const Switches& switches, bool timed = false);

// The same text as C++, with every effect, for values of VNDF_NDF and VNDF_FRESNEL; strict, Sobol.
std::unique_ptr<Stages> cpp_stages(const std::string& ndf, const std::string& fresnel);

}  // namespace vndf::render
