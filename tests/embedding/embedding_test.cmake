# A project that uses the headers builds and runs: from an installed package, and from a subdirectory.
#
#   cmake -D SOURCE=<clvndf> -D BUILD=<its build folder> -D WORK=<scratch folder> -D CXX=<compiler> -P this
set(example ${SOURCE}/tests/embedding)
file(REMOVE_RECURSE ${WORK})

function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(build_and_run source build)
    run(${CMAKE_COMMAND} -G Ninja -S ${source} -B ${build} -D CMAKE_CXX_COMPILER=${CXX}
        -D CMAKE_CXX_FLAGS=-Werror\ -Wall\ -Wextra ${ARGN})
    run(${CMAKE_COMMAND} --build ${build})
    execute_process(COMMAND ${build}/metal OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    if(NOT output MATCHES "^wi = \\(-?[0-9.]+, -?[0-9.]+, 0\\.[0-9]+\\), weight 0\\.[0-9]+, density [0-9.]+\n$")
        message(FATAL_ERROR "unexpected output of ${build}/metal: ${output}")
    endif()
    set(output ${output} PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
build_and_run(${example} ${WORK}/installed -D CMAKE_PREFIX_PATH=${WORK}/prefix -D CMAKE_CXX_STANDARD=11
              -D CMAKE_CXX_EXTENSIONS=OFF)
set(installed ${output})

file(READ ${example}/CMakeLists.txt text)
string(REGEX REPLACE "find_package[^\n]*" "add_subdirectory(${SOURCE} clvndf)" text "${text}")
file(WRITE ${WORK}/source/CMakeLists.txt "${text}")
file(COPY ${example}/metal.cpp DESTINATION ${WORK}/source)
build_and_run(${WORK}/source ${WORK}/subdirectory)

if(NOT EXISTS ${WORK}/subdirectory/clvndf/kernels/sources/clvndf/sources.h)
    message(FATAL_ERROR "the subdirectory has no clvndf/sources.h")
endif()
if(NOT output STREQUAL installed)
    message(FATAL_ERROR "the two builds differ: ${installed}${output}")
endif()
