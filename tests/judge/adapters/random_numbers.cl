// Theirs: numbers from a generator behind a pointer. Ours: a generator that has two numbers, in their order.
#include "../right.cl"
struct Random {
    float2 u;
    int drawn;
};
float next(struct Random* random) {
    return random->drawn++ == 0 ? random->u.x : random->u.y;
}

float3 theirs(float3 wo, float2 alpha, struct Random* random) {
    const float azimuth = next(random), height = next(random);
    return my_sample(wo, alpha, (float2)(azimuth, height));
}

// clvndf check --kernel random_numbers.cl --function adapted --as ggx_sample_wm
float3 adapted(float3 wo, float2 alpha, float2 u) {
    struct Random random = {u, 0};
    return theirs(wo, alpha, &random);
}
