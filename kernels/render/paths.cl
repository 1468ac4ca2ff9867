// The stages that are the same for every scene, in the order in which they run; host/render/wavefront.cpp says when.
#include "generate.h"
#include "traverse.h"
#include "survive.h"
#include "compact.h"
#include "accumulate.h"
