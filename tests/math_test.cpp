#define VNDF_REAL float
#include "support/math_accuracy.h"
