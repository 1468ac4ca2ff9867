// The stages that know materials: a program of their own, compiled for the effects that a scene calls for.
#include "surface.h"
#include "media.h"
#include "shade.h"
