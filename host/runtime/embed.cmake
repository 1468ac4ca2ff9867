# cmake -DOUTPUT=file.cpp -DFILES="name=path;..." -P embed.cmake: the files as C++ string literals.
set(entries "")
foreach(entry IN LISTS FILES)
    string(REGEX MATCH "^([^=]*)=(.*)$" _ "${entry}")
    set(name "${CMAKE_MATCH_1}")
    file(READ "${CMAKE_MATCH_2}" text)
    string(APPEND entries "        {\"${name}\", R\"vndf(${text})vndf\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from the kernel sources by host/runtime/embed.cmake.
#include \"runtime/sources.h\"

namespace vndf::runtime {

const std::vector<SourceFile>& embedded_sources() {
    static const std::vector<SourceFile> files = {
${entries}    };
    return files;
}

}  // namespace vndf::runtime
")
