// Rays through the tree of boxes: eight boxes and eight triangles at a time.
//
// Whether a triangle is hit, where, and which of two hits counts are decided by the triangle and the ray alone, never by the
// order of the boxes: the nearest hit, and of two at the same distance that of the lower number. So every tree over the same
// mesh, and every way through it, has the same hits. Boxes are tested with a margin above all that rounding can do.
#ifndef VNDF_RENDER_TREE_H
#define VNDF_RENDER_TREE_H

#include "language.h"
#include "queues.h"

#define VNDF_STACK (7 * VNDF_TREE_DEPTH + 1)

struct vndf_render_ray {
    float x, y, z;
    float inverse_x, inverse_y, inverse_z;  // of the direction; finite
    int near_x, near_y, near_z;             // the planes of a node that the ray meets first
    int kx, ky, kz;                         // axes: kz the largest of the direction
    float shear_x, shear_y, shear_z;
};

struct vndf_render_hit {
    float t, b1, b2;
    uint triangle;
};

// Eight numbers by one comparison; a NaN in b gives a.
VNDF_FN float8 vndf_render_least8(float8 a, float8 b) {
    return b < a ? b : a;
}
VNDF_FN float8 vndf_render_most8(float8 a, float8 b) {
    return b > a ? b : a;
}

// A component too small to divide by counts as one that moves the ray by nothing within any scene.
VNDF_FN float vndf_render_inverse(float d) {
    const float size = vndf_impl_max(vndf_impl_abs(d), 1e-18f);
    return 1.0f / (d < 0.0f ? -size : size);
}

VNDF_FN struct vndf_render_ray vndf_render_ray_of(float x, float y, float z, float dx, float dy, float dz) {
    struct vndf_render_ray ray;
    ray.x = x;
    ray.y = y;
    ray.z = z;
    ray.inverse_x = vndf_render_inverse(dx);
    ray.inverse_y = vndf_render_inverse(dy);
    ray.inverse_z = vndf_render_inverse(dz);
    ray.near_x = dx < 0.0f ? VNDF_NODE_HIGH_X : VNDF_NODE_LOW_X;
    ray.near_y = dy < 0.0f ? VNDF_NODE_HIGH_Y : VNDF_NODE_LOW_Y;
    ray.near_z = dz < 0.0f ? VNDF_NODE_HIGH_Z : VNDF_NODE_LOW_Z;
    const float size_x = vndf_impl_abs(dx), size_y = vndf_impl_abs(dy), size_z = vndf_impl_abs(dz);
    ray.kz = size_x > size_y ? (size_x > size_z ? 0 : 2) : (size_y > size_z ? 1 : 2);
    const float major = ray.kz == 0 ? dx : ray.kz == 1 ? dy : dz;
    // The other two in the order that keeps the triangle's orientation.
    const int next = ray.kz == 2 ? 0 : ray.kz + 1, last = ray.kz == 0 ? 2 : ray.kz - 1;
    ray.kx = major < 0.0f ? last : next;
    ray.ky = major < 0.0f ? next : last;
    ray.shear_z = 1.0f / major;
    ray.shear_x = (ray.kx == 0 ? dx : ray.kx == 1 ? dy : dz) * ray.shear_z;
    ray.shear_y = (ray.ky == 0 ? dx : ray.ky == 1 ? dy : dz) * ray.shear_z;
    return ray;
}

VNDF_FN float vndf_render_axis(struct vndf_render_ray ray, int axis) {
    return axis == 0 ? ray.x : axis == 1 ? ray.y : ray.z;
}

// Where the ray enters the eight boxes of a node, negative for those that it does not enter before t.
VNDF_FN float8 vndf_render_boxes(VNDF_RENDER_FROM(float) node, struct vndf_render_ray ray, float t) {
    // Relative to what it is a sum of, a distance to a plane is off by 2^-22 at most, one to a hit by a few times that.
    const float less = 0.99999f, more = 1.00001f;
    const int sum_x = VNDF_NODE_LOW_X + VNDF_NODE_HIGH_X, sum_y = VNDF_NODE_LOW_Y + VNDF_NODE_HIGH_Y,
              sum_z = VNDF_NODE_LOW_Z + VNDF_NODE_HIGH_Z;
    const float8 near_x = (vload8(0, node + ray.near_x) - ray.x) * ray.inverse_x;
    const float8 near_y = (vload8(0, node + ray.near_y) - ray.y) * ray.inverse_y;
    const float8 near_z = (vload8(0, node + ray.near_z) - ray.z) * ray.inverse_z;
    const float8 far_x = (vload8(0, node + sum_x - ray.near_x) - ray.x) * ray.inverse_x;
    const float8 far_y = (vload8(0, node + sum_y - ray.near_y) - ray.y) * ray.inverse_y;
    const float8 far_z = (vload8(0, node + sum_z - ray.near_z) - ray.z) * ray.inverse_z;
    const float8 enter =
        vndf_render_most8(vndf_render_most8(near_x, near_y), vndf_render_most8(near_z, VNDF_RENDER_8(0.0f))) *
        less;
    const float8 leave =
        vndf_render_least8(vndf_render_least8(far_x, far_y), vndf_render_least8(far_z, VNDF_RENDER_8(t))) *
        more;
    return enter <= leave ? enter : VNDF_RENDER_8(-1.0f);
}

// The nearest of `hit` and what the ray meets in a leaf.
// Source: Woop, Benthin & Wald, Watertight Ray/Triangle Intersection, 2013. A ray through an edge meets both its triangles,
//     since the two have the same number for it but for the sign; both ends included, no third test is needed.
VNDF_FN struct vndf_render_hit vndf_render_leaf(VNDF_RENDER_FROM(float) leaf, struct vndf_render_ray ray,
                                                struct vndf_render_hit hit) {
    const float ox = vndf_render_axis(ray, ray.kx), oy = vndf_render_axis(ray, ray.ky),
                oz = vndf_render_axis(ray, ray.kz);
    VNDF_RENDER_FROM(float) const at_x = leaf + 8 * ray.kx;
    VNDF_RENDER_FROM(float) const at_y = leaf + 8 * ray.ky;
    VNDF_RENDER_FROM(float) const at_z = leaf + 8 * ray.kz;
    const float8 az = vload8(0, at_z + VNDF_LEAF_CORNER(0)) - oz;
    const float8 bz = vload8(0, at_z + VNDF_LEAF_CORNER(1)) - oz;
    const float8 cz = vload8(0, at_z + VNDF_LEAF_CORNER(2)) - oz;
    const float8 ax = vload8(0, at_x + VNDF_LEAF_CORNER(0)) - ox - ray.shear_x * az;
    const float8 ay = vload8(0, at_y + VNDF_LEAF_CORNER(0)) - oy - ray.shear_y * az;
    const float8 bx = vload8(0, at_x + VNDF_LEAF_CORNER(1)) - ox - ray.shear_x * bz;
    const float8 by = vload8(0, at_y + VNDF_LEAF_CORNER(1)) - oy - ray.shear_y * bz;
    const float8 cx = vload8(0, at_x + VNDF_LEAF_CORNER(2)) - ox - ray.shear_x * cz;
    const float8 cy = vload8(0, at_y + VNDF_LEAF_CORNER(2)) - oy - ray.shear_y * cz;
    const float8 u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    const float8 determinant = u + v + w;
    const float8 zero = VNDF_RENDER_8(0.0f);
    const float8 least = vndf_render_least8(vndf_render_least8(u, v), w),
                 most = vndf_render_most8(vndf_render_most8(u, v), w);
    const float8 inverse = VNDF_RENDER_8(1.0f) / (determinant != zero ? determinant : VNDF_RENDER_8(1.0f));
    const float8 t = (u * az + v * bz + w * cz) * ray.shear_z * inverse;
    const int8 met =
        ((least >= zero) | (most <= zero)) & (determinant != zero) & (t > zero) & (t <= VNDF_RENDER_8(hit.t));
    if (!VNDF_RENDER_ANY(met)) return hit;
    int lanes[8];
    float ts[8], b1[8], b2[8];
    vstore8(met, 0, lanes);
    vstore8(t, 0, ts);
    vstore8(v * inverse, 0, b1);
    vstore8(w * inverse, 0, b2);
    for (int i = 0; i < 8; ++i) {
        const uint triangle = VNDF_RENDER_BITS(leaf[VNDF_LEAF_TRIANGLE + i]);
        if (lanes[i] && (ts[i] < hit.t || (ts[i] == hit.t && triangle < hit.triangle))) {
            hit.t = ts[i];
            hit.b1 = b1[i];
            hit.b2 = b2[i];
            hit.triangle = triangle;
        }
    }
    return hit;
}

// The first hit of a ray, or any at all where `any` is not 0.
VNDF_FN struct vndf_render_hit vndf_render_trace(VNDF_RENDER_FROM(float) nodes,
                                                 VNDF_RENDER_FROM(float) leaves, struct vndf_render_ray ray,
                                                 int any) {
    struct vndf_render_hit hit;
    hit.t = 3.0e38f;
    hit.b1 = 0.0f;
    hit.b2 = 0.0f;
    hit.triangle = VNDF_MISS;
    int stack[VNDF_STACK];
    float enters[VNDF_STACK];
    int size = 0, child = 0;
    for (;;) {
        if (child < 0) {
            hit = vndf_render_leaf(leaves + (size_t)VNDF_LEAF_SIZE * (uint)~child, ray, hit);
            if (any && hit.triangle != VNDF_MISS) return hit;
        } else {
            VNDF_RENDER_FROM(float) const node = nodes + (size_t)VNDF_NODE_SIZE * (uint)child;
            const float8 enter = vndf_render_boxes(node, ray, hit.t);
            float at[8];
            vstore8(enter, 0, at);
            // On with the nearest; the others wait as they come.
            int found = 0;
            float nearest = 0.0f;
            for (int i = 0; i < 8; ++i) {
                if (at[i] < 0.0f) continue;
                int other = (int)VNDF_RENDER_BITS(node[VNDF_NODE_CHILD + i]);
                float other_at = at[i];
                if (found && other_at >= nearest) {
                    stack[size] = other;
                    enters[size++] = other_at;
                    continue;
                }
                if (found) {
                    stack[size] = child;
                    enters[size++] = nearest;
                }
                found = 1;
                child = other;
                nearest = other_at;
            }
            if (found) continue;
        }
        do {
            if (size == 0) return hit;
            --size;
        } while (enters[size] > hit.t * 1.00001f);
        child = stack[size];
    }
}

#endif
