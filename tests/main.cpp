// Catch2 2.13 compiles its runner here; Catch2 3 links it instead of this file.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
