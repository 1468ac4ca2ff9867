// Stage: a sample's light is added to the film, unless it is no finite number, which is counted.
#ifndef VNDF_RENDER_ACCUMULATE_H
#define VNDF_RENDER_ACCUMULATE_H

#include "language.h"
#include "queues.h"

VNDF_RENDER_KERNEL vndf_render_accumulate(VNDF_RENDER_IN(float) light, const uint first, const uint count,
                                          const uint stride, const uint pixels, const float odd,
                                          VNDF_RENDER_OUT(float) film) {
    const uint i = VNDF_RENDER_ITEM;
    // Items beyond the count add to a pixel of their own, behind the film's.
    const uint pixel = i < count ? first + i : pixels - 1;
    const float red = light[i], green = light[stride + i], blue = light[2 * stride + i];
    const int good = vndf_impl_zero(red, green, blue) == 0.0f;
    const float luminance = VNDF_FMA(0.2126f, red, VNDF_FMA(0.7152f, green, 0.0722f * blue));
    film[VNDF_FILM_RED * pixels + pixel] += good ? red : 0.0f;
    film[VNDF_FILM_GREEN * pixels + pixel] += good ? green : 0.0f;
    film[VNDF_FILM_BLUE * pixels + pixel] += good ? blue : 0.0f;
    film[VNDF_FILM_ODD * pixels + pixel] += good ? odd * luminance : 0.0f;
    film[VNDF_FILM_BAD * pixels + pixel] += good ? 0.0f : 1.0f;
}

#endif
