// An OpenCL layer (CL/cl_layer.h) that makes of the devices of this machine others that exist elsewhere. OPENCL_LAYERS names this
// library; CLVNDF_LAYER says what to play, with commas between:
//
//   no_fp64         no double: neither reported nor compiled
//   no_fma          no fma in hardware          no_rounding   / and sqrt not correctly rounded
//   group=N         at most N work-items in a group
//   no_compiler     CL_DEVICE_COMPILER_AVAILABLE is false
//   no_device       platforms without a device
//   twins           each platform twice, under one name
//   sub_devices     in place of each device its compute units, one by one
//   address_32      32-bit addresses, and the memory that these reach
//   memory=BYTES    at most so many in a buffer
//   vanish=N        after N calls that reach the device it is gone: each fails
#include <CL/cl_layer.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace {

const cl_icd_dispatch* below;
cl_icd_dispatch layer;

// "group" of "no_fma,group=64" is "64"; nullptr without it.
const char* played(const std::string& name) {
    static const std::string all = [] {
        const char* const value = std::getenv("CLVNDF_LAYER");
        return ',' + std::string(value ? value : "") + ',';
    }();
    const std::size_t at = all.find(',' + name);
    if (at == all.npos) return nullptr;
    const char* const end = all.c_str() + at + 1 + name.size();
    return *end == '=' ? end + 1 : *end == ',' ? end : nullptr;
}

unsigned long long number(const std::string& name, unsigned long long otherwise) {
    const char* const value = played(name);
    return value ? std::strtoull(value, nullptr, 10) : otherwise;
}

std::size_t most_items() {
    return number("group", SIZE_MAX);
}
cl_ulong most_bytes() {
    return number("memory", played("address_32") ? cl_ulong{1} << 29 : ~cl_ulong{0});
}

// --------------------------------------------------------------------------------------------- what is reported

template <class T, class Change>
cl_int changed(cl_int status, void* value, Change change) {
    if (status == CL_SUCCESS && value) change(*static_cast<T*>(value));
    return status;
}

// The caller's size counts, not that of T: sizes of items are three.
cl_int CL_API_CALL device_info(cl_device_id device, cl_device_info what, std::size_t size, void* value,
                               std::size_t* needed) {
    const cl_int status = below->clGetDeviceInfo(device, what, size, value, needed);
    switch (what) {
        case CL_DEVICE_DOUBLE_FP_CONFIG:
            return changed<cl_device_fp_config>(status, value,
                                                [](auto& x) { x = played("no_fp64") ? 0 : x; });
        case CL_DEVICE_SINGLE_FP_CONFIG:
            return changed<cl_device_fp_config>(status, value, [](auto& x) {
                if (played("no_fma")) x &= ~cl_device_fp_config{CL_FP_FMA};
                if (played("no_rounding")) x &= ~cl_device_fp_config{CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT};
            });
        case CL_DEVICE_MAX_WORK_GROUP_SIZE:
            return changed<std::size_t>(status, value, [](auto& x) { x = std::min(x, most_items()); });
        case CL_DEVICE_MAX_WORK_ITEM_SIZES:
            return changed<std::size_t>(status, value, [&](auto& first) {
                for (std::size_t i = 0; i < size / sizeof first; ++i)
                    (&first)[i] = std::min((&first)[i], most_items());
            });
        case CL_DEVICE_COMPILER_AVAILABLE:
        case CL_DEVICE_LINKER_AVAILABLE:
            return changed<cl_bool>(status, value, [](auto& x) { x = played("no_compiler") ? CL_FALSE : x; });
        case CL_DEVICE_ADDRESS_BITS:
            return changed<cl_uint>(status, value, [](auto& x) { x = played("address_32") ? 32 : x; });
        case CL_DEVICE_MAX_MEM_ALLOC_SIZE:
            return changed<cl_ulong>(status, value, [](auto& x) { x = std::min(x, most_bytes()); });
        case CL_DEVICE_GLOBAL_MEM_SIZE:
            return changed<cl_ulong>(status, value, [](auto& x) {
                if (played("address_32")) x = std::min(x, (cl_ulong{1} << 32) - 1);
            });
        default:
            return status;
    }
}

cl_int CL_API_CALL kernel_group_info(cl_kernel kernel, cl_device_id device, cl_kernel_work_group_info what,
                                     std::size_t size, void* value, std::size_t* needed) {
    const cl_int status = below->clGetKernelWorkGroupInfo(kernel, device, what, size, value, needed);
    if (what != CL_KERNEL_WORK_GROUP_SIZE && what != CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE)
        return status;
    return changed<std::size_t>(status, value, [](auto& x) { x = std::min(x, most_items()); });
}

// ------------------------------------------------------------------------------------------------ what there is

template <class T>
cl_int listed(const std::vector<T>& all, cl_uint entries, T* to, cl_uint* count) {
    if (count) *count = static_cast<cl_uint>(all.size());
    if (to) std::copy_n(all.begin(), std::min<std::size_t>(entries, all.size()), to);
    return CL_SUCCESS;
}

cl_int CL_API_CALL platforms(cl_uint entries, cl_platform_id* to, cl_uint* count) {
    cl_uint there = 0;
    const cl_int status = below->clGetPlatformIDs(0, nullptr, &there);
    if (status != CL_SUCCESS || !played("twins")) return below->clGetPlatformIDs(entries, to, count);
    std::vector<cl_platform_id> all(there);
    below->clGetPlatformIDs(there, all.data(), nullptr);
    all.insert(all.end(), all.begin(), all.begin() + there);
    return listed(all, entries, to, count);
}

// Its compute units, made once.
const std::vector<cl_device_id>& units_of(cl_device_id device) {
    static std::vector<std::pair<cl_device_id, std::vector<cl_device_id>>> made;
    for (const auto& [parent, units] : made)
        if (parent == device) return units;
    const cl_device_partition_property one_by_one[] = {CL_DEVICE_PARTITION_EQUALLY, 1, 0};
    cl_uint count = 0;
    below->clCreateSubDevices(device, one_by_one, 0, nullptr, &count);
    auto& units = made.emplace_back(device, std::vector<cl_device_id>(count)).second;
    if (count > 0) below->clCreateSubDevices(device, one_by_one, count, units.data(), nullptr);
    return units;
}

cl_int CL_API_CALL devices(cl_platform_id platform, cl_device_type type, cl_uint entries, cl_device_id* to,
                           cl_uint* count) {
    if (played("no_device")) return CL_DEVICE_NOT_FOUND;
    cl_uint there = 0;
    const cl_int status = below->clGetDeviceIDs(platform, type, 0, nullptr, &there);
    if (status != CL_SUCCESS || !played("sub_devices"))
        return below->clGetDeviceIDs(platform, type, entries, to, count);
    std::vector<cl_device_id> whole(there), all;
    below->clGetDeviceIDs(platform, type, there, whole.data(), nullptr);
    for (const cl_device_id device : whole)
        for (const cl_device_id unit : units_of(device)) all.push_back(unit);
    return all.empty() ? CL_DEVICE_NOT_FOUND : listed(all, entries, to, count);
}

// ---------------------------------------------------------------------------------------------- what can be done

cl_mem CL_API_CALL buffer(cl_context context, cl_mem_flags flags, std::size_t size, void* from,
                          cl_int* error) {
    if (size <= most_bytes()) return below->clCreateBuffer(context, flags, size, from, error);
    if (error) *error = CL_INVALID_BUFFER_SIZE;
    return nullptr;
}

// Without fp64 the word "double" is no type.
cl_program CL_API_CALL source(cl_context context, cl_uint count, const char** strings,
                              const std::size_t* lengths, cl_int* error) {
    std::string text;
    if (played("no_fp64")) text = "#undef cl_khr_fp64\n#define double there_is_no_fp64\n#line 1\n";
    for (cl_uint i = 0; i < count; ++i)
        text += lengths && lengths[i] ? std::string(strings[i], lengths[i]) : std::string(strings[i]);
    const char* const whole = text.c_str();
    return below->clCreateProgramWithSource(context, 1, const_cast<const char**>(&whole), nullptr, error);
}

cl_int CL_API_CALL build(cl_program program, cl_uint count, const cl_device_id* list, const char* options,
                         void(CL_CALLBACK* done)(cl_program, void*), void* data) {
    if (played("no_compiler")) return CL_COMPILER_NOT_AVAILABLE;
    if (played("no_rounding") && options && std::strstr(options, "-cl-fp32-correctly-rounded-divide-sqrt"))
        return CL_INVALID_BUILD_OPTIONS;
    return below->clBuildProgram(program, count, list, options, done, data);
}

// Queues that have had work.
std::vector<cl_command_queue> busy;
std::mutex of_busy;

void put_to_work(cl_command_queue queue) {
    const std::lock_guard lock(of_busy);
    if (std::find(busy.begin(), busy.end(), queue) != busy.end()) return;
    below->clRetainCommandQueue(queue);
    busy.push_back(queue);
}

cl_int CL_API_CALL launch(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                          const std::size_t* offset, const std::size_t* items, const std::size_t* group,
                          cl_uint count, const cl_event* before, cl_event* event) {
    std::size_t together = 1;
    for (cl_uint i = 0; i < dimensions; ++i) {
        if (group) together *= group[i];
        if (played("address_32") && items[i] >> 32 != 0) return CL_INVALID_GLOBAL_WORK_SIZE;
    }
    if (together > most_items()) return CL_INVALID_WORK_GROUP_SIZE;
    put_to_work(queue);
    return below->clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, items, group, count, before,
                                         event);
}

// Whether the device is gone, at this call or before. Then it works no more, as the one below would.
bool gone() {
    static const unsigned long long last = number("vanish", ~0ull);
    static std::atomic<unsigned long long> calls{0};
    const unsigned long long call = calls++;
    if (call == last) {
        const std::lock_guard lock(of_busy);
        for (const cl_command_queue queue : busy) below->clFinish(queue);
    }
    return call >= last;
}

// The layer's function of this place, or the one below, until the device vanishes.
template <auto place, auto inner, class F>
struct Until;
template <auto place, auto inner, class R, class... A>
struct Until<place, inner, R(CL_API_CALL*)(A...)> {
    static R CL_API_CALL call(A... arguments) {
        if (gone()) {
            if constexpr (std::is_same_v<R, cl_int>) {
                return CL_OUT_OF_RESOURCES;
            } else {
                cl_int* const error = std::get<sizeof...(A) - 1>(std::tuple<A...>(arguments...));
                if (error) *error = CL_OUT_OF_RESOURCES;
                return nullptr;
            }
        }
        if constexpr (std::is_null_pointer_v<decltype(inner)>)
            return (below->*place)(arguments...);
        else
            return inner(arguments...);
    }
};
template <auto place, auto inner = nullptr>
void reach() {
    using F = std::remove_reference_t<decltype(layer.*place)>;
    layer.*place = Until<place, inner, F>::call;
}

void fill() {
    using D = cl_icd_dispatch;
    layer.clGetDeviceInfo = device_info;
    layer.clGetPlatformIDs = platforms;
    layer.clGetDeviceIDs = devices;
    reach<&D::clGetKernelWorkGroupInfo, kernel_group_info>();
    reach<&D::clCreateContext>();
    reach<&D::clCreateCommandQueue>();
    reach<&D::clCreateCommandQueueWithProperties>();
    reach<&D::clCreateProgramWithSource, source>();
    reach<&D::clBuildProgram, build>();
    reach<&D::clGetProgramBuildInfo>();
    reach<&D::clGetProgramInfo>();
    reach<&D::clCreateKernel>();
    reach<&D::clSetKernelArg>();
    reach<&D::clCreateBuffer, buffer>();
    reach<&D::clEnqueueWriteBuffer>();
    reach<&D::clEnqueueReadBuffer>();
    reach<&D::clEnqueueFillBuffer>();
    reach<&D::clEnqueueCopyBuffer>();
    reach<&D::clEnqueueNDRangeKernel, launch>();
    reach<&D::clWaitForEvents>();
    reach<&D::clGetEventProfilingInfo>();
    reach<&D::clGetEventInfo>();
    reach<&D::clFlush>();
    reach<&D::clFinish>();
}

}  // namespace

extern "C" CL_API_ENTRY cl_int CL_API_CALL clGetLayerInfo(cl_layer_info what, std::size_t size, void* value,
                                                          std::size_t* needed) {
    const auto give = [&](const void* from, std::size_t bytes) {
        if (needed) *needed = bytes;
        if (value && size < bytes) return CL_INVALID_VALUE;
        if (value) std::memcpy(value, from, bytes);
        return CL_SUCCESS;
    };
    const cl_layer_api_version version = CL_LAYER_API_VERSION_100;
    static const char name[] = "clvndf: devices as they are";
    return what == CL_LAYER_API_VERSION ? give(&version, sizeof version)
           : what == CL_LAYER_NAME      ? give(name, sizeof name)
                                        : CL_INVALID_VALUE;
}

extern "C" CL_API_ENTRY cl_int CL_API_CALL clInitLayer(cl_uint entries, const cl_icd_dispatch* target,
                                                       cl_uint* filled, const cl_icd_dispatch** result) {
    constexpr cl_uint known = sizeof(cl_icd_dispatch) / sizeof(void*);
    if (!target || !filled || !result) return CL_INVALID_VALUE;
    below = target;
    std::memcpy(&layer, target, std::min(entries, known) * sizeof(void*));
    fill();
    *filled = std::min(entries, known);
    *result = &layer;
    return CL_SUCCESS;
}
