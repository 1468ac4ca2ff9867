// Prints what string_source.h of `clvndf emit --as string` holds, whatever its form.
#include <cstddef>
#include <cstdio>

#include "string_source.h"

template <std::size_t n>
void print(const char (&text)[n]) {
    std::fputs(text, stdout);
}
template <std::size_t n>
void print(const char* const (&lines)[n]) {
    for (const char* line : lines) std::fputs(line, stdout);
}
int main() {
    print(vndf_source);
}
