// The lean forms of caps, with 1 +- z free of cancellation: an accuracy that costs next to nothing.
#define LEAN_FACTORED 1
#include "batch.cl"
