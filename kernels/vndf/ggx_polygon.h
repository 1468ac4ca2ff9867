// The part of a GGX lobe that is reflected into a spherical triangle or quadrilateral, or into a cap: exact, without samples.
//
// Source: this package; derivation and how to verify it: ggx_cone2026.md. None found published, in a short search.
//     The integral of D / 4 over a region of directions wi is what v = A wo sees of the region's stretched normals, whose boundary
//     is made of arcs (ggx_cone2026_arc.h): one for each edge, of its great circle, and one of the horizon. Times F G2 / cos theta_o
//     it is the light that a polygon of constant radiance sends to wo, with F and G2 taken out of the integral; over sigma the
//     probability of the polygon.
#ifndef VNDF_GGX_POLYGON_H
#define VNDF_GGX_POLYGON_H

#include "ggx_cone2026_arc.h"

VNDF_BEGIN

// Where the boundary of what is above the horizon has gone down, and come up again.
struct vndf_impl_outline {
    VNDF_REAL down_x, down_y, up_x, up_y;  // unit vectors, z = 0
};

// A unit vector along w; (0, 0, 0) where there is none.
VNDF_FN struct vndf_impl_vector vndf_impl_vertex(VNDF_REAL3 w, VNDF_REAL before) {
    VNDF_REAL size = vndf_impl_max(vndf_impl_max(vndf_impl_abs(w.x), vndf_impl_abs(w.y)), vndf_impl_abs(w.z));
    // Made dependent on the one before, so that they are not packed (impl/stretch.h).
    VNDF_REAL scale = vndf_impl_scale(size > VNDF_R(0.0) && before <= VNDF_REAL_MAX ? size : VNDF_R(1.0));
    VNDF_REAL x = w.x * scale, y = w.y * scale, z = w.z * scale, l2 = VNDF_FMA(x, x, VNDF_FMA(y, y, z * z));
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(l2 > VNDF_R(0.0) ? l2 : VNDF_R(1.0)));
    return vndf_impl_vector_of(x * rcp, y * rcp, z * rcp);
}

// With one edge more, of unit vectors.
VNDF_FN struct vndf_impl_outline vndf_impl_outline_with(struct vndf_impl_outline o, struct vndf_impl_vector a,
                                                        struct vndf_impl_vector b) {
    int down = a.z > VNDF_R(0.0) && b.z <= VNDF_R(0.0), up = a.z <= VNDF_R(0.0) && b.z > VNDF_R(0.0);
    // Where it crosses the horizon: b.z a - a.z b, in the direction of the edge.
    VNDF_REAL x = vndf_impl_difference_of_products(b.z, a.x, a.z, b.x),
              y = vndf_impl_difference_of_products(b.z, a.y, a.z, b.y), l2 = VNDF_FMA(x, x, y * y);
    VNDF_REAL rcp =
        VNDF_DIVIDE(up ? VNDF_R(1.0) : VNDF_R(-1.0), VNDF_SQRT(l2 > VNDF_IMPL_LEAST ? l2 : VNDF_R(1.0)));
    x *= rcp;
    y *= rcp;
    o.down_x = down ? x : o.down_x;
    o.down_y = down ? y : o.down_y;
    o.up_x = up ? x : o.up_x;
    o.up_y = up ? y : o.up_y;
    return o;
}

// The part of that edge that is above the horizon.
VNDF_FN struct vndf_impl_arc vndf_impl_outline_edge(struct vndf_impl_outline o, struct vndf_impl_vector a,
                                                    struct vndf_impl_vector b) {
    struct vndf_impl_arc arc;
    int down = b.z <= VNDF_R(0.0), up = a.z <= VNDF_R(0.0);
    arc.l = vndf_impl_cross(VNDF_MAKE3(a.x, a.y, a.z), VNDF_MAKE3(b.x, b.y, b.z));
    arc.from = vndf_impl_vector_of(up ? o.up_x : a.x, up ? o.up_y : a.y, up ? VNDF_R(0.0) : a.z);
    arc.to = vndf_impl_vector_of(down ? o.down_x : b.x, down ? o.down_y : b.y, down ? VNDF_R(0.0) : b.z);
    return arc;
}

// The horizon from where the boundary goes down to where it comes up again.
VNDF_FN struct vndf_impl_arc vndf_impl_outline_level(struct vndf_impl_outline o) {
    struct vndf_impl_arc arc;
    VNDF_REAL side = vndf_impl_difference_of_products(o.down_x, o.up_y, o.down_y, o.up_x);
    arc.from = vndf_impl_vector_of(o.down_x, o.down_y, VNDF_R(0.0));
    arc.to = vndf_impl_vector_of(o.up_x, o.up_y, VNDF_R(0.0));
    arc.l = vndf_impl_vector_of(VNDF_R(0.0), VNDF_R(0.0), side < VNDF_R(0.0) ? VNDF_R(-1.0) : VNDF_R(1.0));
    return arc;
}

// Of a polygon whose vertices, unit vectors, are a, b, c and d, with three edges d = a: an arc for each edge and one of the horizon,
// in a loop, since the code of an arc is long. Between 0 and what is above the horizon at all.
VNDF_FN VNDF_REAL vndf_impl_polygon_mass(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL alpha_x,
                                         VNDF_REAL alpha_y, struct vndf_impl_vector a,
                                         struct vndf_impl_vector b, struct vndf_impl_vector c,
                                         struct vndf_impl_vector d, int edges) {
    struct vndf_impl_outline o;
    o.down_x = o.down_y = o.up_x = o.up_y = VNDF_R(0.0);
    VNDF_REAL sum = wo.z * VNDF_R(0.0);
    struct vndf_impl_vector first = a;
    for (int k = 0; k <= edges; ++k) {
        int last = k == edges, seen = a.z > VNDF_R(0.0) || b.z > VNDF_R(0.0);
        o = vndf_impl_outline_with(o, a, b);
        struct vndf_impl_arc arc =
            vndf_impl_arc_choice(last, vndf_impl_outline_edge(o, a, b), vndf_impl_outline_level(o));
        int crosses = vndf_impl_abs(o.down_x) + vndf_impl_max(o.down_y, -o.down_y) > VNDF_R(0.0);
        VNDF_REAL area = vndf_impl_arc_area(wo, alpha_x, alpha_y, arc, VNDF_R(1.0));
        sum += (last ? crosses : seen) ? area : VNDF_R(0.0);
        a = b;
        b = c;
        c = d;
        d = first;
    }
    VNDF_REAL mass = VNDF_1_PI * vndf_impl_abs(sum), visible = vndf_ggx_sigma_visible(wo, alpha);
    // Of vectors that are far from unit the sum may be no number.
    return wo.z > VNDF_R(0.0) ? (mass < visible ? mass : visible) : VNDF_R(0.0);
}

// The integral of D / 4 over the part of a spherical triangle that is above the horizon.
// wo, alpha: as vndf_ggx_lobe_of takes them.
// a, b, c: vectors of any length, local frame, anywhere on the sphere: the directions of the vertices, in either order. The edges
//     are the shorter arcs of great circles; between opposite directions there is none, and nothing is counted.
// return: per unit area of the macrosurface: in [0, vndf_ggx_sigma_visible(wo, alpha)]; 0 for wo.z <= 0, for a triangle below the
//     horizon and for one without area.
// Accuracy: 32 eps (|alpha wo| + condition number), 99th percentile; double 4096.
//     Absolute: of a tail far from the mirror direction digits are lost. In float an alpha below 1e-6, or below 2^-17 of the
//     other, counts as that; in double it is 4096 because of those. Double against quadrature over directions: 1e-12.
VNDF_FN VNDF_REAL vndf_ggx_triangle_mass(VNDF_REAL3 wo, VNDF_REAL3 a, VNDF_REAL3 b, VNDF_REAL3 c,
                                         VNDF_REAL2 alpha) {
    VNDF_REAL x = vndf_impl_alpha(alpha.x), y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL alpha_x = vndf_impl_arc_alpha(x, y), alpha_y = vndf_impl_arc_alpha(y, x);
    VNDF_REAL none =
        vndf_impl_zero(a.x, a.y, a.z) + vndf_impl_zero(b.x, b.y, b.z) + vndf_impl_zero(c.x, c.y, c.z);
    struct vndf_impl_vector p = vndf_impl_vertex(a, VNDF_R(0.0));
    struct vndf_impl_vector q = vndf_impl_vertex(b, p.x), r = vndf_impl_vertex(c, q.x);
    return vndf_impl_polygon_mass(wo, alpha, alpha_x, alpha_y, p, q, r, p, 3) +
           vndf_impl_zero(wo.x, wo.y, wo.z) + none;
}

// The same of a convex quadrilateral, as of a rectangle seen from the surface: a, b, c, d are its vertices in turn.
// wo, a, b, c, d, alpha, return: as vndf_ggx_triangle_mass; within half of the sphere.
// Accuracy: 32 eps (|alpha wo| + condition number), 99th percentile; double 4096.
//     As of a triangle.
VNDF_FN VNDF_REAL vndf_ggx_quad_mass(VNDF_REAL3 wo, VNDF_REAL3 a, VNDF_REAL3 b, VNDF_REAL3 c, VNDF_REAL3 d,
                                     VNDF_REAL2 alpha) {
    VNDF_REAL x = vndf_impl_alpha(alpha.x), y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL alpha_x = vndf_impl_arc_alpha(x, y), alpha_y = vndf_impl_arc_alpha(y, x);
    VNDF_REAL none = vndf_impl_zero(a.x, a.y, a.z) + vndf_impl_zero(b.x, b.y, b.z) +
                     vndf_impl_zero(c.x, c.y, c.z) + vndf_impl_zero(d.x, d.y, d.z);
    struct vndf_impl_vector p = vndf_impl_vertex(a, VNDF_R(0.0));
    struct vndf_impl_vector q = vndf_impl_vertex(b, p.x), r = vndf_impl_vertex(c, q.x);
    struct vndf_impl_vector s = vndf_impl_vertex(d, r.x);
    return vndf_impl_polygon_mass(wo, alpha, alpha_x, alpha_y, p, q, r, s, 4) +
           vndf_impl_zero(wo.x, wo.y, wo.z) + none;
}

// The integral of D / 4 over a cap wi . l > cos beta: vndf_ggx_sigma_cap without the normals below the surface.
// wo, alpha: as vndf_ggx_lobe_of takes them.
// l, one_minus_cos: as vndf_ggx_cone2026_of takes them.
// return: per unit area of the macrosurface, in [0, sigma(wo)]: less than vndf_ggx_sigma_cap where the cone leaves the hemisphere
//     of normals, theta_o + theta_l + beta > 180 degrees; what a sample of vndf_ggx_sample_wi_cone2026 keeps of its density is
//     this over that. Of wi below the horizon, too, but not of wi.z < -wo.z.
// Accuracy: 16 eps (|alpha wo| + condition number), 99th percentile; double 1024.
//     Absolute. With -wo within 2^-8 of the rim, in the cosine, no digits: the rim swings around it there.
VNDF_FN VNDF_REAL vndf_ggx_cap_mass(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos, VNDF_REAL2 alpha) {
    VNDF_REAL x = vndf_impl_alpha(alpha.x), y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL gap = vndf_impl_min(vndf_impl_max(one_minus_cos, VNDF_R(0.0)), VNDF_R(2.0));
    VNDF_REAL alpha_x = vndf_impl_arc_alpha(x, y), alpha_y = vndf_impl_arc_alpha(y, x);
    struct vndf_impl_rim rim = vndf_impl_rim_of(wo, l, gap);
    VNDF_REAL area = vndf_impl_arc_area(wo, alpha_x, alpha_y, rim.arc, rim.gap);
    VNDF_REAL mass = vndf_impl_rim_mass(rim, wo, alpha_x, alpha_y, area);
    return vndf_impl_finite(mass) + vndf_impl_zero(wo.x, wo.y, wo.z) + vndf_impl_zero(l.x, l.y, l.z);
}

VNDF_END

#endif
