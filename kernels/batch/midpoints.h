// Midpoints of the unit square for albedos: VNDF_ALBEDO_POINTS on a side.
#ifndef VNDF_BATCH_MIDPOINTS_H
#define VNDF_BATCH_MIDPOINTS_H

#ifndef VNDF_ALBEDO_POINTS
#define VNDF_ALBEDO_POINTS 64
#endif

// A midpoint v moved to v^2 (3 - 2 v): close to the ends of the square, where samplers are singular, points are close.
struct vndf_batch_point {
    VNDF_REAL u, weight;
};
VNDF_FN struct vndf_batch_point vndf_batch_point_of(VNDF_REAL v) {
    struct vndf_batch_point p;
    p.u = v * v * VNDF_FMA(VNDF_R(-2.0), v, VNDF_R(3.0));
    p.weight = VNDF_R(6.0) * v * (VNDF_R(1.0) - v);
    return p;
}

#endif
