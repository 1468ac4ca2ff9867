/* VNDF_FUNCTION for language_build.h in CUDA: the function over arrays on the GPU, an item an element. */
#include <cstdio>
#include <cstdlib>

#define GPU_COUNT(...) +1

struct gpu_arrays {
    const void* in[32];
    void* out[8];
};

static void gpu_require(cudaError_t error) {
    if (error == cudaSuccess) return;
    std::fprintf(stderr, "the GPU: %s\n", cudaGetErrorString(error));
    std::exit(1);
}

/* Copies n numbers in and out of each array around the launch of `kernel`. */
static void gpu_run(void (*kernel)(gpu_arrays, size_t), const void* const* inputs, int in,
                    void* const* outputs, int out, size_t n) {
    const size_t bytes = n * sizeof(VNDF_REAL), group = 128;
    gpu_arrays arrays;
    for (int i = 0; i < in; ++i) {
        void* copy;
        gpu_require(cudaMalloc(&copy, bytes));
        gpu_require(cudaMemcpy(copy, inputs[i], bytes, cudaMemcpyHostToDevice));
        arrays.in[i] = copy;
    }
    for (int i = 0; i < out; ++i) gpu_require(cudaMalloc(&arrays.out[i], bytes));
    kernel<<<unsigned((n + group - 1) / group), unsigned(group)>>>(arrays, n);
    gpu_require(cudaGetLastError());
    for (int i = 0; i < out; ++i) {
        gpu_require(cudaMemcpy(outputs[i], arrays.out[i], bytes, cudaMemcpyDeviceToHost));
        gpu_require(cudaFree(arrays.out[i]));
    }
    for (int i = 0; i < in; ++i) gpu_require(cudaFree(const_cast<void*>(arrays.in[i])));
}

#define VNDF_FUNCTION(name, arguments, result_)                                                          \
    static __global__ void gpu_##name(gpu_arrays arrays, size_t n) {                                     \
        const void* const* inputs = arrays.in;                                                           \
        void* const* outputs = arrays.out;                                                               \
        const size_t i = size_t(blockIdx.x) * blockDim.x + threadIdx.x;                                  \
        VNDF_SCALARS_##arguments(VNDF_HOST_IN) VNDF_RESULTS_##result_(VNDF_HOST_OUT) if (i >= n) return; \
        VNDF_SCALARS_##arguments(VNDF_HOST_LOAD) const VNDF_TYPE_##result_ result =                      \
            name(VNDF_CALL_##arguments);                                                                 \
        VNDF_RESULTS_##result_(VNDF_HOST_STORE)                                                          \
    }                                                                                                    \
    static void batch_##name(const void* const* inputs, void* const* outputs, size_t n) {                \
        gpu_run(gpu_##name, inputs, 0 VNDF_SCALARS_##arguments(GPU_COUNT), outputs,                      \
                0 VNDF_RESULTS_##result_(GPU_COUNT), n);                                                 \
    }
