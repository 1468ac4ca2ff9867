// The stages of the path tracer, in the order in which they run; host/render/wavefront.cpp says when.
#include "generate.h"
#include "traverse.h"
#include "surface.h"
#include "lights.h"
#include "shade.h"
#include "compact.h"
#include "accumulate.h"
