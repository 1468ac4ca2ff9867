#define VNDF_REAL double
#include "support/math_accuracy.h"
