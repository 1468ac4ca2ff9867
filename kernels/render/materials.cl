// The stages that know what the scene holds: a program of their own, compiled for the effects that it calls for.
#include "surface.h"
#include "dress.h"
#include "media.h"
#include "lights.h"
#include "shade.h"
#include "cones.h"
