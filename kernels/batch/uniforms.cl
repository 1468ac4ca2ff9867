// Uniform random numbers on the device: Philox 4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as
// 1, 2, 3"), a function of (seed, stream, index) without state.
#include "../vndf/impl/shim.h"

// Random123 would say plain `inline`, whose functions stay undefined where the compiler does not inline them.
#define R123_STATIC_INLINE static inline
#include <Random123/philox.h>

// A number in [0, 1): the top 24 (double: 53) bits of 64 random ones. That is the full resolution of the type:
// all multiples of 2^-24 (2^-53) below 1 are representable, so that none is rounded and 1 is never reached; with
// one bit more, numbers above 1/2 would have to be rounded, and the largest of them to 1.
VNDF_FN VNDF_REAL vndf_impl_uniform(uint high, uint low) {
#if VNDF_DOUBLE
    return (double)((((ulong)high << 32) | low) >> 11) * 0x1p-53;
#else
    return (float)(high >> 8) * 0x1p-24f;
#endif
}

// u1[i] and u2[i] for the items first ... first + count - 1 of a stream.
__kernel void vndf_batch_uniforms(__global VNDF_REAL* restrict u1, __global VNDF_REAL* restrict u2,
                                  const ulong seed, const ulong stream, const ulong first, const uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const ulong index = first + i;
    const philox4x32_ctr_t counter = {{(uint)index, (uint)(index >> 32), (uint)stream, (uint)(stream >> 32)}};
    const philox4x32_key_t key = {{(uint)seed, (uint)(seed >> 32)}};
    const philox4x32_ctr_t bits = philox4x32(counter, key);
    u1[i] = vndf_impl_uniform(bits.v[0], bits.v[1]);
    u2[i] = vndf_impl_uniform(bits.v[2], bits.v[3]);
}
